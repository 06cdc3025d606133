#pragma once

#include "common/ros2/messages.hpp"
#include "monitor/cell_picture.hpp"

namespace interlace::monitor {

/// How the planner, each robot and the cell as a whole are. A robot or planner that is not heard from is stale; another cell file and
/// alarms that hold are errors; a controller that takes no command and a deadlock are warnings. Names are "<cell>: planner", "<cell>:
/// alarms" and
/// "<cell>: <robot>". Pure.
[[nodiscard]] ros2::DiagnosticArray diagnostics(const CellPicture& picture, ros2::Time stamp);

/// The levels differ, or what they are of: worth telling before its turn.
[[nodiscard]] bool differ_in_level(const ros2::DiagnosticArray& a, const ros2::DiagnosticArray& b);

}  // namespace interlace::monitor
