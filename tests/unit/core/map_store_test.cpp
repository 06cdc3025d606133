#include "planner/core/map_store.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/motions.hpp"

/// Kept maps: built once, forgotten with their motions, and never more than allowed.
namespace interlace::test {
namespace {

using core::SampledMotion;
using core::SampledMotionPtr;

SampledMotionPtr at_rest(const model::Robot& robot) {
  return std::make_shared<SampledMotion>(model::Motion::rest(robot, robot.start), 0.1);
}

SampledMotionPtr to_the_middle(const model::Robot& robot) {
  return std::make_shared<SampledMotion>(model::plan_motion(robot, robot.start, line_to(pose_mm(350, 0, 200))).value(), 0.1);
}

TEST(MapStore, KeepsMapsAsLongAsTheirMotionsLive) {
  const auto cell = experiment_cell();
  core::MapStore store{0, nullptr};
  const auto a = to_the_middle(cell->robots[0]);
  const auto b = to_the_middle(cell->robots[1]);
  const auto* first = &store.get(a, b);
  EXPECT_EQ(&store.get(a, b), first) << "built once";
  EXPECT_EQ(store.statistics().kept, 1U);
  (void)store.get(b, a);
  EXPECT_EQ(store.statistics().kept, 2U) << "the other way round is another map";
  for (int i = 0; i < 1000; ++i) (void)store.get(a, at_rest(cell->robots[1]));
  const auto s = store.statistics();
  EXPECT_LE(s.kept, core::MapLimits{}.maps) << "maps of motions that are gone are forgotten";
  EXPECT_EQ(s.built, 1002U);
  EXPECT_EQ(s.reused, 1U);
  EXPECT_EQ(s.evicted, 0U) << "and those of motions that live are not";
  EXPECT_EQ(&store.get(a, b), first);
}

TEST(MapStore, HoldsNoMoreMapsThanAllowedAndKeepsTheOnesInUse) {
  const auto cell = experiment_cell();
  core::MapLimits limits;
  limits.maps = 10;
  core::MapStore store{0, nullptr, limits};
  const auto a = to_the_middle(cell->robots[0]);
  const auto b = to_the_middle(cell->robots[1]);
  const auto* used = &store.get(a, b);
  std::vector<SampledMotionPtr> alive;
  for (int i = 0; i < 100; ++i) {
    alive.push_back(at_rest(cell->robots[1]));
    (void)store.get(a, alive.back());
    EXPECT_EQ(&store.get(a, b), used) << "asked for all the time";
    EXPECT_LE(store.statistics().kept, limits.maps);
  }
  EXPECT_GE(store.statistics().evicted, 80U);
  EXPECT_FALSE(store.holds(a, alive.front()));
  EXPECT_TRUE(store.holds(a, alive.back()));
}

TEST(MapStore, HoldsNoMoreBytesThanAllowed) {
  const auto cell = experiment_cell();
  const auto a = to_the_middle(cell->robots[0]);
  core::MapStore one{0, nullptr};
  const auto b = to_the_middle(cell->robots[1]);
  (void)one.get(a, b);
  const std::size_t bytes = one.statistics().bytes;
  ASSERT_GT(bytes, 1000U) << "two arms that reach for the same place block many cells";
  core::MapLimits limits;
  limits.bytes = 5 * bytes;
  core::MapStore store{0, nullptr, limits};
  std::vector<SampledMotionPtr> alive;
  for (int i = 0; i < 50; ++i) {
    alive.push_back(to_the_middle(cell->robots[1]));
    (void)store.get(a, alive.back());
    EXPECT_LE(store.statistics().bytes, limits.bytes + bytes) << "the newest comes on top";
  }
  EXPECT_GT(store.statistics().evicted, 0U);
}

TEST(MapStore, ACopySharesTheMapsAndGoesItsOwnWay) {
  const auto cell = experiment_cell();
  core::MapStore store{0, nullptr};
  const auto a = to_the_middle(cell->robots[0]);
  const auto b = to_the_middle(cell->robots[1]);
  const auto* map = &store.get(a, b);
  core::MapStore copy = store;
  EXPECT_EQ(&copy.get(a, b), map);
  (void)copy.get(b, a);
  EXPECT_FALSE(store.holds(b, a));
}

/// What a kept map forbids is what its cells forbid, however wide the uncertainty of both starts.
TEST(MapStore, ForbidsWhatTheCellsOfItsMapForbid) {
  Seed seed{75};
  const auto cell = experiment_cell();
  core::MapStore store{0, nullptr};
  const std::size_t cases = std::max<std::size_t>(scaled(300), 60);
  std::size_t forbidding = 0;
  for (std::size_t k = 0; k < cases; ++k) {
    auto robots = cell->robots;
    for (auto& r : robots) r.controller.speed_error = seed.chance(0.5) ? 0 : seed.uniform(0, 0.05);
    const auto a = std::make_shared<SampledMotion>(random_linear(seed, robots[0]), 0.05);
    const auto b = seed.chance(0.2)
                       ? std::make_shared<SampledMotion>(model::Motion::rest(robots[1], random_joints(seed, robots[1].model)), 0.05)
                       : std::make_shared<SampledMotion>(random_linear(seed, robots[1]), 0.05);
    core::StartUncertainty u;
    u.moving_from = model::at_seconds(seed.uniform(0, 5));
    u.moving_until = u.moving_from + model::from_seconds(seed.uniform(0, 0.2));
    u.moving_stretch = robots[1].controller.speed_error;
    u.commanded_stretch = robots[0].controller.speed_error;
    u.commanded_tolerance = model::from_seconds(seed.uniform(0, 0.1));
    const core::KeptMap& kept = store.get(a, b);
    std::vector<core::StartInterval> by_cell;
    for (const auto& f : core::forbidden_starts(kept.map, u)) by_cell.push_back(f.interval);
    std::vector<core::StartInterval> by_shift;
    for (const auto& shift : kept.forbidden) by_shift.push_back(core::forbidden_start(shift, u));
    by_cell = core::united(std::move(by_cell));
    by_shift = core::united(std::move(by_shift));
    ASSERT_EQ(by_cell.size(), by_shift.size()) << "case " << k;
    for (std::size_t i = 0; i < by_cell.size(); ++i) {
      EXPECT_EQ(by_cell[i].from, by_shift[i].from) << "case " << k;
      EXPECT_EQ(by_cell[i].until, by_shift[i].until) << "case " << k;
    }
    forbidding += by_cell.empty() ? 0 : 1;
  }
  EXPECT_GT(forbidding, cases / 10);
}

}  // namespace
}  // namespace interlace::test
