#pragma once

#include <nlohmann/json_fwd.hpp>
#include <utility>
#include <vector>

#include "common/model/cell.hpp"

namespace interlace::monitor {

/// Pairs of robots, first index below second.
using Pairs = std::vector<std::pair<model::RobotIndex, model::RobotIndex>>;

/// What of a cell never changes, as a frame has it: robots with their bases, fixtures, the pairs whose clearance is told
/// (docs/monitor.md). Lengths [m].
[[nodiscard]] nlohmann::json scene_json(const model::Cell& cell, const Pairs& pairs);

/// Names and radii of a robot's capsules with what it holds.
[[nodiscard]] nlohmann::json bodies_json(const model::Robot& robot);

}  // namespace interlace::monitor
