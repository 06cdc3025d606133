#pragma once

#include <algorithm>
#include <vector>

#include "common/model/cell.hpp"
#include "planner/core/reach.hpp"

namespace interlace::core {

using model::RobotIndex;

/// Which robots of a cell can ever meet: only those have to look at each other. Found once, when the cell is loaded, from the reachable
/// volumes and the cell's margin, and true whatever the robots do and hold. In a shared workspace everybody is everybody's neighbour; in
/// overlapped workspaces, such as a row of arms, only those near each other are. Immutable; thread-safe. Source: dissertation
/// section 6.2.3.
class Neighbourhood {
 public:
  explicit Neighbourhood(const model::Cell& cell);

  /// False when it is proven that no posture brings the two to within the cell's margin of each other. A robot does not meet itself.
  [[nodiscard]] bool meet(RobotIndex a, RobotIndex b) const { return meet_[a * neighbours_.size() + b]; }

  /// The robots that `robot` can meet, in ascending order.
  [[nodiscard]] const std::vector<RobotIndex>& of(RobotIndex robot) const { return neighbours_[robot]; }

  /// Where `robot` can be, whatever it holds.
  [[nodiscard]] const ReachableVolume& volume(RobotIndex robot) const { return volumes_[robot]; }

  /// `robot`, those it can meet and those that they can meet, in ascending order: all that a deadlock of it may need to move.
  [[nodiscard]] const std::vector<RobotIndex>& around(RobotIndex robot) const { return around_[robot]; }
  [[nodiscard]] bool near(RobotIndex a, RobotIndex b) const { return std::binary_search(around_[a].begin(), around_[a].end(), b); }

  /// The robots that are at most `steps` meetings away from `robot`, itself included, in ascending order.
  [[nodiscard]] std::vector<RobotIndex> within(RobotIndex robot, int steps) const;

  /// Pairs of robots that can meet, each counted both ways round.
  [[nodiscard]] std::size_t pairs() const;

 private:
  std::vector<ReachableVolume> volumes_;
  std::vector<bool> meet_;
  std::vector<std::vector<RobotIndex>> neighbours_;
  std::vector<std::vector<RobotIndex>> around_;
};

}  // namespace interlace::core
