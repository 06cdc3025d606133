#include <gtest/gtest.h>

#include "tests/unit/core/desk.hpp"

/// Starts that rely on a departure which is promised: what counts as a promise, and what becomes of one that is broken.
namespace interlace::test {
namespace {

using model::ExecutionState;

std::shared_ptr<const model::Cell> cell_with_promise(double promise) {
  auto cell = std::make_shared<model::Cell>(*experiment_cell(true));
  cell->planning.promise = promise;
  return cell;
}

core::PlannerOptions ahead() {
  core::PlannerOptions o = Desk::usual();
  o.strategy = "lookahead";
  return o;
}

/// So slow that r2, which leaves the centre within the promise, is long gone when r1 comes there.
model::MotionRequest slowly_to_centre() {
  auto motion = to_centre();
  motion.velocity = 0.03;
  return motion;
}

/// r2 is on its way to the centre and has another command that leads away from there; r1 has one to the centre.
struct OnItsWay : Desk {
  explicit OnItsWay(double promise = 2) : Desk(cell_with_promise(promise), ahead()) {
    all_stand();
    submit("in", "r2", to_centre());
    submit("out", "r2", r2_home());
    submit("next", "r1", slowly_to_centre());
    pass(0s);
    begin(dispatch_of("in"));
  }
  [[nodiscard]] Instant arrival() const {
    const auto d = dispatch_of("in");
    return d.earliest + model::from_seconds(d.duration);
  }
};

/// r2 stands in the centre and has a command that leads away from there; r1 has one to the centre.
struct StandsThere : Desk {
  StandsThere() : Desk(cell_with_promise(2), ahead()) {
    all_stand();
    submit("in", "r2", to_centre());
    pass(0s);
    carry_out(dispatch_of("in"));
    submit("out", "r2", r2_home());
    submit("next", "r1", slowly_to_centre());
    pass(0s);
  }
};

TEST(PlannerPromises, OfARobotOnItsWayAreReliedOnForSoLongAndNoLonger) {
  OnItsWay desk;
  ASSERT_TRUE(desk.pass_until_dispatch());
  ASSERT_EQ(desk.dispatches.back().id.str(), "next");
  EXPECT_EQ(desk.dispatches_of("out"), 0U) << "r2 has not even arrived";
  EXPECT_LT(desk.dispatch_of("next").earliest, desk.arrival());
  EXPECT_GE(desk.dispatch_of("next").earliest, desk.arrival() - 2s);
  const Instant departs = *desk.status_of("out").start;
  EXPECT_GE(desk.dispatch_of("next").earliest, departs - 2s);
  desk.begin(desk.dispatch_of("next"));
  desk.finish(desk.dispatch_of("in"));
  if (desk.dispatches_of("out") == 0) {
    ASSERT_TRUE(desk.pass_until_dispatch());
  }
  EXPECT_EQ(desk.dispatch_of("out").earliest, departs) << "as promised";
}

TEST(PlannerPromises, AreNotReliedOnWhereTheCellForbidsIt) {
  OnItsWay desk{0};
  EXPECT_FALSE(desk.pass_until_dispatch(desk.arrival() - desk.now - 1ms));
  desk.finish(desk.dispatch_of("in"));
  if (desk.dispatches_of("out") == 0) {
    ASSERT_TRUE(desk.pass_until_dispatch());
  }
  desk.report(desk.dispatch_of("out"), ExecutionState::accepted);
  EXPECT_EQ(desk.dispatches_of("next"), 0U) << "r2 has not left";
  desk.begin(desk.dispatch_of("out"));
  EXPECT_TRUE(desk.dispatches_of("next") == 1 || desk.pass_until_dispatch(1s));
}

TEST(PlannerPromises, OfARobotThatFaultsInTimeHoldTheOtherBack) {
  OnItsWay desk;
  desk.pass(500ms);
  desk.report(desk.dispatch_of("in"), ExecutionState::failed, desk.end_of(desk.dispatch_of("in")), "fault");
  desk.posture("r2", desk.end_of(desk.dispatch_of("in")), false, {}, false);
  EXPECT_FALSE(desk.pass_until_dispatch());
  EXPECT_EQ(desk.dispatches_of("next"), 0U);
}

TEST(PlannerPromises, ThatAreBrokenUnderWayAreToldAtOnce) {
  OnItsWay desk;
  ASSERT_TRUE(desk.pass_until_dispatch());
  desk.begin(desk.dispatch_of("next"));
  EXPECT_NE(desk.status_of("next").reason, Reason::blocked);
  desk.report(desk.dispatch_of("in"), ExecutionState::failed, desk.end_of(desk.dispatch_of("in")), "fault");
  const auto told = desk.status_of("next");
  EXPECT_EQ(told.state, CommandState::started);
  EXPECT_EQ(told.reason, Reason::blocked);
  EXPECT_NE(told.text.find("r1 is under way to where r2"), std::string::npos) << told.text;
}

TEST(PlannerPromises, AreNotCancelledUnderSomebodyOnItsWay) {
  OnItsWay desk;
  ASSERT_TRUE(desk.pass_until_dispatch());
  desk.cancel("out", "r2");
  EXPECT_FALSE(is_final(desk.status_of("out").state));
  EXPECT_NE(desk.status_of("out").text.find("r1 is under way and relies on r2"), std::string::npos) << desk.status_of("out").text;
  desk.begin(desk.dispatch_of("next"));
  desk.stop("stop", "r2");
  EXPECT_FALSE(is_final(desk.status_of("out").state));
  desk.finish(desk.dispatch_of("in"));
  EXPECT_TRUE(desk.dispatches_of("out") == 1 || desk.pass_until_dispatch(1s));
}

TEST(PlannerPromises, AreKeptBeforeAHold) {
  OnItsWay desk;
  ASSERT_TRUE(desk.pass_until_dispatch());
  desk.hold("hold", "r2");
  desk.begin(desk.dispatch_of("next"));
  desk.finish(desk.dispatch_of("in"));
  EXPECT_TRUE(desk.dispatches_of("out") == 1 || desk.pass_until_dispatch(1s)) << "r1 is on its way to where r2 stands";
  const std::size_t withdrawn = desk.withdrawals.size();
  desk.pass(200ms);
  EXPECT_EQ(desk.withdrawals.size(), withdrawn) << "an unanswered dispatch that is relied on is repeated, not taken back";
  desk.submit("later", "r2", to_centre());
  desk.carry_out(desk.dispatch_of("out"));
  desk.pass(1s);
  EXPECT_EQ(desk.dispatches_of("later"), 0U) << "held";
}

TEST(PlannerPromises, AreKeptBeforeAQueueIsReplaced) {
  OnItsWay desk;
  ASSERT_TRUE(desk.pass_until_dispatch());
  desk.begin(desk.dispatch_of("next"));
  desk.replace("replace", "r2", {});
  EXPECT_FALSE(is_final(desk.status_of("out").state));
  desk.finish(desk.dispatch_of("in"));
  EXPECT_TRUE(desk.dispatches_of("out") == 1 || desk.pass_until_dispatch(1s));
}

TEST(PlannerPromises, AreNotMadeWhileARobotIsHeld) {
  OnItsWay desk;
  desk.hold("hold", "r2");
  EXPECT_FALSE(desk.pass_until_dispatch(desk.arrival() - desk.now - 1ms));
}

TEST(PlannerPromises, MayBeGivenUpBeforeAnybodyReliesOnThem) {
  OnItsWay desk;
  desk.cancel("out", "r2");
  EXPECT_EQ(desk.status_of("out").state, CommandState::cancelled);
  // r2 would stay in the centre now. It is sent out of the way as soon as it comes there, and that is a promise too.
  const bool dispatched = desk.pass_until_dispatch(desk.arrival() - desk.now - 1ms);
  ASSERT_TRUE(dispatched);
  EXPECT_EQ(desk.dispatches_of("next"), 1U);
  EXPECT_EQ(desk.status_of("escape-1").state, CommandState::scheduled);
  EXPECT_EQ(desk.status_of("escape-1").serves, model::CommandId{"next"});
}

TEST(PlannerPromises, OfARobotThatStandsCountOnceItsProxyHasAccepted) {
  StandsThere desk;
  ASSERT_EQ(desk.dispatches_of("out"), 1U);
  EXPECT_EQ(desk.dispatches_of("next"), 0U);
  desk.report(desk.dispatch_of("out"), ExecutionState::accepted);
  EXPECT_EQ(desk.dispatches_of("next"), 1U);
}

TEST(PlannerPromises, ThatAProxyRefusesAreNone) {
  StandsThere desk;
  desk.report(desk.dispatch_of("out"), ExecutionState::refused, desk.dispatch_of("out").from, "no");
  desk.stands("r2", desk.dispatch_of("out").from);
  desk.pass(1ms);
  EXPECT_EQ(desk.dispatches_of("next"), 0U);
}

TEST(PlannerPromises, ThatAProxyWithdrawsUnderWayAreToldAtOnce) {
  StandsThere desk;
  desk.report(desk.dispatch_of("out"), ExecutionState::accepted);
  ASSERT_EQ(desk.dispatches_of("next"), 1U);
  desk.begin(desk.dispatch_of("next"));
  desk.report(desk.dispatch_of("out"), ExecutionState::refused, desk.dispatch_of("out").from, "no");
  EXPECT_EQ(desk.status_of("next").reason, Reason::blocked);
  EXPECT_NE(desk.status_of("next").text.find("may collide"), std::string::npos);
}

}  // namespace
}  // namespace interlace::test
