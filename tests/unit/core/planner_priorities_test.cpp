#include <gtest/gtest.h>

#include "tests/unit/core/desk.hpp"

/// Who goes first when commands of different robots compete.
namespace interlace::test {
namespace {

/// Places on the line between the two arms of which both can never be taken at once.
model::MotionRequest near_centre() {
  return line_to(pose_mm(360, 5, 210));
}

/// r1 and r2 both stand at home, not ready to start; both are told to go to the centre. Then both become ready in one event's reach.
Desk two_that_compete(int first, int second) {
  Desk desk;
  desk.all_stand();
  desk.posture("r1", desk.robot("r1").start, false, {}, false);
  desk.posture("r2", desk.robot("r2").start, false, {}, false);
  desk.submit("one", "r1", to_centre(), first);
  desk.submit("two", "r2", to_centre(), second);
  EXPECT_TRUE(desk.dispatches.empty());
  return desk;
}

TEST(PlannerPriorities, OfOneRobotChangeNothingInItsQueue) {
  Desk desk;
  desk.all_stand();
  desk.submit("a", "r1", r1_aside());
  desk.submit("b", "r1", r1_home(), 1);
  desk.submit("c", "r1", r1_aside(), 1000);
  for (const char* id : {"a", "b", "c"}) {
    if (desk.dispatches_of(id) == 0) {
      ASSERT_TRUE(desk.pass_until_dispatch());
    }
    EXPECT_EQ(desk.dispatches.back().id.str(), id);
    desk.carry_out(desk.dispatch_of(id));
  }
}

TEST(PlannerPriorities, TheHigherGoesFirstAndTheOtherSaysSo) {
  Desk desk;
  desk.all_stand();
  // r1 is under way to where it blocks both; what follows it competes with r2's.
  desk.submit("out", "r1", to_centre());
  desk.begin(desk.dispatch_of("out"));
  desk.submit("next", "r1", near_centre(), 0);
  desk.submit("urgent", "r2", to_centre(), 5);
  EXPECT_EQ(desk.status_of("urgent").state, CommandState::waiting);
  desk.finish(desk.dispatch_of("out"));
  // r1 could go on at once, but then r2 would wait again: room is made for r2.
  EXPECT_EQ(desk.dispatches_of("next"), 0U);
  EXPECT_EQ(desk.status_of("urgent").state, CommandState::scheduled) << desk.status_of("urgent").text;
  EXPECT_EQ(desk.status_of("urgent").reason, Reason::escape);
  EXPECT_EQ(desk.dispatches.back().robot.str(), "r1");
  EXPECT_EQ(desk.dispatches.back().id.str(), "escape-1");
}

TEST(PlannerPriorities, WithoutThemTheOneThatCanGoGoes) {
  Desk desk;
  desk.all_stand();
  desk.submit("out", "r1", to_centre());
  desk.begin(desk.dispatch_of("out"));
  desk.submit("next", "r1", near_centre());
  desk.submit("other", "r2", to_centre());
  desk.finish(desk.dispatch_of("out"));
  EXPECT_EQ(desk.dispatches_of("next"), 1U);
  EXPECT_EQ(desk.status_of("other").state, CommandState::waiting);
}

TEST(PlannerPriorities, TheLowerWaitsForTheHigherAndSaysSo) {
  auto options = Desk::usual();
  Desk desk{experiment_cell(true), options};
  desk.all_stand();
  desk.submit("out", "r1", to_centre());
  desk.begin(desk.dispatch_of("out"));
  desk.submit("next", "r1", near_centre(), -3);
  desk.submit("urgent", "r2", to_centre(), 5);
  desk.finish(desk.dispatch_of("out"));
  desk.carry_out(desk.dispatch_of("escape-1"));
  if (desk.dispatches_of("urgent") == 0) {
    ASSERT_TRUE(desk.pass_until_dispatch());
  }
  desk.carry_out(desk.dispatch_of("urgent"));
  // r2 stands at the centre and has nothing to do: it is sent away for `next`, which is the last that is left.
  EXPECT_EQ(desk.status_of("next").state, CommandState::scheduled) << desk.status_of("next").text;
  EXPECT_EQ(desk.status_of("next").reason, Reason::escape);
}

TEST(PlannerPriorities, WhatDoesNotCompeteIsNotHeldUp) {
  Desk desk;
  desk.all_stand();
  desk.submit("out", "r1", to_centre());
  desk.begin(desk.dispatch_of("out"));
  desk.submit("urgent", "r2", to_centre(), 5);
  desk.submit("away", "r1", r1_aside());
  desk.submit("far", "r3", line_to(pose_mm(300, 5250, 330)), -5);
  EXPECT_EQ(desk.dispatches_of("far"), 1U) << "r3 can meet nobody";
  desk.finish(desk.dispatch_of("out"));
  EXPECT_EQ(desk.dispatches_of("away"), 1U) << "it is what r2 waits for";
  EXPECT_EQ(desk.status_of("urgent").state, CommandState::scheduled) << "right behind it";
  EXPECT_EQ(desk.status_of("urgent").reason, Reason::delayed);
}

TEST(PlannerPriorities, TheHigherIsDecidedFirstOfTwoThatCouldBothGo) {
  for (const bool first_is_higher : {true, false}) {
    Desk desk = two_that_compete(first_is_higher ? 1 : 0, first_is_higher ? 0 : 1);
    desk.pass(1ms);
    // Both become ready by the same silence ending: r1 alone can go now, so r2's readiness is what decides.
    desk.posture(first_is_higher ? "r1" : "r2", desk.robot(first_is_higher ? "r1" : "r2").start, false);
    EXPECT_EQ(desk.dispatches.back().id.str(), first_is_higher ? "one" : "two");
  }
}

TEST(PlannerPriorities, NobodyGivesWayToOneThatCannotBeHelped) {
  Desk desk{experiment_cell(true), Desk::without_escapes()};
  desk.all_stand();
  desk.go("out", "r1", to_centre());
  desk.submit("urgent", "r2", to_centre(), 5);
  ASSERT_EQ(desk.status_of("urgent").state, CommandState::waiting);
  // Nobody may be sent away, so r1's next command is all that can change anything, though it stays in the way.
  desk.submit("next", "r1", near_centre());
  EXPECT_EQ(desk.dispatches_of("next"), 1U);
}

TEST(PlannerPriorities, NobodyGivesWayToOneThatIsNotHeardFrom) {
  auto options = Desk::usual();
  options.posture_timeout = 500ms;
  Desk desk{experiment_cell(true), options};
  desk.all_stand();
  desk.submit("out", "r1", to_centre());
  desk.begin(desk.dispatch_of("out"));
  desk.submit("next", "r1", near_centre());
  desk.submit("urgent", "r2", to_centre(), 5);
  const auto out = desk.dispatch_of("out");
  desk.now = out.earliest + model::from_seconds(out.duration) - 10ms;
  desk.posture("r1", out.from, true, "out");
  desk.pass(1ms);  // r2 is lost by now
  ASSERT_EQ(desk.planner.state(desk.now).robots[1].mode, model::RobotMode::unknown);
  desk.finish(out);
  EXPECT_EQ(desk.status_of("next").reason, Reason::robot_unknown) << "it waits for r2 as it would without any priority";
}

TEST(PlannerPriorities, PatienceEndsAboveEveryPriority) {
  auto options = Desk::usual();
  options.patience = 2s;
  Desk desk{experiment_cell(true), options};
  desk.all_stand();
  desk.submit("out", "r1", to_centre());
  desk.begin(desk.dispatch_of("out"));
  for (int i = 0; i < 20; ++i) desk.submit("flood-" + std::to_string(i), "r1", i % 2 == 0 ? near_centre() : to_centre(), 1'000'000);
  desk.submit("modest", "r2", to_centre(), -1'000'000);
  const Instant asked = desk.now;
  desk.finish(desk.dispatch_of("out"));
  ASSERT_GT(desk.now - asked, 2s);
  EXPECT_EQ(desk.dispatches_of("flood-0"), 0U);
  EXPECT_EQ(desk.status_of("modest").state, CommandState::scheduled) << desk.status_of("modest").text;
}

TEST(PlannerPriorities, PatienceThatHasNotEndedLetsTheFloodPass) {
  auto options = Desk::usual();
  options.patience = 1h;
  Desk desk{experiment_cell(true), options};
  desk.all_stand();
  desk.submit("out", "r1", to_centre());
  desk.begin(desk.dispatch_of("out"));
  for (int i = 0; i < 20; ++i) desk.submit("flood-" + std::to_string(i), "r1", i % 2 == 0 ? near_centre() : to_centre(), 1);
  desk.submit("modest", "r2", to_centre());
  desk.finish(desk.dispatch_of("out"));
  for (int i = 0; i < 20; ++i) {
    ASSERT_EQ(desk.dispatches.back().id.str(), "flood-" + std::to_string(i));
    desk.carry_out(desk.dispatches.back());
  }
  EXPECT_EQ(desk.status_of("modest").state, CommandState::scheduled);
}

}  // namespace
}  // namespace interlace::test
