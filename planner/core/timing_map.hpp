#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
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

/// Shifts (start of the commanded robot after the moving one's, [s]) from `first` to `last`; ±∞ where there is no end.
struct ForbiddenShift {
  double first = 0, last = 0;
};

/// The shifts that a cell forbids, whatever the starts: [t0 − τ1, t1 − τ0], widened by the relative errors of both durations.
[[nodiscard]] inline ForbiddenShift forbidden_shift(const BlockedCell& c, double commanded_stretch, double moving_stretch) {
  return {c.t0 * (1 - moving_stretch) - c.tau1 * (1 + commanded_stretch), c.t1 * (1 + moving_stretch) - c.tau0 * (1 - commanded_stretch)};
}

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

/// The same for one who only asks which starts are forbidden: where both robots move, a cell all of whose shifts, widened by both robots'
/// speed errors, others forbid already is left out. The shifts forbidden are the same, at a fraction of the distances.
[[nodiscard]] TimingMap build_shift_map(SampledMotion& commanded, SampledMotion& moving, double margin);

/// When a moving robot is where a commanded one comes by on any of its way, or stands before or after it.
struct TimesInTheWay {
  std::vector<std::pair<double, double>> times;  ///< local times of the moving robot [s], in order of their beginnings
  std::size_t evaluations = 0;                   ///< distances FCL computed

  /// The first time from which on it is not; empty when that is not within `duration` [s].
  [[nodiscard]] std::optional<double> first_clear(double duration) const;
};

/// Conservative, and the more so, and found the sooner, with `coarser` halvings fewer than down to the resolution.
[[nodiscard]] TimesInTheWay times_in_the_way(SampledMotion& commanded, SampledMotion& moving, double margin, int coarser = 0);

}  // namespace interlace::core
