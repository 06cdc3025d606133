#pragma once

#include <string>

#include "common/model/cell.hpp"

namespace interlace::monitor {

/// All arms of a cell as one URDF with the root link `world`; joints and links are named as in frames.hpp. Each capsule is a cylinder with
/// a sphere at each end, to be seen and to be collided with. Effort limits are 0, and so are velocity limits that the cell does not give:
/// URDF has no word for unknown. What a robot holds and fixtures are not in it. Pure.
[[nodiscard]] std::string robot_description(const model::Cell& cell);

}  // namespace interlace::monitor
