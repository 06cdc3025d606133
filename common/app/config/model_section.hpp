#pragma once

#include <optional>

#include "common/app/config/field.hpp"
#include "common/model/robot_model.hpp"

namespace interlace::app {

inline constexpr std::size_t kMaxCapsules = 64;  ///< of one model

/// One entry under `models`.
[[nodiscard]] std::optional<model::RobotModel> read_model(const std::string& name, const Field& field, const Units& units);

}  // namespace interlace::app
