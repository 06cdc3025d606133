#include "planner/core/neighbourhood.hpp"

#include <set>

#include "planner/core/reach.hpp"

namespace interlace::core {

Neighbourhood::Neighbourhood(const model::Cell& cell) : meet_(cell.robots.size() * cell.robots.size()), neighbours_(cell.robots.size()) {
  std::vector<ReachableVolume> volumes;
  volumes.reserve(cell.robots.size());
  for (const model::Robot& robot : cell.robots) volumes.push_back(reachable_volume(robot));
  for (RobotIndex a = 0; a < volumes.size(); ++a) {
    for (RobotIndex b = 0; b < volumes.size(); ++b) {
      if (a == b || !volumes[a].meets(volumes[b], cell.planning.margin)) continue;
      meet_[a * volumes.size() + b] = true;
      neighbours_[a].push_back(b);
    }
  }
  for (RobotIndex a = 0; a < volumes.size(); ++a) {
    std::set<RobotIndex> near{a};
    for (const RobotIndex b : neighbours_[a]) {
      near.insert(b);
      near.insert(neighbours_[b].begin(), neighbours_[b].end());
    }
    around_.emplace_back(near.begin(), near.end());
  }
}

}  // namespace interlace::core
