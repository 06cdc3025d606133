#pragma once

#include <array>
#include <vector>

#include "planner/core/admission.hpp"

namespace interlace::core {

/// Box along the axes of the world [m].
struct Cuboid {
  Vector3 min = Vector3::Zero();
  Vector3 max = Vector3::Zero();
};

/// Approximates the volume the moving links of a robot sweep: the box around their capsules at equal steps of `motion`. It orders the
/// directions of an escape and decides nothing, so sampling is enough.
/// Source: dissertation appendix C, whose lower faces (C.1a, c, e) add the radius where they must subtract it.
[[nodiscard]] Cuboid swept_cuboid(const model::Motion& motion);

/// One of the six directions with how far the TCP is from that face of the cuboid.
struct EscapeDirection {
  model::EscapeWay way = model::EscapeWay::plus_x;
  Vector3 unit = Vector3::UnitX();
  double distance = 0;  ///< [m]
};

/// The six directions for a robot whose TCP is at `p_WTcp`, nearest face first. Source: dissertation section 5.2.1.
[[nodiscard]] std::array<EscapeDirection, 6> escape_directions(const Cuboid& cuboid, const Vector3& p_WTcp);

/// A request and the motion it becomes from where its robot stands.
struct RequestedMotion {
  model::MotionRequest request;
  SampledMotionPtr motion;  ///< null: impossible
};

/// Straight motion of `robot`, which is `body`, from `from` [rad] along `unit` with its orientation kept, to the reachable goal: the border
/// of what it can reach without touching itself or a base. Without a motion when it cannot go any way. Source: dissertation section 5.2.2
/// (maximum reachable goal).
[[nodiscard]] RequestedMotion to_reachable_goal(const model::Cell& cell, model::RobotIndex robot, const model::Robot& body,
                                                const model::Joints& from, const Vector3& unit);

/// The linear request that stops after `length` [m] of the straight `motion`, orientation included.
[[nodiscard]] model::MotionRequest shortened(const model::Motion& motion, double length);

/// The request that leads back along `motion` from its end to its start.
[[nodiscard]] model::MotionRequest undoing(const model::Motion& motion);

}  // namespace interlace::core
