#include <gtest/gtest.h>

#include <algorithm>

#include "planner/core/escape_goal.hpp"
#include "tests/support/arms.hpp"

/// The dissertation's cuboid (C.1a, c, e) adds the radius of a link on the lower side too, where it must be subtracted.
namespace interlace::test {
namespace {

using core::Cuboid;
using model::Vector3;

/// Equation C.1 as published: joints 1 … n with the radii of the links they join.
Cuboid published(const std::vector<model::Capsule>& links) {
  Cuboid box{Vector3::Constant(1e9), Vector3::Constant(-1e9)};
  for (const auto& link : links) {
    for (const Vector3& joint : {link.a, link.b}) {
      const Vector3 with_radius = joint + Vector3::Constant(link.radius);
      box.min = box.min.cwiseMin(with_radius);
      box.max = box.max.cwiseMax(with_radius);
    }
  }
  return box;
}

std::vector<model::Capsule> moving_links(const model::Robot& robot) {
  std::vector<model::Capsule> all;
  model::place_capsules(robot.model, robot.X_WB, robot.start, all);
  std::vector<model::Capsule> moving;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (robot.model.capsules[i].link > 0) moving.push_back(all[i]);
  }
  return moving;
}

TEST(SweptCuboidC1, LeavesOutTheLowerSideOfTheArm) {
  const auto cell = experiment_cell();
  const model::Robot& robot = cell->robots[0];
  const auto links = moving_links(robot);
  const Cuboid theirs = published(links);
  const Cuboid ours = core::swept_cuboid(model::Motion::rest(robot, robot.start));
  EXPECT_LT((theirs.max - ours.max).norm(), 1e-12) << "the upper sides agree";
  for (int axis = 0; axis < 3; ++axis) {
    double lowest = 1e9;
    for (const auto& link : links) lowest = std::min({lowest, link.a[axis] - link.radius, link.b[axis] - link.radius});
    EXPECT_NEAR(ours.min[axis], lowest, 1e-12) << "axis " << axis;
    EXPECT_GT(theirs.min[axis], lowest + 2 * 0.048 - 1e-9) << "two radii of the thinnest link are missing at least, axis " << axis;
  }
  // The arm stands straight in the plane y = 250 mm: as published, its own axes would lie outside its cuboid.
  EXPECT_GT(theirs.min.y(), 0.250);
}

TEST(SweptCuboidC1, OrdersTheDirectionsOfAnEscapeWrongly) {
  // 12 mm above the middle in y, and far from the other faces: the upper face is the nearer one, as published the lower one.
  const auto cell = experiment_cell();
  const model::Robot& robot = cell->robots[0];
  const Cuboid theirs = published(moving_links(robot));
  const Cuboid ours = core::swept_cuboid(model::Motion::rest(robot, robot.start));
  const Vector3 p{ours.min.x() - 2, 0.262, ours.min.z() - 2};
  const auto right = core::escape_directions(ours, p).front();
  EXPECT_EQ(right.way, model::EscapeWay::plus_y);
  EXPECT_NEAR(right.distance, 0.250 + 0.117 - 0.262, 1e-9);
  EXPECT_EQ(core::escape_directions(theirs, p).front().way, model::EscapeWay::minus_y);
}

}  // namespace
}  // namespace interlace::test
