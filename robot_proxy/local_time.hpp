#pragma once

#include <chrono>
#include <type_traits>

#include "common/model/time.hpp"

namespace interlace::proxy {

/// The proxy's own monotonic time, as a value: nothing here reads a clock. A type of its own, so that it never mixes with planner time.
using LocalTime = std::chrono::steady_clock::time_point;

static_assert(std::is_same_v<LocalTime::duration, model::Duration>, "both time lines count nanoseconds");

/// `t` + `d`, at most the end of its time line: "forever" stays forever.
template <typename TimePoint>
[[nodiscard]] constexpr TimePoint later(TimePoint t, model::Duration d) {
  if (d.count() > 0 && t > TimePoint::max() - d) return TimePoint::max();
  if (d.count() < 0 && t < TimePoint::min() - d) return TimePoint::min();
  return t + d;
}

}  // namespace interlace::proxy
