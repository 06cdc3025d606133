#pragma once

#include <optional>
#include <string>

#include "planner/core/collision_map.hpp"
#include "simulator/reproduce/experiments.hpp"

namespace interlace::reproduce {

/// A command that had to wait for a motion of another robot. Times [s] from the start of the moving robot's motion.
struct MapSubject {
  std::string commanded, moving;  ///< labels
  model::Motion commanded_motion, moving_motion;
  double ready = 0;  ///< when the commanded robot could have started
  double start = 0;  ///< when it did
};

/// The first command of the run that was delayed because its trajectory would have crossed a collision area of a motion under way; empty
/// when there was none.
[[nodiscard]] std::optional<MapSubject> first_delayed(const Case& input, const StrategyRun& run, const NamedCommands& named);

/// Its collision areas at the resolution and margin of the cell.
[[nodiscard]] std::vector<core::CollisionArea> collision_areas(const MapSubject& subject, const model::PlanningOptions& planning);

/// The collision map as a picture (dissertation figures 3.6 and 6.11): travelling length of the commanded robot's TCP over the servo time
/// of the moving one, with the collision areas, the trajectory of an immediate start and the chosen one.
[[nodiscard]] std::string map_picture(const std::string& title, const MapSubject& subject, const std::vector<core::CollisionArea>& areas);

}  // namespace interlace::reproduce
