#include <gtest/gtest.h>

#include "tests/unit/core/desk.hpp"

/// What is prepared between decisions is what they ask for, and changes none of them.
namespace interlace::test {
namespace {

std::size_t built(Desk& desk) {
  return desk.planner.maps().statistics().built;
}

TEST(PlannerPrepare, TheNextDecisionsBuildNothing) {
  Desk desk{experiment_cell()};
  desk.all_stand();
  desk.submit("a", "r1", to_centre());
  desk.submit("a-back", "r1", r1_home());
  desk.submit("b", "r2", to_centre());
  desk.submit("b-back", "r2", r2_home());
  desk.begin(desk.dispatch_of("a"));
  std::size_t prepared = 0;
  while (desk.planner.prepare()) {
    EXPECT_EQ(built(desk), ++prepared + 2) << "one map for each call; two were needed for the first decisions";
  }
  EXPECT_GT(prepared, 0U);
  const std::size_t before = built(desk);
  desk.finish(desk.dispatch_of("a"));
  EXPECT_EQ(desk.dispatches_of("a-back"), 1U);
  EXPECT_EQ(built(desk), before) << "all that this decision needed was there";
}

TEST(PlannerPrepare, NothingIsBuiltTwiceAndNothingWithoutCommands) {
  Desk desk{experiment_cell()};
  desk.all_stand();
  EXPECT_FALSE(desk.planner.prepare()) << "nobody has anything to do";
  desk.go("a", "r1", r1_aside());
  desk.submit("b", "r2", to_centre());
  while (desk.planner.prepare()) {
  }
  const std::size_t before = built(desk);
  EXPECT_FALSE(desk.planner.prepare());
  EXPECT_EQ(built(desk), before);
}

TEST(PlannerPrepare, AStrategyThatLooksAtNoMapsPreparesNone) {
  auto options = Desk::usual();
  options.strategy = "direct";
  Desk desk{experiment_cell(), options};
  desk.all_stand();
  desk.submit("a", "r1", to_centre());
  desk.submit("a-back", "r1", r1_home());
  EXPECT_FALSE(desk.planner.prepare());
}

}  // namespace
}  // namespace interlace::test
