#include "planner/core/start_windows.hpp"

#include <algorithm>
#include <cmath>

namespace interlace::core {

namespace {

/// `base` plus `seconds`, saturating at the ends of time and rounded away from the interval's inside by a nanosecond.
Instant shifted(Instant base, double seconds, int outward) {
  if (seconds == -kNever) return model::kEarliest;
  if (seconds == kNever) return model::kForever;
  return base + model::from_seconds(seconds) + Duration{outward};
}

}  // namespace

std::vector<ForbiddenStart> forbidden_starts(const TimingMap& map, const StartUncertainty& u) {
  std::vector<ForbiddenStart> forbidden;
  forbidden.reserve(map.blocked.size());
  const double tolerance = model::to_seconds(u.commanded_tolerance);
  for (std::size_t i = 0; i < map.blocked.size(); ++i) {
    const BlockedCell& c = map.blocked[i];
    const double first = c.t0 * (1 - u.moving_stretch) - c.tau1 * (1 + u.commanded_stretch) - tolerance;
    const double last = c.t1 * (1 + u.moving_stretch) - c.tau0 * (1 - u.commanded_stretch);
    forbidden.push_back({{shifted(u.moving_from, first, -1), shifted(u.moving_until, last, 1)}, i});
  }
  return forbidden;
}

std::vector<StartInterval> united(std::vector<StartInterval> intervals) {
  std::sort(intervals.begin(), intervals.end(), [](const auto& a, const auto& b) { return a.from < b.from; });
  std::vector<StartInterval> result;
  for (const StartInterval& next : intervals) {
    if (!result.empty() && next.from <= result.back().until) {
      result.back().until = std::max(result.back().until, next.until);
    } else {
      result.push_back(next);
    }
  }
  return result;
}

std::vector<StartInterval> complement(const std::vector<StartInterval>& forbidden, Instant earliest) {
  std::vector<StartInterval> windows;
  Instant free_from = earliest;
  for (const StartInterval& f : forbidden) {
    if (f.from > free_from) windows.push_back({free_from, f.from});
    if (f.until == model::kForever) return windows;
    free_from = std::max(free_from, f.until);
  }
  windows.push_back({free_from, model::kForever});
  return windows;
}

}  // namespace interlace::core
