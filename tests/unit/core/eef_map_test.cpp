#include <gtest/gtest.h>

#include "tests/unit/core/desk.hpp"

/// The collision map of end-effectors alone: it sees hands and nothing else.
namespace interlace::test {
namespace {

core::PlannerOptions with(const std::string& strategy) {
  auto options = Desk::usual();
  options.strategy = strategy;
  return options;
}

/// With r1's hand at (350, 0, 200), r2's hand passes 82 mm above it there, but the forearms would meet.
model::MotionRequest over_the_hand() {
  return line_to(pose_mm(450, 0, 330));
}

TEST(EefMap, DoesNotSeeThatForearmsMeet) {
  for (const std::string strategy : {"event", "eef-map"}) {
    Desk desk{experiment_cell(), with(strategy)};
    desk.all_stand();
    EXPECT_EQ(desk.planner.state(desk.now).strategy, strategy);
    desk.go("out", "r1", to_centre());
    desk.submit("in", "r2", over_the_hand());
    EXPECT_EQ(desk.dispatches_of("in"), strategy == "event" ? 0U : 1U) << strategy;
  }
}

TEST(EefMap, KeepsHandsApartAndNamesThem) {
  Desk desk{experiment_cell(), with("eef-map")};
  desk.all_stand();
  desk.go("out", "r1", to_centre());
  desk.submit("in", "r2", to_centre());
  const auto waiting = desk.status_of("in");
  EXPECT_EQ(waiting.reason, Reason::blocked);
  ASSERT_EQ(waiting.conflicts.size(), 1U);
  EXPECT_EQ(waiting.conflicts.front().own_link, "eef");
  EXPECT_EQ(waiting.conflicts.front().blocker_link, "eef");
  EXPECT_EQ(waiting.conflicts.front().until, model::kForever);
  desk.submit("back", "r1", r1_home());
  desk.begin(desk.dispatch_of("back"));
  EXPECT_EQ(desk.status_of("in").state, CommandState::scheduled);
  const auto start = desk.status_of("in").start;
  ASSERT_TRUE(start);
  EXPECT_LT(*start, desk.dispatch_of("back").earliest + model::from_seconds(desk.dispatch_of("back").duration));
}

TEST(EefMap, AnArmWithoutAHandIsInNobodysWay) {
  auto cell = experiment_cell();
  auto& capsules = cell->robots[0].model.capsules;
  capsules.pop_back();
  cell->robots[0].model.self_pairs.clear();
  Desk desk{cell, with("eef-map")};
  desk.all_stand();
  desk.go("out", "r1", to_centre());
  desk.submit("in", "r2", to_centre());
  EXPECT_EQ(desk.dispatches_of("in"), 1U);
}

TEST(EefMap, SeesALostRobotsHandAnywhereInItsReach) {
  auto options = with("eef-map");
  options.posture_timeout = 100ms;
  Desk desk{experiment_cell(), options};
  desk.stands("r1", desk.robot("r1").start);
  desk.submit("in", "r1", to_centre());
  EXPECT_EQ(desk.dispatches_of("in"), 0U);
  EXPECT_EQ(desk.status_of("in").reason, Reason::robot_unknown);
}

}  // namespace
}  // namespace interlace::test
