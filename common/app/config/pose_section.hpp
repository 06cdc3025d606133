#pragma once

#include <optional>

#include "common/app/config/field.hpp"
#include "common/model/cell.hpp"

namespace interlace::app {

/// `{xyz: [...], rpy: [...]}`, both keys required.
[[nodiscard]] std::optional<model::Pose> read_pose(const Field& field, const Units& units);

/// Posture of a robot standing still, given as `{joints: [...]}` or as world pose of its TCP `{xyz, rpy, posture}`. Must be reachable and
/// inside the joint limits; among several postures the one `posture` names, else model::preferred_posture.
[[nodiscard]] std::optional<model::Joints> read_posture(const Field& field, const model::RobotModel& model, const model::Pose& X_WB,
                                                        const Units& units);

}  // namespace interlace::app
