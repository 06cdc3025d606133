#pragma once

#include <algorithm>
#include <optional>

#include "common/model/motion.hpp"
#include "tests/support/arms.hpp"

namespace interlace::test {

/// Joints within the limits, none further than `half` [rad] from zero.
inline model::Joints random_joints(Seed& seed, const model::RobotModel& m, double half = kPi) {
  model::Joints q;
  for (std::size_t i = 0; i < model::kJoints; ++i) q[i] = seed.uniform(std::max(-half, m.joints.min[i]), std::min(half, m.joints.max[i]));
  return q;
}

/// A linear move from a random posture to a pose that the arm reaches with joints up to `spread` [rad] away; empty when the path refuses.
inline std::optional<model::Motion> try_linear(Seed& seed, const model::Robot& robot, double spread) {
  const model::Joints from = random_joints(seed, robot.model);
  model::Joints to = from;
  for (std::size_t i = 0; i < model::kJoints; ++i) to[i] += seed.uniform(-spread, spread);
  model::Pose X_WT = robot.X_WB * model::tcp_pose(robot.model, to);
  if (seed.chance(0.2)) X_WT.linear() = (robot.X_WB * model::tcp_pose(robot.model, from)).linear();            // translation alone
  if (seed.chance(0.1)) X_WT.translation() = (robot.X_WB * model::tcp_pose(robot.model, from)).translation();  // rotation alone
  auto motion = model::plan_motion(robot, from, line_to(X_WT));
  if (!motion) return std::nullopt;
  return std::move(*motion);
}

/// As above, tried until one goes.
inline model::Motion random_linear(Seed& seed, const model::Robot& robot, double spread = 0.8) {
  for (;;) {
    if (auto motion = try_linear(seed, robot, spread)) return std::move(*motion);
  }
}

/// A joint move between random postures; the model must have joint speeds.
inline model::Motion random_joint_move(Seed& seed, const model::Robot& robot, double spread = 2.0) {
  for (;;) {
    const model::Joints from = random_joints(seed, robot.model);
    model::Joints to = from;
    for (std::size_t i = 0; i < model::kJoints; ++i) to[i] += seed.chance(0.2) ? 0.0 : seed.uniform(-spread, spread);
    auto motion = model::plan_motion(robot, from, joints_to(to));
    if (motion) return std::move(*motion);
  }
}

/// Rates that joint moves need and no linear move of these tests reaches.
inline void give_joint_rates(model::Robot& robot, double velocity = 2.0, double acceleration = 5.0) {
  robot.model.joints.velocity = model::Joints::Constant(velocity);
  robot.model.joints.acceleration = model::Joints::Constant(acceleration);
}

}  // namespace interlace::test
