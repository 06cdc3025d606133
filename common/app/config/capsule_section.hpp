#pragma once

#include <optional>

#include "common/app/config/field.hpp"
#include "common/app/config/quantity.hpp"
#include "common/model/robot_model.hpp"

namespace interlace::app {

/// Axis and radius of the capsule that `mapping` describes with `from`, `to` and `radius`; empty with a finding when one of them is missing
/// or wrong. For links and tools alike.
[[nodiscard]] std::optional<model::Capsule> read_capsule_shape(const Mapping& mapping, const Units& units);

}  // namespace interlace::app
