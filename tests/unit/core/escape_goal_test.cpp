#include "planner/core/escape_goal.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "tests/support/motions.hpp"

/// Where an escape may go: the cuboid, the order of the directions, the reachable goal, and the parts of a motion.
namespace interlace::test {
namespace {

using core::Cuboid;
using model::EscapeWay;
using model::Vector3;

/// Box around the moving capsules of `motion` at `steps` + 1 equal steps of its time, by its own loop.
Cuboid box_of(const model::Motion& motion, int steps) {
  const model::Robot& robot = motion.robot();
  Cuboid box{Vector3::Constant(1e9), Vector3::Constant(-1e9)};
  std::vector<model::Capsule> placed;
  for (int i = 0; i <= steps; ++i) {
    model::place_capsules(robot.model, robot.X_WB, motion.joints(motion.duration() * i / std::max(steps, 1)), placed);
    for (std::size_t k = 0; k < placed.size(); ++k) {
      if (robot.model.capsules[k].link == 0) continue;
      for (int axis = 0; axis < 3; ++axis) {
        box.min[axis] = std::min({box.min[axis], placed[k].a[axis] - placed[k].radius, placed[k].b[axis] - placed[k].radius});
        box.max[axis] = std::max({box.max[axis], placed[k].a[axis] + placed[k].radius, placed[k].b[axis] + placed[k].radius});
      }
    }
  }
  return box;
}

TEST(SweptCuboid, HoldsAllCapsulesOfTheMotionAndIsTight) {
  // Between two of the planner's 64 steps a capsule may pass the face, by no more than it moves between there and the nearer step. The
  // dense samples hold the planner's, so their box is nowhere smaller.
  constexpr int kSteps = 64;
  constexpr double kRounding = 1e-9;
  Seed seed{41};
  double farthest = 0;
  std::vector<double> moved;
  for (std::size_t i = 0; i < scaled(150); ++i) {
    model::Robot robot = robot_at("r", i % 2 == 0 ? arm4() : offset_arm(), random_point(seed, 2), seed.uniform(-kPi, kPi));
    give_joint_rates(robot);
    const model::Motion motion = i % 3 == 0 ? random_joint_move(seed, robot) : random_linear(seed, robot);
    const Cuboid cuboid = core::swept_cuboid(motion);
    const Cuboid dense = box_of(motion, kSteps * 25);
    double tolerance = kRounding;
    for (int step = 0; step < kSteps; ++step) {
      const double t0 = motion.duration() * step / kSteps;
      const double t1 = motion.duration() * (step + 1) / kSteps;
      for (const double end : {t0, t1}) {
        motion.displacement(std::min(end, (t0 + t1) / 2), end, std::max(end, (t0 + t1) / 2), moved);
        tolerance = std::max(tolerance, *std::max_element(moved.begin(), moved.end()));
      }
    }
    for (int axis = 0; axis < 3; ++axis) {
      ASSERT_GE(dense.max[axis], cuboid.max[axis] - kRounding) << "loose, motion " << i << ", axis " << axis;
      ASSERT_LE(dense.min[axis], cuboid.min[axis] + kRounding) << "loose, motion " << i << ", axis " << axis;
      const double out = std::max(dense.max[axis] - cuboid.max[axis], cuboid.min[axis] - dense.min[axis]);
      ASSERT_LE(out, tolerance) << "motion " << i << ", axis " << axis;
      farthest = std::max(farthest, out);
    }
  }
  std::printf("capsules stick out by %.3f mm at most\n", 1e3 * farthest);
}

TEST(SweptCuboid, OfAStandingRobotIsTheBoxAroundIt) {
  const auto cell = experiment_cell();
  const auto rest = model::Motion::rest(cell->robots[0], cell->robots[0].start);
  const Cuboid cuboid = core::swept_cuboid(rest);
  const Cuboid own = box_of(rest, 0);
  EXPECT_LT((cuboid.min - own.min).norm(), 1e-12);
  EXPECT_LT((cuboid.max - own.max).norm(), 1e-12);
  // The end-effector's tip is at x = 450 mm and 48 mm thick: the upper face lies beyond it, and nothing else reaches as far.
  EXPECT_NEAR(cuboid.max.x(), 0.450 + 0.048, 1e-9);
  // At the sides the thickest moving link, 117 mm, straight in the plane y = 250 mm.
  EXPECT_NEAR(cuboid.min.y(), 0.250 - 0.117, 1e-9);
  EXPECT_NEAR(cuboid.max.y(), 0.250 + 0.117, 1e-9);
}

TEST(EscapeDirections, AreTheSixAxesNearestFaceFirst) {
  Seed seed{42};
  for (int i = 0; i < 1000; ++i) {
    const Vector3 a = random_point(seed, 1);
    const Vector3 b = random_point(seed, 1);
    const Cuboid cuboid{a.cwiseMin(b), a.cwiseMax(b)};
    const Vector3 p = random_point(seed, 2);
    const auto directions = core::escape_directions(cuboid, p);
    std::map<EscapeWay, Vector3> units;
    for (std::size_t k = 0; k < directions.size(); ++k) {
      const auto& d = directions[k];
      units[d.way] = d.unit;
      if (k > 0) {
        ASSERT_GE(d.distance, directions[k - 1].distance);
      }
      Eigen::Index axis = 0;
      d.unit.cwiseAbs().maxCoeff(&axis);
      const double face = d.unit[axis] > 0 ? cuboid.max[axis] : cuboid.min[axis];
      ASSERT_NEAR(d.distance, std::abs(face - p[axis]), 1e-12) << "to the face that lies that way";
    }
    ASSERT_EQ(units.size(), 6U);
    ASSERT_EQ(units[EscapeWay::plus_x], Vector3::UnitX());
    ASSERT_EQ(units[EscapeWay::minus_x], -Vector3::UnitX());
    ASSERT_EQ(units[EscapeWay::plus_y], Vector3::UnitY());
    ASSERT_EQ(units[EscapeWay::minus_y], -Vector3::UnitY());
    ASSERT_EQ(units[EscapeWay::plus_z], Vector3::UnitZ());
    ASSERT_EQ(units[EscapeWay::minus_z], -Vector3::UnitZ());
  }
}

/// Robot `r1` of the experiments at joints where it is clear of itself and of the bases by 5 mm.
model::Joints random_place(Seed& seed, const model::Cell& cell) {
  for (;;) {
    const model::Joints q = random_joints(seed, cell.robots[0].model);
    core::SampledMotion rest{model::Motion::rest(cell.robots[0], q), cell.planning.resolution};
    if (!core::path_collision(rest, cell, 0, 5e-3)) return q;
  }
}

TEST(ReachableGoal, IsOnTheBorderAndKeepsTheOrientation) {
  // 5 mm: 2 mm kept back from where a path became impossible, and the places of a path that are looked at lie up to 2 mm apart.
  // A path that only just passes a body may be refused at one length and not at another, where its pieces lie differently: a margin of
  // 2 mm settles that.
  constexpr double kBorder = 5e-3;
  Seed seed{43};
  const auto cell = experiment_cell();
  const auto strict = experiment_cell();
  strict->planning.margin = 2e-3;
  int goals = 0;
  int none = 0;
  for (std::size_t i = 0; i < scaled(60); ++i) {
    const model::Joints from = random_place(seed, *cell);
    const model::Pose X_WT = cell->robots[0].X_WB * model::tcp_pose(cell->robots[0].model, from);
    for (int axis = 0; axis < 3; ++axis) {
      for (const double sign : {1.0, -1.0}) {
        const Vector3 unit = sign * Vector3::Unit(axis);
        const auto goal = core::to_reachable_goal(*cell, 0, cell->robots[0], from, unit);
        if (!goal.motion) {
          ++none;
          model::Pose near = X_WT;
          near.translation() += 2 * kBorder * unit;
          EXPECT_FALSE(core::admit(*strict, 0, strict->robots[0], from, line_to(near)))
              << "posture " << i << ", axis " << axis << ", " << sign;
          continue;
        }
        ++goals;
        const model::Motion& motion = goal.motion->motion();
        const model::Pose X_WG = motion.tcp(motion.duration());
        const Vector3 way = X_WG.translation() - X_WT.translation();
        EXPECT_LT((way - way.dot(unit) * unit).norm(), 1e-9) << "along the axis";
        EXPECT_GT(way.dot(unit), 0);
        EXPECT_LT((X_WG.linear() - X_WT.linear()).norm(), 1e-9) << "orientation kept";
        EXPECT_TRUE(core::admit(*cell, 0, cell->robots[0], from, goal.request)) << "the goal itself";
        model::Pose beyond = X_WG;
        beyond.translation() += kBorder * unit;
        EXPECT_FALSE(core::admit(*strict, 0, strict->robots[0], from, line_to(beyond)))
            << "posture " << i << ", axis " << axis << ", " << sign << ": " << way.dot(unit) << " m and " << kBorder << " m more";
      }
    }
  }
  std::printf("%d goals, %d times none\n", goals, none);
  EXPECT_GT(goals, 0);
  if (scaled(60) >= 60) {
    EXPECT_GT(none, 0) << "a shortened run may meet none";
  }
}

TEST(ReachableGoal, StopsBeforeTheBaseOfANeighbour) {
  // Low, towards the other robot's base at y = −250 mm: within the arm's reach, but its body may not go there.
  const auto cell = experiment_cell();
  const model::Robot& r1 = cell->robots[0];
  const auto posture = model::preferred_posture(r1.model, r1.X_WB.inverse() * pose_mm(150, 100, 200));
  ASSERT_TRUE(posture);
  const model::Joints& from = *posture;
  const auto goal = core::to_reachable_goal(*cell, 0, cell->robots[0], from, -Vector3::UnitY());
  ASSERT_TRUE(goal.motion);
  const Vector3 end = goal.motion->motion().tcp(goal.motion->motion().duration()).translation();
  model::Pose beyond = pose_mm(0, 0, 0);
  beyond.linear() = goal.motion->motion().tcp(0).linear();
  beyond.translation() = end - 5e-3 * Vector3::UnitY();
  const auto refused = core::admit(*cell, 0, cell->robots[0], from, line_to(beyond));
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().reason, model::Reason::base_collision) << refused.error().text;
}

TEST(Shortened, CoversTheAskedLengthOfTheSamePath) {
  constexpr double kTolerance = 1e-6;  // [m]
  Seed seed{44};
  for (std::size_t i = 0; i < scaled(300); ++i) {
    const model::Robot robot = robot_at("r", arm4(), {0, 0, 0});
    const model::Motion motion = random_linear(seed, robot);
    const double whole = motion.length(motion.duration());
    if (whole < 1e-3) continue;
    const double length = seed.uniform(0, whole);
    const auto request = core::shortened(motion, length);
    const auto& X_WG = std::get<model::LinearTarget>(request.target).X_WT;
    const Vector3 start = motion.tcp(0).translation();
    const Vector3 along = (motion.tcp(motion.duration()).translation() - start).normalized();
    ASSERT_NEAR((X_WG.translation() - start).dot(along), length, kTolerance) << "motion " << i;
    ASSERT_LT((X_WG.translation() - start - length * along).norm(), kTolerance) << "on the line, motion " << i;
    // The orientation is the one the whole motion has there: found by a fine walk along it.
    double nearest = 1e9;
    for (int k = 0; k <= 20000; ++k) {
      const model::Pose X = motion.tcp(motion.duration() * k / 20000);
      if (std::abs((X.translation() - start).norm() - length) < 1e-4) nearest = std::min(nearest, (X.linear() - X_WG.linear()).norm());
    }
    ASSERT_LT(nearest, 1e-2) << "motion " << i;
  }
}

TEST(Undoing, LeadsBackToTheJointsItCameFrom) {
  constexpr double kTolerance = 1e-9;  // [rad]
  Seed seed{45};
  model::Robot robot = robot_at("r", arm4(), {0, 0, 0}, 0.3);
  give_joint_rates(robot, 100, 100);
  int lines = 0;
  int joint_moves = 0;
  double worst = 0;
  for (std::size_t i = 0; i < scaled(400); ++i) {
    const model::Motion motion = i % 2 == 0 ? random_linear(seed, robot) : random_joint_move(seed, robot);
    const auto back = model::plan_motion(robot, motion.to(), core::undoing(motion));
    ASSERT_TRUE(back) << "motion " << i << ": " << back.error().text;
    worst = std::max(worst, (back->to() - motion.from()).cwiseAbs().maxCoeff());
    ASSERT_LE(worst, kTolerance) << "motion " << i << (motion.is_linear() ? ", linear" : ", joint");
    ++(motion.is_linear() ? lines : joint_moves);
  }
  std::printf("%d lines and %d joint moves undone, %.2e rad off at most\n", lines, joint_moves, worst);
  EXPECT_GT(lines, 0);
  EXPECT_GT(joint_moves, 0);
}

}  // namespace
}  // namespace interlace::test
