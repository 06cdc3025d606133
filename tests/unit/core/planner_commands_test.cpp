#include <gtest/gtest.h>

#include "tests/unit/core/desk.hpp"

/// What clients ask for: admission, order, cancelling, stopping, ids.
namespace interlace::test {
namespace {

using model::ExecutionState;

TEST(PlannerCommands, SameIdIsAnsweredTwiceAndExecutedOnce) {
  Desk desk;
  desk.all_stand();
  desk.submit("a", "r1", r1_aside());
  const std::size_t said = desk.statuses.size();
  desk.submit("a", "r1", r1_aside());
  EXPECT_EQ(desk.statuses.size(), said + 1);
  EXPECT_EQ(desk.statuses.back().id.str(), "a");
  desk.carry_out(desk.dispatch_of("a"));
  EXPECT_EQ(desk.status_of("a").state, CommandState::completed);
  desk.submit("a", "r1", r1_aside());
  EXPECT_EQ(desk.status_of("a").state, CommandState::completed);
  desk.pass(10s);
  EXPECT_EQ(desk.dispatches_of("a"), 1U);
  EXPECT_EQ(desk.planner.state(desk.now).accepted, 1U);
}

TEST(PlannerCommands, OfOneRobotAreCarriedOutInTheirOrder) {
  Desk desk;
  desk.all_stand();
  desk.submit("a", "r1", r1_aside());
  desk.submit("b", "r1", r1_home());
  desk.submit("c", "r1", r1_aside());
  for (const char* id : {"a", "b", "c"}) {
    if (desk.dispatches.empty() || desk.dispatches.back().id.str() != id) {
      ASSERT_TRUE(desk.pass_until_dispatch()) << id;
    }
    EXPECT_EQ(desk.dispatches.back().id.str(), id);
    desk.begin(desk.dispatches.back());
    desk.pass(10ms);
    EXPECT_EQ(desk.dispatches.back().id.str(), id) << "the next one must wait for this one's end";
    desk.finish(desk.dispatch_of(id));
    EXPECT_EQ(desk.status_of(id).state, CommandState::completed);
  }
  EXPECT_EQ(desk.dispatches.size(), 3U);
  EXPECT_TRUE(desk.dispatches[1].from.isApprox(desk.end_of(desk.dispatches[0])));
}

TEST(PlannerCommands, ForAnUnknownRobotAreRejected) {
  Desk desk;
  desk.all_stand();
  desk.submit("a", "r9", r1_aside());
  EXPECT_EQ(desk.status_of("a").state, CommandState::rejected);
  EXPECT_EQ(desk.status_of("a").reason, Reason::bad_request);
  EXPECT_NE(desk.status_of("a").text.find("r9"), std::string::npos);
  EXPECT_TRUE(desk.dispatches.empty());
}

TEST(PlannerCommands, OutOfReachAreRejectedWithThePlace) {
  Desk desk;
  desk.all_stand();
  desk.submit("a", "r1", line_to(pose_mm(900, 250, 300)));
  const auto status = desk.status_of("a");
  EXPECT_EQ(status.state, CommandState::rejected);
  EXPECT_EQ(status.reason, Reason::unreachable);
  EXPECT_NE(status.text.find("out of reach"), std::string::npos) << status.text;
  EXPECT_NE(status.text.find("250.0, 300.0) mm"), std::string::npos) << status.text;
  EXPECT_NE(status.text.find("% of the path"), std::string::npos) << status.text;
  desk.submit("b", "r1", r1_aside());
  EXPECT_EQ(desk.dispatches_of("b"), 1U) << "a rejected command must not hold up the next";
}

TEST(PlannerCommands, WithValuesNobodyCanCarryOutAreRejected) {
  Desk desk;
  desk.all_stand();
  auto too_fast = r1_aside();
  too_fast.velocity = 1.0;
  desk.submit("fast", "r1", too_fast);
  EXPECT_EQ(desk.status_of("fast").reason, Reason::bad_request);
  auto backwards = r1_aside();
  backwards.acceleration = -1;
  desk.submit("backwards", "r1", backwards);
  EXPECT_EQ(desk.status_of("backwards").reason, Reason::bad_request);
  auto nowhere = pose_mm(300, 250, 330);
  nowhere.translation().x() = std::nan("");
  desk.submit("nowhere", "r1", line_to(nowhere));
  EXPECT_EQ(desk.status_of("nowhere").reason, Reason::bad_request);
  EXPECT_TRUE(desk.dispatches.empty());
}

TEST(PlannerCommands, ThatTouchTheRobotItselfAreRejected) {
  Desk desk;
  desk.all_stand();
  desk.submit("a", "r1", line_to(pose_mm(140, 250, 200)));
  EXPECT_EQ(desk.status_of("a").reason, Reason::self_collision) << desk.status_of("a").text;
  EXPECT_NE(desk.status_of("a").text.find("own"), std::string::npos);
}

TEST(PlannerCommands, ThatTouchTheBaseOfANeighbourAreRejected) {
  Desk desk;
  desk.all_stand();
  desk.submit("a", "r1", line_to(pose_mm(220, -210, 200)));
  EXPECT_EQ(desk.status_of("a").reason, Reason::base_collision) << desk.status_of("a").text;
  EXPECT_NE(desk.status_of("a").text.find("base of r2"), std::string::npos) << desk.status_of("a").text;
}

TEST(PlannerCommands, AreLimitedInNumber) {
  auto options = Desk::usual();
  options.queue_limit = 2;
  Desk desk{experiment_cell(), options};
  desk.all_stand();
  for (const char* id : {"running", "w1", "w2", "w3"}) desk.submit(id, "r1", id[1] == '2' ? r1_home() : r1_aside());
  EXPECT_EQ(desk.status_of("w2").state, CommandState::queued);
  EXPECT_EQ(desk.status_of("w3").state, CommandState::rejected);
  EXPECT_EQ(desk.status_of("w3").reason, Reason::queue_full);
}

TEST(PlannerCommands, FinishedOnesAreForgottenInTheEnd) {
  auto options = Desk::usual();
  options.remembered = 3;
  Desk desk{experiment_cell(), options};
  desk.all_stand();
  for (int i = 0; i < 10; ++i) desk.submit("bad" + std::to_string(i), "r9", r1_aside());
  desk.statuses.clear();
  desk.cancel("bad9", "r1");
  EXPECT_EQ(desk.statuses.back().reason, Reason::bad_request) << "still remembered";
  desk.cancel("bad0", "r1");
  EXPECT_EQ(desk.statuses.back().reason, Reason::unknown_id) << "long forgotten";
}

TEST(PlannerCommands, ForgettingNeverTouchesOpenOnes) {
  auto options = Desk::usual();
  options.remembered = 1;
  Desk desk{experiment_cell(), options};
  desk.all_stand();
  desk.submit("open", "r1", r1_aside());
  for (int i = 0; i < 10; ++i) desk.submit("bad" + std::to_string(i), "r9", r1_aside());
  desk.submit("open", "r1", r1_aside());
  EXPECT_EQ(desk.status_of("open").state, CommandState::scheduled);
  EXPECT_EQ(desk.planner.state(desk.now).accepted, 1U);
}

TEST(PlannerCommands, CancelledWhileQueuedAreGone) {
  Desk desk;
  desk.all_stand();
  desk.submit("a", "r1", r1_aside());
  desk.submit("b", "r1", r1_home());
  desk.submit("c", "r1", line_to(pose_mm(400, 250, 330)));
  desk.cancel("b", "r1");
  EXPECT_EQ(desk.status_of("b").state, CommandState::cancelled);
  EXPECT_EQ(desk.status_of("b").reason, Reason::on_request);
  desk.carry_out(desk.dispatch_of("a"));
  EXPECT_EQ(desk.dispatch_of("c").from, desk.end_of(desk.dispatch_of("a"))) << "judged anew from where it now begins";
  EXPECT_EQ(desk.dispatches_of("b"), 0U);
  EXPECT_EQ(desk.finals_of("b"), 1U);
}

TEST(PlannerCommands, CancelledWhileHeldAreGoneWithoutTheProxyKnowing) {
  Desk desk;
  desk.all_stand();
  desk.go("out", "r1", to_centre());
  desk.submit("back", "r1", r1_home());
  desk.submit("in", "r2", to_centre());
  ASSERT_EQ(desk.status_of("in").state, CommandState::scheduled);
  ASSERT_EQ(desk.dispatches_of("in"), 0U);
  desk.cancel("in", "r2");
  EXPECT_EQ(desk.status_of("in").state, CommandState::cancelled);
  EXPECT_TRUE(desk.withdrawals.empty());
  desk.carry_out(desk.dispatch_of("back"));
  desk.pass(20s);
  EXPECT_EQ(desk.dispatches_of("in"), 0U);
}

TEST(PlannerCommands, CancelledAfterDispatchAreFinalWhenTheProxySaysSo) {
  Desk desk;
  desk.all_stand();
  desk.submit("a", "r1", r1_aside());
  const auto d = desk.dispatch_of("a");
  desk.cancel("a", "r1");
  ASSERT_EQ(desk.withdrawals.size(), 1U);
  EXPECT_EQ(desk.withdrawals[0].attempt, d.attempt);
  EXPECT_FALSE(is_final(desk.status_of("a").state));
  desk.report(d, ExecutionState::withdrawn);
  EXPECT_EQ(desk.status_of("a").state, CommandState::cancelled);
  EXPECT_EQ(desk.finals_of("a"), 1U);
  desk.submit("b", "r1", r1_aside());
  EXPECT_EQ(desk.dispatches_of("b"), 1U);
}

TEST(PlannerCommands, CancelledTooLateAreCarriedOut) {
  Desk desk;
  desk.all_stand();
  desk.submit("a", "r1", r1_aside());
  const auto d = desk.dispatch_of("a");
  desk.cancel("a", "r1");
  desk.begin(d);
  EXPECT_EQ(desk.status_of("a").state, CommandState::started);
  desk.cancel("a", "r1");
  EXPECT_EQ(desk.status_of("a").state, CommandState::started);
  EXPECT_FALSE(desk.status_of("a").text.empty());
  desk.finish(d);
  EXPECT_EQ(desk.status_of("a").state, CommandState::completed);
  EXPECT_EQ(desk.finals_of("a"), 1U);
}

TEST(PlannerCommands, CancellingWhatNobodyKnowsIsAnswered) {
  Desk desk;
  desk.all_stand();
  desk.cancel("ghost", "r1");
  EXPECT_EQ(desk.status_of("ghost").reason, Reason::unknown_id);
}

TEST(PlannerCommands, StopGivesUpWhatHasNotStarted) {
  Desk desk;
  desk.all_stand();
  desk.submit("a", "r1", r1_aside());
  desk.submit("b", "r1", r1_home());
  desk.submit("c", "r1", r1_aside());
  desk.begin(desk.dispatch_of("a"));
  desk.stop("halt", "r1");
  EXPECT_EQ(desk.status_of("halt").state, CommandState::completed);
  EXPECT_EQ(desk.status_of("b").state, CommandState::cancelled);
  EXPECT_EQ(desk.status_of("c").state, CommandState::cancelled);
  EXPECT_EQ(desk.status_of("a").state, CommandState::started);
  desk.finish(desk.dispatch_of("a"));
  EXPECT_EQ(desk.status_of("a").state, CommandState::completed);
  desk.stop("halt", "r1");
  desk.pass(20s);
  EXPECT_EQ(desk.dispatches.size(), 1U);
}

TEST(PlannerCommands, StopWithdrawsWhatIsDispatched) {
  Desk desk;
  desk.all_stand();
  desk.submit("a", "r1", r1_aside());
  desk.submit("b", "r1", r1_home());
  desk.stop("halt", "r1");
  EXPECT_EQ(desk.withdrawals.size(), 1U);
  EXPECT_EQ(desk.status_of("b").state, CommandState::cancelled);
  desk.report(desk.dispatch_of("a"), ExecutionState::withdrawn);
  EXPECT_EQ(desk.status_of("a").state, CommandState::cancelled);
  desk.pass(20s);
  EXPECT_EQ(desk.dispatches.size(), 1U);
}

TEST(PlannerCommands, AnUnknownStrategyIsRefused) {
  auto options = Desk::usual();
  options.strategy = "luck";
  EXPECT_THROW((core::Planner{experiment_cell(), options}), std::invalid_argument);
}

}  // namespace
}  // namespace interlace::test
