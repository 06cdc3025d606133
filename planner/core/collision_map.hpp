#pragma once

#include <vector>

#include "planner/core/timing_map.hpp"

namespace interlace::core {

/// One blocked rectangle of a collision map: travelling length of the commanded robot's TCP over the servo time of the moving robot.
struct CollisionArea {
  double t0 = 0, t1 = 0;            ///< [s], local to the moving robot's motion
  double length0 = 0, length1 = 0;  ///< [m]; length1 is the whole length where the end posture is blocked
};

/// The timing map with its travelling times turned into travelling lengths: the dissertation's advanced collision map, for people and for
/// the escape technique. Decisions are made on the timing map, which loses nothing where the TCP stands while it turns.
/// Source: dissertation eqs. 3.6 and 3.7.
[[nodiscard]] std::vector<CollisionArea> collision_map(const TimingMap& map, const model::Motion& commanded);

}  // namespace interlace::core
