#include "planner/core/neighbourhood.hpp"

#include <numeric>
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

std::vector<RobotIndex> Neighbourhood::within(RobotIndex robot, int steps) const {
  std::set<RobotIndex> reached{robot};
  std::vector<RobotIndex> border{robot};
  for (int i = 0; i < steps; ++i) {
    std::vector<RobotIndex> next;
    for (const RobotIndex a : border) {
      for (const RobotIndex b : neighbours_[a]) {
        if (reached.insert(b).second) next.push_back(b);
      }
    }
    border = std::move(next);
  }
  return {reached.begin(), reached.end()};
}

std::size_t Neighbourhood::pairs() const {
  return std::accumulate(neighbours_.begin(), neighbours_.end(), std::size_t{0},
                         [](std::size_t sum, const auto& n) { return sum + n.size(); });
}

}  // namespace interlace::core
