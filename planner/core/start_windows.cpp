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

/// Cells come in the order in which they were found, so that next to each other most touch.
void add(std::vector<ForbiddenShift>& all, const ForbiddenShift& next) {
  if (all.empty() || next.first > all.back().last || next.last < all.back().first) {
    all.push_back(next);
  } else {
    all.back() = {std::min(all.back().first, next.first), std::max(all.back().last, next.last)};
  }
}

std::vector<ForbiddenShift> united(std::vector<ForbiddenShift> all) {
  std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<ForbiddenShift> united;
  for (const ForbiddenShift& next : all) {
    if (!united.empty() && next.first <= united.back().last) {
      united.back().last = std::max(united.back().last, next.last);
    } else {
      united.push_back(next);
    }
  }
  return united;
}

}  // namespace

std::vector<ForbiddenShift> forbidden_shifts(const TimingMap& map, double commanded_stretch, double moving_stretch) {
  std::vector<ForbiddenShift> all;
  for (const BlockedCell& c : map.blocked) add(all, forbidden_shift(c, commanded_stretch, moving_stretch));
  return united(std::move(all));
}

std::vector<ForbiddenShift> forbidden_while_moving(const TimingMap& map, double commanded_stretch, double moving_stretch) {
  std::vector<ForbiddenShift> all;
  for (const BlockedCell& c : map.blocked) {
    if (c.t0 != -kNever && c.t1 != kNever) add(all, forbidden_shift(c, commanded_stretch, moving_stretch));
  }
  return united(std::move(all));
}

std::vector<ForbiddenShift> times_at_end(const TimingMap& map, double commanded_stretch) {
  std::vector<ForbiddenShift> all;
  for (const BlockedCell& c : map.blocked) {
    if (c.t1 == kNever) add(all, {c.tau0 * (1 - commanded_stretch), c.tau1 * (1 + commanded_stretch)});
  }
  return united(std::move(all));
}

StartInterval forbidden_start(const ForbiddenShift& shift, const StartUncertainty& u) {
  return {shifted(u.moving_from, shift.first - model::to_seconds(u.commanded_tolerance), -1), shifted(u.moving_until, shift.last, 1)};
}

std::vector<ForbiddenStart> forbidden_starts(const TimingMap& map, const StartUncertainty& u) {
  std::vector<ForbiddenStart> forbidden;
  forbidden.reserve(map.blocked.size());
  for (std::size_t i = 0; i < map.blocked.size(); ++i) {
    forbidden.push_back({forbidden_start(forbidden_shift(map.blocked[i], u.commanded_stretch, u.moving_stretch), u), i});
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
