#pragma once

#include <vector>

#include "common/model/time.hpp"
#include "planner/core/timing_map.hpp"

namespace interlace::core {

using model::Duration;
using model::Instant;

/// Start instants [from, until]; kEarliest and kForever where there is no end.
struct StartInterval {
  Instant from{};
  Instant until = model::kForever;
};

/// What one blocked cell forbids.
struct ForbiddenStart {
  StartInterval interval;
  std::size_t cell = 0;  ///< index in the timing map: the evidence
};

/// The shifts that the cells of a map forbid, in order and disjoint.
[[nodiscard]] std::vector<ForbiddenShift> forbidden_shifts(const TimingMap& map, double commanded_stretch, double moving_stretch);

/// The same of the cells in which the moving robot moves: not of those where it stands before or after.
[[nodiscard]] std::vector<ForbiddenShift> forbidden_while_moving(const TimingMap& map, double commanded_stretch, double moving_stretch);

/// Times of the commanded robot, from its start on, at which it would meet the moving one standing at its end, in order and disjoint.
[[nodiscard]] std::vector<ForbiddenShift> times_at_end(const TimingMap& map, double commanded_stretch);

/// When the moving robot of a map starts, and how far both robots may be from their predictions.
struct StartUncertainty {
  Instant moving_from{}, moving_until{};  ///< its start lies in between
  double moving_stretch = 0;              ///< relative error of its duration
  double commanded_stretch = 0;           ///< relative error of the commanded robot's
  Duration commanded_tolerance{};         ///< the commanded robot starts at most this much later than planned
};

/// Starts of the commanded robot that each blocked cell forbids: a cell [t0,t1]×[τ0,τ1] forbids [t0 − τ1, t1 − τ0] after the moving robot's
/// start, widened by the uncertainty. Source: dissertation Algorithm 1 restated, DESIGN section 5.
[[nodiscard]] std::vector<ForbiddenStart> forbidden_starts(const TimingMap& map, const StartUncertainty& uncertainty);

/// The same from the shifts of a map, in which the errors of the durations are already.
[[nodiscard]] StartInterval forbidden_start(const ForbiddenShift& shift, const StartUncertainty& uncertainty);

/// Union of intervals, in order and disjoint; intervals that touch become one, others stay apart.
/// Replaces the dissertation's appendix B, which merges ranges that do not touch.
[[nodiscard]] std::vector<StartInterval> united(std::vector<StartInterval> intervals);

/// The starts from `earliest` on that no interval of `forbidden` (as `united` returns them) contains, in order. Empty: deadlock.
[[nodiscard]] std::vector<StartInterval> complement(const std::vector<StartInterval>& forbidden, Instant earliest);

}  // namespace interlace::core
