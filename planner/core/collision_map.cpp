#include "planner/core/collision_map.hpp"

namespace interlace::core {

std::vector<CollisionArea> collision_map(const TimingMap& map, const model::Motion& commanded) {
  std::vector<CollisionArea> areas;
  areas.reserve(map.blocked.size());
  for (const BlockedCell& cell : map.blocked) areas.push_back({cell.t0, cell.t1, commanded.length(cell.tau0), commanded.length(cell.tau1)});
  return areas;
}

}  // namespace interlace::core
