#pragma once

#include <vector>

#include "common/model/ids.hpp"

namespace interlace::core {

/// What a robot is about, as far as those that wait for it care.
struct WaitNode {
  enum class State {
    moves,   ///< carries a motion out, or will: things change by themselves when it has arrived
    idle,    ///< stands and has nothing to do
    waits,   ///< has a command that cannot start because of `blockers`
    unknown  ///< not heard from, not ready, or held: nobody can say what it will do
  };
  State state = State::idle;
  std::vector<model::RobotIndex> blockers;  ///< robots that must go away first, all of them
};

/// Who waits for whom: one node per robot of the cell. Source: DESIGN section 6.
class WaitGraph {
 public:
  explicit WaitGraph(std::vector<WaitNode> nodes) : nodes_(std::move(nodes)) {}

  [[nodiscard]] const WaitNode& node(model::RobotIndex robot) const { return nodes_[robot]; }

  /// True when `robot` moves or will, without anybody being sent away: it is worth waiting for.
  [[nodiscard]] bool moves_by_itself(model::RobotIndex robot) const;

  /// Robots of a shortest circle of waiting through `robot`, starting with it; empty when there is none.
  [[nodiscard]] std::vector<model::RobotIndex> circle(model::RobotIndex robot) const;

  /// True when `robot` waits for robots none of which will move by itself: a deadlock.
  [[nodiscard]] bool deadlocked(model::RobotIndex robot) const;

 private:
  std::vector<WaitNode> nodes_;
};

}  // namespace interlace::core
