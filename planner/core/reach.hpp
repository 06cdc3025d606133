#pragma once

#include "planner/core/sampled_motion.hpp"

namespace interlace::core {

/// Radius [m] of the sphere around the shoulder's height on axis 1 that no point of the robot leaves, whatever its joints.
[[nodiscard]] double reach_radius(const model::RobotModel& model);

/// True unless it is proven that no body of `motion` ever comes into the sphere that `other` can reach with any of its points: where a
/// robot that is not heard from could be.
[[nodiscard]] bool enters_reach(SampledMotion& motion, const model::Robot& other);

}  // namespace interlace::core
