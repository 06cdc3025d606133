#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/model/kinematics.hpp"

namespace interlace::model {

/// Limits of the six joints; position [rad] always, the rates only where the cell file gives them.
struct JointLimits {
  Joints min = Joints::Constant(-2 * kPi);
  Joints max = Joints::Constant(2 * kPi);
  std::optional<Joints> velocity;      ///< [rad/s]
  std::optional<Joints> acceleration;  ///< [rad/s²]
};

/// Swept sphere on a line, fixed to a link: ends in the link's frame [m], radius [m]. A sphere has a == b.
struct LinkCapsule {
  std::string name;      ///< what messages to people call it: base, link1, link2, eef, …
  std::size_t link = 0;  ///< 0 … 6, see LinkFrames
  Vector3 a = Vector3::Zero();
  Vector3 b = Vector3::Zero();
  double radius = 0;
};

/// A kind of arm: everything two robots of the same make have in common.
struct RobotModel {
  std::string name;
  Kinematics kinematics{OpwParameters{}};
  JointLimits joints;
  Pose X_FT = Pose::Identity();  ///< flange → TCP
  std::vector<LinkCapsule> capsules;
  std::vector<std::pair<std::size_t, std::size_t>> self_pairs;  ///< capsules of this arm that could touch each other
};

/// A capsule placed in the world: ends of its axis [m], radius [m].
struct Capsule {
  Vector3 a = Vector3::Zero();
  Vector3 b = Vector3::Zero();
  double radius = 0;
};

/// Radii [m] of base → shoulder, shoulder → elbow, elbow → wrist, wrist → TCP as four capsules on the axes between the joints.
/// Only for arms without offsets (a1 = a2 = b = 0); throws std::invalid_argument otherwise.
/// Source: dissertation section 2.4.3.
[[nodiscard]] std::vector<LinkCapsule> chain_capsules(const OpwParameters& p, const Pose& X_FT, const std::array<double, 4>& radii);

/// Pairs of an arm's own capsules that admission checks when the cell file names none: those with at least two other arm sections
/// (turret, upper arm, forearm, hand) between them. Neighbours overlap at their joint by construction, and capsules with one section
/// between them overlap in folded postures that the arm's joint limits already guard.
[[nodiscard]] std::vector<std::pair<std::size_t, std::size_t>> default_self_pairs(const std::vector<LinkCapsule>& capsules);

/// X_BT: the TCP in the base frame.
[[nodiscard]] Pose tcp_pose(const RobotModel& model, const Joints& q);

/// Capsules of the arm with its base at `X_WB`, in the order of `model.capsules`, written to `out` (resized).
void place_capsules(const RobotModel& model, const Pose& X_WB, const Joints& q, std::vector<Capsule>& out);

/// Joints that bring the TCP to `X_BT`: the first posture within the joint limits in the order of `all_branches`, of the two wrist signs
/// the one with the smaller |q4| + |q6|. Only of branches that `admits` lets through, when given. Empty when none reaches it within its
/// limits.
[[nodiscard]] std::optional<Joints> preferred_posture(const RobotModel& model, const Pose& X_BT,
                                                      const std::function<bool(const Branch&)>& admits = nullptr);

/// Joint (0 … 5) whose angle lies outside its limits, if any.
[[nodiscard]] std::optional<std::size_t> joint_outside_limits(const JointLimits& limits, const Joints& q);

}  // namespace interlace::model
