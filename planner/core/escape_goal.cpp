#include "planner/core/escape_goal.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "planner/core/reach.hpp"

namespace interlace::core {

namespace {

constexpr int kSweepSamples = 64;         // of a motion: far apart compared with the box, near compared with what it is for
constexpr double kShortest = 0.005;       // [m]: a shorter escape leads nowhere
constexpr double kBackFromBorder = 2e-3;  // [m] kept from the place where a path became impossible
constexpr int kTries = 16;

}  // namespace

Cuboid swept_cuboid(const model::Motion& motion) {
  const model::Robot& robot = motion.robot();
  Cuboid box{Vector3::Constant(std::numeric_limits<double>::infinity()), Vector3::Constant(-std::numeric_limits<double>::infinity())};
  std::vector<model::Capsule> capsules;
  const int samples = motion.duration() > 0 ? kSweepSamples : 0;
  for (int i = 0; i <= samples; ++i) {
    const double t = samples > 0 ? motion.duration() * i / samples : 0;
    model::place_capsules(robot.model, robot.X_WB, motion.joints(t), capsules);
    for (std::size_t k = 0; k < capsules.size(); ++k) {
      if (robot.model.capsules[k].link == 0) continue;  // the base sweeps nothing
      const Vector3 radius = Vector3::Constant(capsules[k].radius);
      for (const Vector3& end : {capsules[k].a, capsules[k].b}) {
        box.min = box.min.cwiseMin(end - radius);
        box.max = box.max.cwiseMax(end + radius);
      }
    }
  }
  return box;
}

std::array<EscapeDirection, 6> escape_directions(const Cuboid& cuboid, const Vector3& p) {
  using model::EscapeWay;
  constexpr std::array<EscapeWay, 6> ways{EscapeWay::plus_x,  EscapeWay::minus_x, EscapeWay::plus_y,
                                          EscapeWay::minus_y, EscapeWay::plus_z,  EscapeWay::minus_z};
  std::array<EscapeDirection, 6> directions;
  for (int axis = 0; axis < 3; ++axis) {
    const std::size_t up = 2 * static_cast<std::size_t>(axis);
    directions[up] = {ways[up], Vector3::Unit(axis), std::abs(cuboid.max[axis] - p[axis])};
    directions[up + 1] = {ways[up + 1], -Vector3::Unit(axis), std::abs(p[axis] - cuboid.min[axis])};
  }
  std::stable_sort(directions.begin(), directions.end(), [](const auto& a, const auto& b) { return a.distance < b.distance; });
  return directions;
}

RequestedMotion to_reachable_goal(const model::Cell& cell, model::RobotIndex index, const model::Robot& robot, const model::Joints& from,
                                  const Vector3& unit) {
  const model::Pose X_WT = robot.X_WB * model::tcp_pose(robot.model, from);
  double length = 2 * reachable_volume(robot).radius;
  for (int i = 0; i < kTries && length >= kShortest; ++i) {
    model::Pose goal = X_WT;
    goal.translation() += length * unit;
    model::MotionRequest request;
    request.target = model::LinearTarget{goal};
    auto motion = admit(cell, index, robot, from, request);
    if (motion) return {request, std::move(*motion)};
    length = std::min(length, motion.error().progress * length) - kBackFromBorder;
  }
  return {};
}

model::MotionRequest shortened(const model::Motion& motion, double length) {
  // Where the time law has covered `length`: it is monotone, so halving finds it.
  double before = 0;
  double after = motion.duration();
  for (int i = 0; i < 60; ++i) {
    const double middle = (before + after) / 2;
    (motion.length(middle) < length ? before : after) = middle;
  }
  model::MotionRequest request;
  request.target = model::LinearTarget{motion.tcp(after)};
  return request;
}

model::MotionRequest undoing(const model::Motion& motion) {
  model::MotionRequest request;
  if (motion.is_linear()) {
    request.target = model::LinearTarget{motion.tcp(0)};
  } else {
    request.target = model::JointTarget{motion.from()};
  }
  return request;
}

}  // namespace interlace::core
