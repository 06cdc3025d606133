#include <gtest/gtest.h>

#include "tests/unit/core/desk.hpp"

/// Who goes when: delays, deadlocks, departures, strategies, and the evidence for each.
namespace interlace::test {
namespace {

using model::ExecutionState;

TEST(PlannerMotion, ADelayedCommandSaysWhoWhichLinksAndUntilWhen) {
  Desk desk;
  desk.all_stand();
  desk.go("out", "r1", to_centre());
  auto slowly = r1_home();
  slowly.velocity = 0.03;
  desk.submit("back", "r1", slowly);
  desk.submit("in", "r2", to_centre());
  const auto status = desk.status_of("in");
  EXPECT_EQ(status.state, CommandState::scheduled);
  EXPECT_EQ(status.reason, Reason::delayed);
  ASSERT_TRUE(status.start);
  EXPECT_GT(status.delay, 0.1);
  EXPECT_NEAR(model::to_seconds(*status.start - (desk.now + 20ms)), status.delay, 1e-9);
  ASSERT_EQ(status.conflicts.size(), 1U);
  const auto& conflict = status.conflicts.front();
  EXPECT_EQ(conflict.blocker.str(), "r1");
  EXPECT_FALSE(conflict.own_link.empty());
  EXPECT_FALSE(conflict.blocker_link.empty());
  EXPECT_LE(conflict.from, desk.now + 20ms);
  EXPECT_LT(conflict.until, model::kForever);
  EXPECT_GE(*status.start, conflict.until);
  EXPECT_LT(conflict.clearance, 0);
  EXPECT_LT(std::abs(conflict.place.y()), 0.25) << "between the two bases";
  EXPECT_NE(status.text.find("r1's"), std::string::npos) << status.text;
}

TEST(PlannerMotion, AMotionThatMeetsNobodyStartsAtOnce) {
  Desk desk;
  desk.all_stand();
  desk.submit("a", "r1", r1_aside());
  desk.submit("b", "r2", r2_aside());
  desk.submit("c", "r3", line_to(pose_mm(300, 5250, 330)));
  for (const char* id : {"a", "b", "c"}) {
    EXPECT_EQ(desk.dispatch_of(id).earliest, desk.now + 20ms);
    EXPECT_EQ(desk.dispatch_of(id).latest, desk.now + 30ms);
    EXPECT_EQ(desk.status_of(id).delay, 0);
    EXPECT_TRUE(desk.status_of(id).conflicts.empty());
    EXPECT_TRUE(desk.status_of(id).text.empty());
  }
}

TEST(PlannerMotion, ADeadlockedCommandWaitsSaysWhyAndGoesWhenItCan) {
  Desk desk{experiment_cell(true), Desk::without_escapes()};
  desk.all_stand();
  desk.go("out", "r1", to_centre());
  desk.submit("in", "r2", to_centre());
  auto status = desk.status_of("in");
  EXPECT_EQ(status.state, CommandState::waiting);
  EXPECT_EQ(status.reason, Reason::blocked);
  ASSERT_EQ(status.conflicts.size(), 1U);
  EXPECT_EQ(status.conflicts.front().blocker.str(), "r1");
  EXPECT_EQ(status.conflicts.front().until, model::kForever);
  EXPECT_NE(status.text.find("cannot start"), std::string::npos) << status.text;
  const std::size_t said = desk.statuses.size();
  desk.pass(100s);
  EXPECT_EQ(desk.statuses.size(), said) << "nothing new, nothing said";
  EXPECT_EQ(desk.dispatches_of("in"), 0U);
  desk.submit("back", "r1", r1_home());
  desk.begin(desk.dispatch_of("back"));
  EXPECT_EQ(desk.status_of("in").state, CommandState::scheduled);
  ASSERT_TRUE(desk.pass_until_dispatch());
  EXPECT_EQ(desk.dispatches.back().id.str(), "in");
  desk.finish(desk.dispatch_of("back"));
  desk.carry_out(desk.dispatch_of("in"));
  EXPECT_EQ(desk.status_of("in").state, CommandState::completed);
}

TEST(PlannerMotion, ABlockedRobotDoesNotHoldUpOthers) {
  Desk desk;
  desk.all_stand();
  desk.go("out", "r1", to_centre());
  desk.submit("in", "r2", to_centre());
  desk.submit("free", "r3", line_to(pose_mm(300, 5250, 330)));
  EXPECT_EQ(desk.dispatches_of("free"), 1U);
}

TEST(PlannerMotion, WhoWaitsForADepartureIsSentOnlyAfterIt) {
  Desk desk;
  desk.all_stand();
  desk.go("out", "r1", to_centre());
  desk.submit("back", "r1", r1_home());
  desk.submit("in", "r2", to_centre());
  const auto back = desk.dispatch_of("back");
  const auto planned = desk.status_of("in").start.value();
  desk.report(back, ExecutionState::accepted);
  // Neither started nor refused: however long that lasts, nobody is sent into its place.
  while (desk.now < planned + 5s) {
    desk.pass(100ms);
    desk.stands("r1", back.from);
    desk.stands("r2", desk.robot("r2").start);
    ASSERT_EQ(desk.dispatches_of("in"), 0U) << model::to_seconds(desk.now);
  }
}

TEST(PlannerMotion, AStartBreaksNoPromiseWhenTheDepartureIsLate) {
  Desk desk;
  desk.all_stand();
  desk.go("out", "r1", to_centre());
  desk.submit("back", "r1", r1_home());
  desk.submit("in", "r2", to_centre());
  const auto back = desk.dispatch_of("back");
  desk.now = back.latest;
  desk.report(back, ExecutionState::started);
  ASSERT_TRUE(desk.pass_until_dispatch());
  const auto in = desk.dispatch_of("in");
  EXPECT_EQ(in.id.str(), "in");
  EXPECT_GE(in.earliest, desk.now);
}

TEST(PlannerMotion, DirectStartsEverythingAtOnce) {
  auto options = Desk::usual();
  options.strategy = "direct";
  Desk desk{experiment_cell(), options};
  desk.all_stand();
  desk.submit("a", "r1", to_centre());
  desk.submit("b", "r2", to_centre());
  EXPECT_EQ(desk.dispatches.size(), 2U);
  EXPECT_EQ(desk.planner.state(desk.now).strategy, "direct");
}

TEST(PlannerMotion, AMarginKeepsRobotsFurtherApart) {
  // Passing at a distance that touches nothing is refused as soon as the margin is larger than it.
  const auto delay_with = [](double margin) {
    auto cell = experiment_cell();
    cell->planning.margin = margin;
    Desk desk{cell, Desk::without_escapes()};
    desk.all_stand();
    desk.submit("a", "r1", line_to(pose_mm(450, 150, 300)));
    desk.submit("b", "r2", line_to(pose_mm(450, -150, 300)));
    return desk.status_of("b").state;
  };
  EXPECT_EQ(delay_with(0), CommandState::scheduled);
  EXPECT_EQ(delay_with(0.2), CommandState::waiting);
}

TEST(PlannerMotion, StateTellsModesQueuesAndReasons) {
  Desk desk{experiment_cell(true), Desk::without_escapes()};
  EXPECT_EQ(desk.planner.state(desk.now).robots[0].mode, model::RobotMode::unknown);
  desk.all_stand();
  desk.go("out", "r1", to_centre());
  desk.submit("in", "r2", to_centre());
  desk.submit("home", "r2", r2_home());
  desk.submit("far", "r3", line_to(pose_mm(300, 5250, 330)));
  desk.begin(desk.dispatch_of("far"));
  const auto state = desk.planner.state(desk.now);
  ASSERT_EQ(state.robots.size(), 3U);
  EXPECT_EQ(state.robots[0].mode, model::RobotMode::standby);
  EXPECT_EQ(state.robots[1].mode, model::RobotMode::commanded);
  EXPECT_EQ(state.robots[1].queued, 2U);
  EXPECT_EQ(state.robots[1].current.str(), "in");
  EXPECT_EQ(state.robots[1].reason, Reason::blocked);
  EXPECT_EQ(state.robots[1].conflicts.size(), 1U);
  EXPECT_EQ(state.robots[2].mode, model::RobotMode::moving);
  EXPECT_EQ(state.accepted, 4U);
  EXPECT_EQ(state.completed, 1U);
}

}  // namespace
}  // namespace interlace::test
