#pragma once

#include <chrono>
#include <cstdint>

namespace interlace::model {

/// Tag of the planner's time line. It never asks a real clock: instants are handed in as values (docs/architecture.md).
struct PlannerClock {
  using duration = std::chrono::nanoseconds;
  using rep = duration::rep;
  using period = duration::period;
  using time_point = std::chrono::time_point<PlannerClock, duration>;
  static constexpr bool is_steady = true;
};

using Duration = PlannerClock::duration;
using Instant = PlannerClock::time_point;  ///< planner time, integer nanoseconds since the planner started

/// "Later than anything": the end of an unbounded interval.
inline constexpr Instant kForever = Instant::max();
inline constexpr Instant kEarliest = Instant::min();

/// `d` in seconds.
[[nodiscard]] constexpr double to_seconds(Duration d) {
  return std::chrono::duration<double>(d).count();
}

/// Seconds since the planner's epoch.
[[nodiscard]] constexpr double to_seconds(Instant t) {
  return to_seconds(t.time_since_epoch());
}

/// Nearest nanosecond to `s` seconds; |s| must be below 292 years.
[[nodiscard]] constexpr Duration from_seconds(double s) {
  return Duration{static_cast<std::int64_t>(s * 1e9 + (s < 0 ? -0.5 : 0.5))};
}

[[nodiscard]] constexpr Instant at_seconds(double s) {
  return Instant{from_seconds(s)};
}

}  // namespace interlace::model
