#pragma once

#include <optional>

#include "common/model/cell.hpp"
#include "common/model/motion.hpp"
#include "planner/core/sampled_motion.hpp"

namespace interlace::core {

/// First place on the path of `motion` where the robot would touch itself, a fixture or the immovable base of a neighbour, if there is one.
/// Certified in continuous time like the collision maps. Source: DESIGN section 6.
[[nodiscard]] std::optional<model::MotionError> path_collision(SampledMotion& motion, const model::Cell& cell, model::RobotIndex robot,
                                                               double margin);

/// The motion of `request` for `robot` standing at `from` [rad], with `bodies` around it, or why it can never be one, wherever the other
/// robots are.
[[nodiscard]] model::Result<SampledMotionPtr, model::MotionError> admit(const model::Cell& cell, model::RobotIndex robot,
                                                                        const model::MotionBodies& bodies, const model::Joints& from,
                                                                        const model::MotionRequest& request);

/// Of a robot that is and stays `body`: a request without a change of tools.
[[nodiscard]] inline model::Result<SampledMotionPtr, model::MotionError> admit(const model::Cell& cell, model::RobotIndex robot,
                                                                               const model::Robot& body, const model::Joints& from,
                                                                               const model::MotionRequest& request) {
  return admit(cell, robot, model::MotionBodies::unchanged(body), from, request);
}

}  // namespace interlace::core
