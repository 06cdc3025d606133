#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "planner/core/sampled_motion.hpp"

namespace interlace::core {

inline constexpr double kNever = std::numeric_limits<double>::infinity();

/// A rectangle of the plane (t, τ) that is not proven free. Times [s] local to each motion; −∞ and +∞ where a robot stands.
struct BlockedCell {
  double t0 = 0, t1 = 0;                       ///< of the moving robot
  double tau0 = 0, tau1 = 0;                   ///< of the commanded robot
  std::uint16_t own_body = 0, other_body = 0;  ///< the pair that blocks, as indices of the models' capsules
  double clearance = 0;                        ///< of that pair at the cell's centre [m]
  double bound = 0;                            ///< how far that pair may approach inside the cell beyond its centre [m]
};

/// Collision timing map of one commanded and one moving (or standing) robot, in both motions' local times, so it holds wherever the two
/// are started. Conservative in continuous time: outside the blocked cells the clearance exceeds the margin.
struct TimingMap {
  double commanded_duration = 0;  ///< [s]
  double moving_duration = 0;     ///< [s]
  std::vector<BlockedCell> blocked;
  std::size_t evaluations = 0;  ///< distances FCL computed
};

/// Builds the map by certified subdivision: a cell is free when every pair's clearance at its centre exceeds the displacement bounds of
/// both robots plus `margin` [m], which grows by both path errors, blocked when some pair's is below minus that, halved otherwise, and
/// blocked at the resolution limit. A cell at that limit whose centre is clear is halved SampledMotion::kFiner times more before it counts
/// as blocked, but only where that could make a start window longer: where the shifts it forbids are not all forbidden by other cells. The
/// moving robot stands at its first posture before t = 0 and at its last after its duration; so does the commanded robot at its end. The
/// commanded robot's wait before τ = 0 is not examined: its place there is already safe against everything committed. Source: dissertation
/// section 3.2 (CTM), DESIGN section 5.
[[nodiscard]] TimingMap build_timing_map(SampledMotion& commanded, SampledMotion& moving, double margin);

}  // namespace interlace::core
