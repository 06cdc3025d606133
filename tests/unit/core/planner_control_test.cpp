#include <gtest/gtest.h>

#include "tests/unit/core/desk.hpp"

/// Holding and resuming a robot, replacing its queue.
namespace interlace::test {
namespace {

using model::ExecutionState;

bool is_held(const Desk& desk, std::size_t robot) {
  return desk.planner.state(desk.now).robots[robot].held;
}

TEST(PlannerHold, EndsWhatItDoesAndStartsNothing) {
  Desk desk;
  desk.all_stand();
  desk.submit("a", "r1", r1_aside());
  desk.submit("b", "r1", r1_home());
  const auto a = desk.dispatch_of("a");
  desk.begin(a);
  desk.hold("h", "r1");
  EXPECT_EQ(desk.status_of("h").state, CommandState::completed);
  EXPECT_EQ(desk.status_of("h").reason, Reason::on_request);
  EXPECT_NE(desk.status_of("h").text.find("what it has begun it ends"), std::string::npos) << desk.status_of("h").text;
  EXPECT_TRUE(is_held(desk, 0));
  desk.finish(a);
  EXPECT_EQ(desk.status_of("a").state, CommandState::completed);
  desk.pass(60s);
  EXPECT_EQ(desk.dispatches_of("b"), 0U);
  EXPECT_EQ(desk.status_of("b").state, CommandState::waiting);
  EXPECT_EQ(desk.status_of("b").reason, Reason::held);
  desk.resume("r", "r1");
  EXPECT_EQ(desk.status_of("r").state, CommandState::completed);
  EXPECT_FALSE(is_held(desk, 0));
  EXPECT_EQ(desk.dispatches_of("b"), 1U);
  desk.carry_out(desk.dispatch_of("b"));
  EXPECT_EQ(desk.status_of("b").state, CommandState::completed);
}

TEST(PlannerHold, TakesBackWhatHasNotBegun) {
  Desk desk;
  desk.all_stand();
  desk.submit("a", "r1", r1_aside());
  const auto d = desk.dispatch_of("a");
  desk.hold("h", "r1");
  ASSERT_EQ(desk.withdrawals.size(), 1U);
  EXPECT_EQ(desk.withdrawals[0].id.str(), "a");
  desk.pass(Desk::usual().start_tolerance / 2);
  desk.report(d, ExecutionState::withdrawn);
  EXPECT_EQ(desk.status_of("a").state, CommandState::waiting);
  EXPECT_EQ(desk.status_of("a").reason, Reason::held);
  desk.resume("r", "r1");
  EXPECT_EQ(desk.dispatches_of("a"), 2U);
  desk.carry_out(desk.dispatch_of("a"));
  EXPECT_EQ(desk.finals_of("a"), 1U);
}

TEST(PlannerHold, ALostWithdrawalIsSaidAgain) {
  auto options = Desk::usual();
  options.start_tolerance = 1s;
  Desk desk{experiment_cell(true), options};
  desk.all_stand();
  desk.submit("a", "r1", r1_aside());
  desk.hold("h", "r1");
  const std::size_t sent = desk.dispatches.size();
  desk.pass(150ms);
  EXPECT_EQ(desk.withdrawals.size(), 2U);
  EXPECT_EQ(desk.dispatches.size(), sent) << "and the command is not";
}

TEST(PlannerHold, OfOneThatHasBegunMeanwhileComesAfterItsMotion) {
  Desk desk;
  desk.all_stand();
  desk.submit("a", "r1", r1_aside());
  const auto d = desk.dispatch_of("a");
  desk.hold("h", "r1");
  desk.carry_out(d);
  EXPECT_EQ(desk.status_of("a").state, CommandState::completed);
  EXPECT_TRUE(is_held(desk, 0));
}

TEST(PlannerHold, IsNotMovedByAnEscapeAndSaysWhoIsWaitedFor) {
  Desk desk;
  desk.all_stand();
  desk.go("out", "r1", to_centre());
  desk.hold("h", "r1");
  desk.submit("in", "r2", to_centre());
  desk.pass(60s);
  EXPECT_EQ(desk.dispatches.size(), 1U);
  const auto in = desk.status_of("in");
  EXPECT_EQ(in.state, CommandState::waiting);
  EXPECT_EQ(in.reason, Reason::held);
  EXPECT_EQ(in.text.rfind("r2 waits for r1, which is held: ", 0), 0U) << in.text;
  ASSERT_FALSE(in.conflicts.empty());
  EXPECT_EQ(in.conflicts[0].blocker.str(), "r1");
  desk.resume("r", "r1");
  EXPECT_EQ(desk.status_of("in").state, CommandState::scheduled);
  EXPECT_EQ(desk.dispatch_of("escape-1").robot.str(), "r1");
}

TEST(PlannerHold, TakesBackAnEscapeThatHasNotBegun) {
  Desk desk;
  desk.all_stand();
  desk.go("out", "r1", to_centre());
  desk.submit("in", "r2", to_centre());
  const auto escape = desk.dispatch_of("escape-1");
  desk.hold("h", "r1");
  desk.report(escape, ExecutionState::withdrawn);
  EXPECT_EQ(desk.status_of("escape-1").state, CommandState::cancelled);
  EXPECT_EQ(desk.status_of("in").state, CommandState::waiting);
  EXPECT_EQ(desk.status_of("in").reason, Reason::held);
  desk.pass(60s);
  EXPECT_EQ(desk.dispatches_of("in"), 0U);
}

TEST(PlannerHold, OthersGoRoundIt) {
  Desk desk;
  desk.all_stand();
  desk.hold("h", "r1");
  desk.submit("a", "r2", r2_aside());
  EXPECT_EQ(desk.dispatches_of("a"), 1U);
}

TEST(PlannerHold, AHigherPriorityThatIsHeldHoldsUpNobody) {
  Desk desk;
  desk.all_stand();
  desk.submit("urgent", "r1", to_centre(), 9);
  const auto d = desk.dispatch_of("urgent");
  desk.hold("h", "r1");
  desk.report(d, ExecutionState::withdrawn);
  desk.submit("modest", "r2", to_centre(), -9);
  EXPECT_EQ(desk.dispatches_of("modest"), 1U);
}

TEST(PlannerHold, IsAnsweredAgainAndDoneOnce) {
  Desk desk;
  desk.all_stand();
  desk.hold("h", "r1");
  desk.resume("r", "r1");
  desk.hold("h", "r1");  // an old message that comes again, or late
  EXPECT_EQ(desk.statuses.back().id.str(), "h");
  EXPECT_FALSE(is_held(desk, 0)) << "it was done before the resume";
  desk.resume("again", "r1");
  EXPECT_NE(desk.status_of("again").text.find("it was not held"), std::string::npos);
  desk.hold("h2", "r1");
  desk.hold("h3", "r1");
  EXPECT_NE(desk.status_of("h3").text.find("it was held already"), std::string::npos);
}

TEST(PlannerHold, OfAnUnknownRobotIsRejected) {
  Desk desk;
  desk.all_stand();
  desk.hold("h", "r9");
  EXPECT_EQ(desk.status_of("h").state, CommandState::rejected);
  EXPECT_EQ(desk.status_of("h").reason, Reason::bad_request);
  desk.resume("r", "r9");
  EXPECT_EQ(desk.status_of("r").reason, Reason::bad_request);
}

TEST(PlannerHold, StopAndCancelWorkAsEver) {
  Desk desk;
  desk.all_stand();
  desk.hold("h", "r1");
  desk.submit("a", "r1", r1_aside());
  desk.submit("b", "r1", r1_home());
  desk.cancel("a", "r1");
  EXPECT_EQ(desk.status_of("a").state, CommandState::cancelled);
  desk.stop("s", "r1");
  EXPECT_EQ(desk.status_of("b").state, CommandState::cancelled);
  EXPECT_TRUE(is_held(desk, 0));
}

TEST(PlannerHold, InTurnTheOthersGetTheirTurn) {
  auto options = Desk::usual();
  options.strategy = "acm";
  Desk desk{experiment_cell(true), options};
  desk.all_stand();
  desk.go("out", "r2", to_centre());
  desk.hold("h2", "r2");
  desk.submit("in", "r1", to_centre());  // r1 is deadlocked from now on
  EXPECT_EQ(desk.dispatches_of("in"), 0U);
  desk.hold("h1", "r1");
  desk.submit("far", "r3", line_to(pose_mm(300, 5250, 330)));
  EXPECT_EQ(desk.dispatches_of("far"), 1U);
}

TEST(PlannerReplace, TakesTheWholeQueueOut) {
  Desk desk;
  desk.all_stand();
  desk.submit("a", "r1", r1_aside());
  desk.submit("b", "r1", r1_home());
  desk.submit("c", "r1", r1_aside());
  desk.begin(desk.dispatch_of("a"));
  desk.replace("x", "r1", {Desk::command("d", "r1", line_to(pose_mm(400, 250, 330))), Desk::command("e", "r1", r1_home(), 4)});
  EXPECT_EQ(desk.status_of("x").state, CommandState::completed);
  EXPECT_EQ(desk.status_of("x").text, "2 commands replaced by 2 commands");
  for (const char* gone : {"b", "c"}) {
    EXPECT_EQ(desk.status_of(gone).state, CommandState::cancelled);
    EXPECT_EQ(desk.status_of(gone).reason, Reason::replaced);
    EXPECT_EQ(desk.status_of(gone).text, "replaced by x");
    EXPECT_EQ(desk.finals_of(gone), 1U);
  }
  desk.finish(desk.dispatch_of("a"));
  EXPECT_EQ(desk.status_of("a").state, CommandState::completed);
  desk.carry_out(desk.dispatch_of("d"));
  desk.carry_out(desk.dispatch_of("e"));
  EXPECT_EQ(desk.status_of("e").state, CommandState::completed);
  EXPECT_EQ(desk.dispatches.size(), 3U);
}

TEST(PlannerReplace, IsAllOrNothing) {
  Desk desk;
  desk.all_stand();
  desk.submit("a", "r1", r1_aside());
  desk.submit("b", "r1", r1_home());
  desk.begin(desk.dispatch_of("a"));
  desk.replace("x", "r1", {Desk::command("d", "r1", r1_home()), Desk::command("e", "r1", line_to(pose_mm(900, 250, 300)))});
  EXPECT_EQ(desk.status_of("x").state, CommandState::rejected);
  EXPECT_EQ(desk.status_of("x").reason, Reason::unreachable);
  EXPECT_EQ(desk.status_of("x").text.rfind("command 2 of 2 (e): ", 0), 0U) << desk.status_of("x").text;
  EXPECT_NE(desk.status_of("x").text.find("the queue stays as it was"), std::string::npos);
  for (const char* id : {"d", "e"}) {
    EXPECT_EQ(desk.status_of(id).state, CommandState::rejected);
    EXPECT_NE(desk.status_of(id).text.find("replacement x was refused as a whole"), std::string::npos) << desk.status_of(id).text;
  }
  desk.finish(desk.dispatch_of("a"));
  desk.carry_out(desk.dispatch_of("b"));
  EXPECT_EQ(desk.status_of("b").state, CommandState::completed);
  EXPECT_EQ(desk.planner.state(desk.now).accepted, 2U);
}

TEST(PlannerReplace, OfWhatIsDecidedButNotToldReplacesThatToo) {
  Desk desk;
  desk.all_stand();
  desk.go("out", "r1", to_centre());
  desk.submit("back", "r1", r1_home());
  desk.submit("in", "r2", to_centre());
  ASSERT_EQ(desk.status_of("in").state, CommandState::scheduled);
  ASSERT_EQ(desk.dispatches_of("in"), 0U);
  desk.replace("x", "r2", {Desk::command("other", "r2", r2_aside())});
  EXPECT_EQ(desk.status_of("in").state, CommandState::cancelled);
  EXPECT_EQ(desk.status_of("in").reason, Reason::replaced);
  EXPECT_EQ(desk.dispatches_of("other"), 1U);
}

TEST(PlannerReplace, WhatTheProxyWasToldIsKept) {
  Desk desk;
  desk.all_stand();
  desk.submit("a", "r1", r1_aside());
  ASSERT_EQ(desk.dispatches_of("a"), 1U);
  desk.replace("x", "r1", {Desk::command("b", "r1", r1_home())});
  EXPECT_TRUE(desk.withdrawals.empty());
  desk.carry_out(desk.dispatch_of("a"));
  EXPECT_EQ(desk.status_of("a").state, CommandState::completed);
  EXPECT_TRUE(desk.dispatch_of("b").from.isApprox(desk.end_of(desk.dispatch_of("a"))));
}

TEST(PlannerReplace, ByNothingEmptiesTheQueue) {
  Desk desk;
  desk.all_stand();
  desk.submit("a", "r1", r1_aside());
  desk.submit("b", "r1", r1_home());
  desk.begin(desk.dispatch_of("a"));
  desk.replace("x", "r1", {});
  EXPECT_EQ(desk.status_of("x").state, CommandState::completed);
  EXPECT_EQ(desk.status_of("b").reason, Reason::replaced);
  desk.finish(desk.dispatch_of("a"));
  EXPECT_EQ(desk.planner.state(desk.now).robots[0].queued, 0U);
}

TEST(PlannerReplace, IsAnsweredAgainAndDoneOnce) {
  Desk desk;
  desk.all_stand();
  desk.submit("a", "r1", r1_aside());
  desk.begin(desk.dispatch_of("a"));
  desk.replace("x", "r1", {Desk::command("b", "r1", r1_home())});
  desk.submit("c", "r1", r1_aside());
  const std::size_t said = desk.statuses.size();
  desk.replace("x", "r1", {Desk::command("b", "r1", r1_home())});
  EXPECT_EQ(desk.statuses.size(), said + 1);
  EXPECT_EQ(desk.statuses.back().id.str(), "x");
  EXPECT_EQ(desk.finals_of("c"), 0U) << "what came after it stays";
}

TEST(PlannerReplace, ByIdsThatWereUsedOrForOthersIsRefused) {
  Desk desk;
  desk.all_stand();
  desk.submit("a", "r1", r1_aside());
  desk.begin(desk.dispatch_of("a"));
  desk.submit("b", "r1", r1_home());
  desk.replace("x", "r1", {Desk::command("new", "r1", r1_home()), Desk::command("b", "r1", r1_home())});
  EXPECT_EQ(desk.status_of("x").reason, Reason::bad_request);
  EXPECT_EQ(desk.status_of("b").state, CommandState::queued);
  desk.replace("y", "r1", {Desk::command("twice", "r1", r1_home()), Desk::command("twice", "r1", r1_home())});
  EXPECT_EQ(desk.status_of("y").reason, Reason::bad_request);
  desk.replace("z", "r1", {Desk::command("his", "r2", r2_home())});
  EXPECT_EQ(desk.status_of("z").reason, Reason::bad_request);
  desk.replace("z9", "r9", {});
  EXPECT_EQ(desk.status_of("z9").reason, Reason::bad_request);
  desk.finish(desk.dispatch_of("a"));
  EXPECT_EQ(desk.dispatches_of("b"), 1U);
}

TEST(PlannerReplace, CountsDeadlinesFromItself) {
  Desk desk;
  desk.all_stand();
  desk.submit("a", "r1", r1_aside());
  desk.begin(desk.dispatch_of("a"));
  desk.replace("x", "r1", {Desk::command("b", "r1", r1_home(), 0, 1), Desk::command("c", "r1", r1_aside(), 0, 60)});
  EXPECT_EQ(desk.status_of("b").verdict, model::DeadlineVerdict::impossible);
  EXPECT_EQ(desk.status_of("c").verdict, model::DeadlineVerdict::open);
}

TEST(PlannerReplace, WhileHeldWaits) {
  Desk desk;
  desk.all_stand();
  desk.hold("h", "r1");
  desk.submit("a", "r1", r1_aside());
  desk.replace("x", "r1", {Desk::command("b", "r1", line_to(pose_mm(400, 250, 330)))});
  desk.pass(60s);
  EXPECT_TRUE(desk.dispatches.empty());
  EXPECT_EQ(desk.status_of("b").reason, Reason::held);
  desk.resume("r", "r1");
  EXPECT_EQ(desk.dispatches_of("b"), 1U);
}

}  // namespace
}  // namespace interlace::test
