#pragma once

#include <map>
#include <memory>
#include <vector>

#include "common/model/cell.hpp"
#include "common/model/messages.hpp"
#include "common/model/result.hpp"

namespace interlace::model {

/// `robot` with the capsules of `tools` fixed to its flange, behind its own; `held` says which. A tool's capsules are kept off the robot's
/// own base, turret and upper arm, whatever its model says of its own pairs: no joint limit was chosen with them in mind. The forearm is
/// left out, as the end-effector's neighbour across the wrist is.
[[nodiscard]] Robot with_tools(const Robot& robot, const std::vector<Tool>& tools, ToolSet held);

/// The robots of a cell with everything they may hold: one body for each robot and set of tools that was asked for, made once and kept at
/// its place, so that motions can refer to it. A robot that holds nothing is the cell's own. Not thread-safe.
class Bodies {
 public:
  /// `cell` must outlive it.
  explicit Bodies(const Cell& cell) : cell_(&cell), made_(cell.robots.size()) {}

  [[nodiscard]] const Robot& of(RobotIndex robot, ToolSet held);

 private:
  const Cell* cell_;
  std::vector<std::map<ToolSet, std::unique_ptr<const Robot>>> made_;
};

/// A robot's bodies around a motion, as ToolSteps has them. They are the same robot, and outlive what refers to them.
struct MotionBodies {
  const Robot* at_start = nullptr;  ///< standing before it, the change on start included
  const Robot* during = nullptr;
  const Robot* at_end = nullptr;  ///< standing at its end, the change on completion included
  const Robot* after = nullptr;   ///< once all is done
  const Robot* all = nullptr;     ///< everything at once: of a motion that takes no time

  /// Of a motion without any change.
  [[nodiscard]] static MotionBodies unchanged(const Robot& robot) { return {&robot, &robot, &robot, &robot, &robot}; }
  [[nodiscard]] static MotionBodies of(Bodies& bodies, RobotIndex robot, const ToolSteps& steps);
};

/// What `change` makes of a robot that holds `held`, or one sentence with what it takes although it is held, leaves although it is not, or
/// does not know.
[[nodiscard]] Result<ToolSteps, std::string> tool_steps(const Cell& cell, const RobotName& robot, ToolSet held,
                                                        const std::optional<ToolChange>& change);

}  // namespace interlace::model
