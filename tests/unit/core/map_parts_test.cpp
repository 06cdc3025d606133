#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "planner/core/collision_map.hpp"
#include "planner/core/reach.hpp"
#include "planner/core/strategy.hpp"
#include "tests/support/motions.hpp"

/// The parts that maps are made of and what is made of maps.
namespace interlace::test {
namespace {

using core::kNever;
using core::SampledMotion;

core::SampledMotionPtr sampled(const model::Robot& robot, const model::Joints& from, const model::Pose& X_WT, double resolution = 0.01) {
  return std::make_shared<SampledMotion>(model::plan_motion(robot, from, line_to(X_WT)).value(), resolution);
}

TEST(SampledMotion, PiecesOfALevelCoverTheDurationWithoutGaps) {
  const auto cell = experiment_cell();
  const auto motion = sampled(cell->robots[0], cell->robots[0].start, pose_mm(350, 0, 200));
  for (int level = 0; level <= motion->depth(); level += 3) {
    const std::size_t count = std::size_t{1} << level;
    double end = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const auto& piece = motion->piece(level, i);
      EXPECT_NEAR(piece.t0, end, 1e-12);
      EXPECT_NEAR(piece.centre, (piece.t0 + piece.t1) / 2, 1e-12);
      ASSERT_EQ(piece.reach.size(), piece.bodies.size());
      end = piece.t1;
    }
    EXPECT_NEAR(end, motion->motion().duration(), 1e-9);
  }
  EXPECT_LE(motion->motion().duration() / std::pow(2.0, motion->depth()), 0.01);
}

/// Bodies that are asked for one by one, in any order, are those of the whole arm.
TEST(SampledMotion, OfWhichSomeBodiesAreAskedForIsTheSame) {
  Seed seed{77};
  for (std::size_t k = 0; k < scaled(200); ++k) {
    model::Robot robot = robot_at("r", seed.chance(0.5) ? arm4() : random_arm(seed), {0, 0, 0});
    give_joint_rates(robot);
    const model::Motion motion = seed.chance(0.3) ? random_joint_move(seed, robot) : random_linear(seed, robot);
    SampledMotion whole{motion, 0.05};
    SampledMotion parts{motion, 0.05};
    const int level = static_cast<int>(seed.below(static_cast<std::size_t>(whole.finest()) + 1));
    const std::size_t index = seed.below(std::size_t{1} << level);
    const std::size_t bodies = robot.model.capsules.size();
    for (std::size_t i = 0; i < 3 * bodies; ++i) {
      const std::size_t body = seed.below(bodies);
      const auto& piece = parts.piece(level, index, model::only_capsule(body));
      const auto& all = whole.piece(level, index);
      EXPECT_EQ(piece.reach[body], all.reach[body]) << "case " << k;
      EXPECT_EQ(piece.bodies[body].a, all.bodies[body].a) << "case " << k;
      EXPECT_EQ(piece.bodies[body].b, all.bodies[body].b) << "case " << k;
    }
  }
}

TEST(SampledMotion, StandingHasOnePieceThatDoesNotMove) {
  const auto cell = experiment_cell();
  SampledMotion still{model::Motion::rest(cell->robots[0], cell->robots[0].start), 0.01};
  EXPECT_EQ(still.depth(), 0);
  for (const double reach : still.piece(0, 0).reach) EXPECT_EQ(reach, 0);
  EXPECT_EQ(&still.at_start(), &still);
  EXPECT_EQ(&still.at_end(), &still);
}

/// A robot that may leave its path is kept at a distance by as much.
TEST(TimingMap, PathErrorsWidenTheMargin) {
  const auto cell = experiment_cell();
  auto careless = *cell;
  careless.robots[0].controller.path_error = 0.010;
  careless.robots[1].controller.path_error = 0.005;
  const auto map_of = [](const model::Cell& c, double margin) {
    const auto a = sampled(c.robots[0], c.robots[0].start, pose_mm(350, 0, 200));
    const auto b = sampled(c.robots[1], c.robots[1].start, pose_mm(350, 0, 200));
    return core::build_timing_map(*a, *b, margin);
  };
  const auto with_errors = map_of(careless, 0.002);
  const auto with_margin = map_of(*cell, 0.017);
  EXPECT_GT(with_errors.blocked.size(), 0U);
  ASSERT_EQ(with_errors.blocked.size(), with_margin.blocked.size());
  for (std::size_t i = 0; i < with_errors.blocked.size(); ++i) {
    EXPECT_EQ(with_errors.blocked[i].t0, with_margin.blocked[i].t0);
    EXPECT_EQ(with_errors.blocked[i].tau1, with_margin.blocked[i].tau1);
  }
  EXPECT_GT(core::reachable_volume(careless.robots[0]).radius, core::reachable_volume(cell->robots[0]).radius + 0.0099);
}

TEST(TimingMap, OfTwoThatStandTogetherBlocksForEver) {
  const auto cell = experiment_cell();
  const auto in = sampled(cell->robots[1], cell->robots[1].start, pose_mm(350, 0, 200));
  const auto out = sampled(cell->robots[0], cell->robots[0].start, pose_mm(350, 0, 200));
  SampledMotion there{model::Motion::rest(cell->robots[0], out->motion().to()), 0.01};
  const auto map = core::build_timing_map(*in, there, 0);
  ASSERT_FALSE(map.blocked.empty());
  EXPECT_TRUE(std::any_of(map.blocked.begin(), map.blocked.end(), [](const auto& c) { return c.tau1 == kNever && c.t1 == kNever; }));
  std::vector<core::StartInterval> forbidden;
  for (const auto& f : core::forbidden_starts(map, {})) forbidden.push_back(f.interval);
  EXPECT_TRUE(core::complement(core::united(forbidden), core::Instant{}).empty());
}

TEST(TimingMap, AMarginOnlyAddsBlockedStarts) {
  const auto cell = experiment_cell();
  const auto a = sampled(cell->robots[0], cell->robots[0].start, pose_mm(400, 60, 250));
  const auto b = sampled(cell->robots[1], cell->robots[1].start, pose_mm(400, -60, 250));
  EXPECT_GE(core::build_timing_map(*a, *b, 0.05).blocked.size(), core::build_timing_map(*a, *b, 0).blocked.size());
  EXPECT_FALSE(core::build_timing_map(*a, *b, 0.3).blocked.empty());
}

TEST(CollisionMap, ShowsTheTravellingLengthOfTheCommandedRobot) {
  const auto cell = experiment_cell();
  const auto a = sampled(cell->robots[0], cell->robots[0].start, pose_mm(350, 0, 200));
  const auto b = sampled(cell->robots[1], cell->robots[1].start, pose_mm(350, 0, 200));
  const auto map = core::build_timing_map(*a, *b, 0);
  const auto areas = core::collision_map(map, a->motion());
  ASSERT_EQ(areas.size(), map.blocked.size());
  ASSERT_FALSE(areas.empty());
  const double whole = a->motion().length(a->motion().duration());
  for (std::size_t i = 0; i < areas.size(); ++i) {
    EXPECT_LE(areas[i].length0, areas[i].length1);
    EXPECT_GE(areas[i].length0, 0);
    EXPECT_LE(areas[i].length1, whole + 1e-12);
    EXPECT_EQ(areas[i].t0, map.blocked[i].t0);
    EXPECT_TRUE(map.blocked[i].tau1 != kNever || areas[i].length1 == whole);
  }
}

TEST(Reach, OfANeighbourIsEnteredAndOfAFarRobotIsNot) {
  const auto cell = experiment_cell(true);
  const auto motion = sampled(cell->robots[0], cell->robots[0].start, pose_mm(300, 250, 330));
  EXPECT_TRUE(core::enters_reach(*motion, core::reachable_volume(cell->robots[1])));
  EXPECT_FALSE(core::enters_reach(*motion, core::reachable_volume(cell->robots[2])));
}

/// Nothing a robot can do takes any of its points out of the reach that a lost robot is given.
TEST(Reach, HoldsEveryPostureOfAnyArm) {
  Seed seed{10};
  for (int i = 0; i < 3000; ++i) {
    const model::Robot other = robot_at("other", random_arm(seed), random_point(seed, 0.5), seed.uniform(-kPi, kPi));
    std::vector<model::Capsule> bodies;
    model::place_capsules(other.model, other.X_WB, random_joints(seed, other.model), bodies);
    // A probe: a robot whose only body is a ball that touches a random point of the other one.
    const auto& touched = bodies[seed.below(bodies.size())];
    model::RobotModel ball = arm4();
    ball.capsules = {{"ball", 0, model::Vector3::Zero(), model::Vector3::Zero(), 1e-6}};
    ball.self_pairs.clear();
    const model::Robot probe = robot_at("probe", ball, touched.a + touched.radius * (random_rotation(seed) * model::Vector3::UnitX()));
    SampledMotion still{model::Motion::rest(probe, model::Joints::Zero()), 0.01};
    ASSERT_TRUE(core::enters_reach(still, core::reachable_volume(other))) << "case " << i;
  }
}

}  // namespace
}  // namespace interlace::test
