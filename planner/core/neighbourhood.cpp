#include "planner/core/neighbourhood.hpp"

#include <set>

#include "planner/core/reach.hpp"

namespace interlace::core {

Neighbourhood::Neighbourhood(const model::Cell& cell) : meet_(cell.robots.size() * cell.robots.size()), neighbours_(cell.robots.size()) {
  for (RobotIndex i = 0; i < cell.robots.size(); ++i) volumes_.push_back(reachable_volume(cell, i));
  for (RobotIndex a = 0; a < volumes_.size(); ++a) {
    for (RobotIndex b = 0; b < volumes_.size(); ++b) {
      if (a == b || !volumes_[a].meets(volumes_[b], cell.planning.margin)) continue;
      meet_[a * volumes_.size() + b] = true;
      neighbours_[a].push_back(b);
    }
  }
  for (RobotIndex a = 0; a < volumes_.size(); ++a) {
    std::set<RobotIndex> near{a};
    for (const RobotIndex b : neighbours_[a]) {
      near.insert(b);
      near.insert(neighbours_[b].begin(), neighbours_[b].end());
    }
    around_.emplace_back(near.begin(), near.end());
  }
}

}  // namespace interlace::core
