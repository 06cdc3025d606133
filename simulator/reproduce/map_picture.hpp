#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner/core/collision_map.hpp"
#include "simulator/reproduce/experiments.hpp"

namespace interlace::reproduce {

/// One motion of the moving robot. Times [s] from the start of the first one.
struct MovingPart {
  std::string label;  ///< C12, or escape
  model::Motion motion;
  double start = 0;
};

/// A command that had to wait for another robot. Times [s] from the start of that robot's first motion.
struct MapSubject {
  std::string label;  ///< of the command
  model::Motion motion;
  double ready = 0;                ///< when the commanded robot could have started
  double start = 0;                ///< when it did
  std::vector<MovingPart> moving;  ///< what the other robot did until the command ended, in order; never empty
  double known_until = 0;          ///< the other robot's doings are known up to here, at least up to the end of its first motion
};

/// The first command of the run that was delayed because its trajectory would have crossed a collision area of a motion under way; empty
/// when there was none.
[[nodiscard]] std::optional<MapSubject> first_delayed(const Case& input, const StrategyRun& run, const NamedCommands& named);

/// Its collision areas at the resolution and margin of the cell, over all the motions of the moving robot and its stands in between.
[[nodiscard]] std::vector<core::CollisionArea> collision_areas(const MapSubject& subject, const model::PlanningOptions& planning);

/// The collision map as a picture (dissertation figures 3.6 and 6.11): travelling length of the commanded robot's TCP over the servo time
/// of the moving one, with the collision areas, the trajectory of an immediate start and the chosen one.
[[nodiscard]] std::string map_picture(const std::string& title, const MapSubject& subject, const std::vector<core::CollisionArea>& areas);

}  // namespace interlace::reproduce
