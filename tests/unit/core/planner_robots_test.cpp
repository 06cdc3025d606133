#include <gtest/gtest.h>

#include "tests/unit/core/desk.hpp"

/// Robots that do not do what was expected: silent, jogged, refusing, or with their reports lost.
namespace interlace::test {
namespace {

using model::ExecutionState;

constexpr auto kTimeout = 500ms;

core::PlannerOptions with_timeout() {
  auto options = Desk::usual();
  options.posture_timeout = kTimeout;
  return options;
}

TEST(PlannerRobots, NothingStartsBeforeARobotIsHeardFrom) {
  Desk desk;
  desk.submit("a", "r1", r1_aside());
  EXPECT_EQ(desk.status_of("a").state, CommandState::waiting);
  EXPECT_EQ(desk.status_of("a").reason, Reason::not_ready);
  EXPECT_TRUE(desk.dispatches.empty());
  desk.all_stand();
  EXPECT_EQ(desk.dispatches_of("a"), 1U);
}

TEST(PlannerRobots, ASilentRobotBlocksItsReachAndNoMore) {
  Desk desk{experiment_cell(true), with_timeout()};
  desk.all_stand();
  desk.pass(400ms);
  desk.stands("r2", desk.robot("r2").start);
  desk.stands("r3", desk.robot("r3").start);
  desk.pass(200ms);  // r1 has been silent for 600 ms, the others for 200 ms
  desk.submit("near", "r2", r2_aside());
  desk.submit("far", "r3", line_to(pose_mm(300, 5250, 330)));
  EXPECT_EQ(desk.planner.state(desk.now).robots[0].mode, model::RobotMode::unknown);
  EXPECT_EQ(desk.status_of("near").state, CommandState::waiting);
  EXPECT_EQ(desk.status_of("near").reason, Reason::robot_unknown);
  EXPECT_NE(desk.status_of("near").text.find("r1"), std::string::npos);
  EXPECT_EQ(desk.dispatches_of("far"), 1U);
  desk.stands("r1", desk.robot("r1").start);
  EXPECT_EQ(desk.dispatches_of("near"), 1U);
}

TEST(PlannerRobots, WhatWasDispatchedInSightOfARobotNowLostIsTakenBack) {
  Desk desk{experiment_cell(true), with_timeout()};
  desk.all_stand();
  desk.pass(490ms);
  desk.stands("r2", desk.robot("r2").start);
  desk.submit("a", "r2", r2_aside());
  ASSERT_EQ(desk.dispatches_of("a"), 1U);
  desk.pass(15ms);
  ASSERT_EQ(desk.withdrawals.size(), 1U);
  EXPECT_EQ(desk.withdrawals[0].id.str(), "a");
  desk.report(desk.dispatch_of("a"), ExecutionState::withdrawn);
  EXPECT_EQ(desk.status_of("a").state, CommandState::waiting);
  EXPECT_EQ(desk.dispatches_of("a"), 1U);
  desk.stands("r1", desk.robot("r1").start);
  EXPECT_EQ(desk.dispatches_of("a"), 2U);
}

TEST(PlannerRobots, ANotReadyControllerWaits) {
  Desk desk;
  desk.all_stand();
  desk.posture("r1", desk.robot("r1").start, false, {}, false);
  desk.submit("a", "r1", r1_aside());
  EXPECT_EQ(desk.status_of("a").reason, Reason::not_ready);
  EXPECT_TRUE(desk.dispatches.empty());
  desk.stands("r1", desk.robot("r1").start);
  EXPECT_EQ(desk.dispatches_of("a"), 1U);
}

TEST(PlannerRobots, ARefusedStartIsPlannedAgain) {
  Desk desk;
  desk.all_stand();
  desk.submit("a", "r1", r1_aside());
  const auto first = desk.dispatch_of("a");
  EXPECT_EQ(first.attempt, 1U);
  desk.now = first.latest;
  desk.report(first, ExecutionState::refused, model::Joints::Zero(), "the window has passed");
  const auto second = desk.dispatch_of("a");
  EXPECT_EQ(second.attempt, 2U);
  EXPECT_GE(second.earliest, desk.now + 20ms);
  const auto refused =
      std::find_if(desk.statuses.begin(), desk.statuses.end(), [](const auto& s) { return s.reason == Reason::refused_by_proxy; });
  ASSERT_NE(refused, desk.statuses.end());
  EXPECT_NE(refused->text.find("the window has passed"), std::string::npos);
  desk.carry_out(second);
  EXPECT_EQ(desk.status_of("a").state, CommandState::completed);
}

TEST(PlannerRobots, AnUnansweredDispatchIsSaidAgain) {
  auto options = Desk::usual();
  options.start_tolerance = 1s;
  options.answer_timeout = 100ms;
  Desk desk{experiment_cell(), options};
  desk.all_stand();
  desk.submit("a", "r1", r1_aside());
  desk.pass(99ms);
  EXPECT_EQ(desk.dispatches_of("a"), 1U);
  desk.pass(1ms);
  ASSERT_EQ(desk.dispatches_of("a"), 2U);
  EXPECT_EQ(desk.dispatches[0].attempt, desk.dispatches[1].attempt);
  EXPECT_EQ(desk.dispatches[0].earliest, desk.dispatches[1].earliest);
  desk.report(desk.dispatches[1], ExecutionState::accepted);
  desk.pass(300ms);
  EXPECT_EQ(desk.dispatches_of("a"), 2U) << "answered";
}

TEST(PlannerRobots, ADispatchNobodyAnswersIsPlannedAgainAfterItsWindow) {
  Desk desk;
  desk.all_stand();
  desk.submit("a", "r1", r1_aside());
  for (int i = 0; i < 100; ++i) {
    desk.pass(10ms);
    desk.stands("r1", desk.robot("r1").start);
  }
  EXPECT_EQ(desk.dispatch_of("a").attempt, 2U);
}

TEST(PlannerRobots, AnswersToOlderPlansAreIgnored) {
  Desk desk;
  desk.all_stand();
  desk.submit("a", "r1", r1_aside());
  const auto first = desk.dispatch_of("a");
  desk.report(first, ExecutionState::refused);
  ASSERT_EQ(desk.dispatch_of("a").attempt, 2U);
  desk.report(first, ExecutionState::refused);
  desk.report(first, ExecutionState::accepted);
  desk.report(first, ExecutionState::withdrawn);
  EXPECT_EQ(desk.status_of("a").state, CommandState::scheduled);
  EXPECT_EQ(desk.dispatch_of("a").attempt, 2U);
}

/// A proxy never starts a command twice: asked again, it answers with the plan that it carried out, and that is what happened.
TEST(PlannerRobots, AnOlderPlanThatWasCarriedOutAfterAllCounts) {
  Desk desk;
  desk.all_stand();
  desk.submit("a", "r1", r1_aside());
  const auto first = desk.dispatch_of("a");
  for (int i = 0; i < 100 && desk.dispatch_of("a").attempt == 1; ++i) {
    desk.pass(10ms);
    desk.stands("r1", desk.robot("r1").start);
  }
  ASSERT_EQ(desk.dispatch_of("a").attempt, 2U);
  desk.report(first, ExecutionState::completed, desk.end_of(first));
  EXPECT_EQ(desk.status_of("a").state, CommandState::completed);
  EXPECT_EQ(desk.finals_of("a"), 1U);
  desk.submit("b", "r1", r1_home());
  EXPECT_EQ(desk.dispatch_of("b").from, desk.end_of(first));
}

TEST(PlannerRobots, RepeatedReportsChangeNothing) {
  Desk desk;
  desk.all_stand();
  desk.submit("a", "r1", r1_aside());
  const auto d = desk.dispatch_of("a");
  desk.begin(d);
  desk.begin(d);
  desk.finish(d);
  desk.finish(d);
  desk.report(d, ExecutionState::started);
  EXPECT_EQ(desk.finals_of("a"), 1U);
  EXPECT_EQ(desk.planner.state(desk.now).completed, 1U);
  EXPECT_EQ(desk.planner.state(desk.now).robots[0].mode, model::RobotMode::standby);
}

TEST(PlannerRobots, AJoggedRobotsQueueIsJudgedAnew) {
  Desk desk{experiment_cell(true), Desk::without_escapes()};
  desk.all_stand();
  desk.go("out", "r1", to_centre());
  desk.submit("in", "r2", to_centre());  // waits: r1 stands there
  ASSERT_EQ(desk.status_of("in").state, CommandState::waiting);
  const auto elsewhere = model::plan_motion(desk.robot("r2"), desk.robot("r2").start, r2_aside()).value().to();
  desk.posture("r2", elsewhere, true);
  EXPECT_EQ(desk.planner.state(desk.now).robots[1].mode, model::RobotMode::unknown) << "it moves and nobody told it to";
  desk.stands("r2", elsewhere);
  desk.submit("back", "r1", r1_home());
  desk.begin(desk.dispatch_of("back"));
  ASSERT_TRUE(desk.pass_until_dispatch());
  EXPECT_EQ(desk.dispatch_of("in").from, elsewhere);
}

TEST(PlannerRobots, ACommandImpossibleAfterAJogIsRejectedNotDropped) {
  Desk desk;
  desk.all_stand();
  desk.go("out", "r1", to_centre());
  desk.submit("in", "r2", to_centre());
  // Turned about its first axis until it faces away: the straight way to the centre leads through the arm's own base.
  model::Joints behind = desk.robot("r2").start;
  behind[0] = 170 * kPi / 180;
  desk.stands("r2", behind);
  EXPECT_EQ(desk.status_of("in").state, CommandState::rejected);
  EXPECT_NE(desk.status_of("in").text.find("no longer possible"), std::string::npos) << desk.status_of("in").text;
}

TEST(PlannerRobots, ARobotThatMovesByItselfTakesBackWhatWasSentNearIt) {
  Desk desk;
  desk.all_stand();
  desk.submit("a", "r2", r2_aside());
  desk.posture("r1", desk.robot("r1").start, true);
  ASSERT_EQ(desk.withdrawals.size(), 1U);
  EXPECT_EQ(desk.withdrawals[0].id.str(), "a");
}

TEST(PlannerRobots, ALostCompletionIsRepairedByThePosture) {
  Desk desk;
  desk.all_stand();
  desk.submit("a", "r1", r1_aside());
  const auto d = desk.dispatch_of("a");
  desk.begin(d);
  desk.now += model::from_seconds(d.duration) + 1s;
  desk.stands("r1", desk.end_of(d));
  EXPECT_EQ(desk.status_of("a").state, CommandState::completed);
  desk.submit("b", "r1", r1_home());
  EXPECT_EQ(desk.dispatch_of("b").from, desk.end_of(d));
}

TEST(PlannerRobots, AMotionThatEndedElsewhereHasFailed) {
  Desk desk;
  desk.all_stand();
  desk.submit("a", "r1", r1_aside());
  const auto d = desk.dispatch_of("a");
  desk.begin(d);
  desk.now += model::from_seconds(d.duration) + 1s;
  desk.stands("r1", d.from);
  EXPECT_EQ(desk.status_of("a").state, CommandState::failed);
  EXPECT_FALSE(desk.status_of("a").text.empty());
}

// A proxy or a controller that was restarted knows nothing of the motion: the robot is not where the planner thinks it passes.
TEST(PlannerRobots, ARobotThatStandsInTheMiddleOfItsMotionHasFailed) {
  Desk desk;
  desk.all_stand();
  desk.submit("a", "r1", r1_aside());
  const auto d = desk.dispatch_of("a");
  desk.begin(d);
  desk.pass(500ms);
  desk.posture("r1", desk.robot("r1").start, true, "a");
  EXPECT_EQ(desk.status_of("a").state, CommandState::started);
  desk.pass(100ms);
  desk.stands("r1", desk.robot("r1").start);
  EXPECT_EQ(desk.status_of("a").state, CommandState::failed);
  EXPECT_EQ(desk.planner.state(desk.now).robots[0].mode, model::RobotMode::standby);
}

TEST(PlannerRobots, AFailedMotionIsFinalAndItsRobotStandsWhereItSays) {
  Desk desk;
  desk.all_stand();
  desk.submit("a", "r1", r1_aside());
  desk.submit("b", "r1", r1_home());
  const auto d = desk.dispatch_of("a");
  desk.begin(d);
  const auto half = model::plan_motion(desk.robot("r1"), d.from, d.motion).value().joints(d.duration / 2);
  desk.report(d, ExecutionState::failed, half, "emergency stop");
  EXPECT_EQ(desk.status_of("a").state, CommandState::failed);
  EXPECT_EQ(desk.status_of("a").reason, Reason::controller_fault);
  EXPECT_EQ(desk.status_of("a").text, "emergency stop");
  EXPECT_EQ(desk.dispatch_of("b").from, half);
}

/// The report of the start is lost, the posture says that the robot is moving: it must not be taken for standing at its start.
TEST(PlannerRobots, ALostStartIsSeenFromThePosture) {
  Desk desk;
  desk.all_stand();
  desk.submit("a", "r1", to_centre());
  const auto d = desk.dispatch_of("a");
  desk.report(d, ExecutionState::accepted);
  const auto motion = model::plan_motion(desk.robot("r1"), d.from, d.motion).value();
  for (desk.now = d.latest + 10ms; desk.now < d.latest + 1s; desk.pass(10ms)) {
    desk.posture("r1", motion.joints(model::to_seconds(desk.now - d.earliest)), true, "a");
  }
  EXPECT_EQ(desk.dispatch_of("a").attempt, 1U) << "must not be planned again while it runs";
  EXPECT_EQ(desk.status_of("a").state, CommandState::started);
  desk.submit("in", "r2", to_centre());
  EXPECT_EQ(desk.dispatches_of("in"), 0U);
  desk.finish(d);
  EXPECT_EQ(desk.status_of("a").state, CommandState::completed);
}

/// Start and completion are lost, and the motion is over before the window's grace: the posture alone tells.
TEST(PlannerRobots, ALostMotionIsSeenFromThePosture) {
  Desk desk;
  desk.all_stand();
  desk.submit("a", "r1", r1_aside());
  const auto d = desk.dispatch_of("a");
  desk.now = d.latest + model::from_seconds(d.duration);
  for (int i = 0; i < 200; ++i) {
    desk.pass(10ms);
    desk.stands("r1", desk.end_of(d));
  }
  EXPECT_EQ(desk.status_of("a").state, CommandState::completed);
  EXPECT_EQ(desk.finals_of("a"), 1U);
  EXPECT_EQ(desk.dispatches_of("a"), 1U) << "done once";
}

/// Topics overtake each other: a posture from before the start, or from the motion, may come after the report that it ended.
TEST(PlannerRobots, APostureOlderThanAReportChangesNothing) {
  Desk desk{experiment_cell(true), Desk::without_escapes()};
  desk.all_stand();
  desk.go("a", "r1", to_centre());
  const auto d = desk.dispatch_of("a");
  model::PostureReported old;
  old.robot = model::RobotName{"r1"};
  old.joints = d.from;
  old.at = d.earliest - 10ms;
  (void)desk.planner.on(old, desk.now);
  desk.submit("in", "r2", to_centre());
  EXPECT_EQ(desk.status_of("in").state, CommandState::waiting) << "r1 stands at the centre, whatever an old posture says";
  old.moving = true;
  old.at = desk.now - 10ms;
  (void)desk.planner.on(old, desk.now);
  EXPECT_EQ(desk.planner.state(desk.now).robots[0].mode, model::RobotMode::standby);
}

}  // namespace
}  // namespace interlace::test
