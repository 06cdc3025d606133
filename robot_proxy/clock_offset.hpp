#pragma once

#include <cstdint>
#include <optional>

#include "robot_proxy/local_time.hpp"

namespace interlace::proxy {

/// Planner time − local time, and how wrong that can be. The default says that both are one clock (virtual time, tests).
struct ClockEstimate {
  model::Duration offset{0};
  model::Duration uncertainty{0};  ///< ≥ 0; the true offset lies within offset ± uncertainty

  /// Both saturate, so that "forever" stays forever.
  [[nodiscard]] model::Instant to_planner(LocalTime t) const;
  [[nodiscard]] LocalTime to_local(model::Instant t) const;
};

/// One heartbeat that the proxy sent and the planner answered.
struct Echo {
  std::uint64_t incarnation = 0;  ///< of the planner that answered
  LocalTime sent{};               ///< t1
  model::Instant received{};      ///< t2
  model::Instant answered{};      ///< t3
  LocalTime returned{};           ///< t4
};

/// Keeps the offset to planner time from heartbeat echoes. Pure; not thread-safe.
///
/// An echo bounds the offset: it is ((t2 − t1) + (t3 − t4)) / 2 within half the round trip without the planner's stay, whatever the two
/// ways took. From t1 on the bound grows by the drift. As all bounds grow alike, the echo with the least uncertainty now stays the best of
/// those seen so far for ever: one echo is kept, no window is needed, and a delayed echo never worsens anything. An echo that contradicts
/// the kept one (a clock stood still while its machine slept) replaces it. Wall clocks play no part.
class ClockOffset {
 public:
  /// `drift`: largest difference in rate of the two monotonic clocks, seconds per second. Crystals stay within 50 ppm.
  explicit ClockOffset(double drift = 50e-6) : drift_(drift) {}

  /// An impossible echo (t4 < t1, t3 < t2, or a stay longer than the round trip) is ignored. Another incarnation than the one before
  /// forgets everything first.
  void on_echo(const Echo& echo, LocalTime now);

  /// Tells of the planner's incarnation without an echo: another one than before forgets everything, its epoch is a new one.
  void on_incarnation(std::uint64_t incarnation);

  /// Empty until the first echo of the present incarnation.
  [[nodiscard]] std::optional<ClockEstimate> at(LocalTime now) const;

 private:
  struct Sample {
    model::Duration offset;
    model::Duration half_trip;
    LocalTime sent;
  };
  [[nodiscard]] ClockEstimate aged(const Sample& sample, LocalTime now) const;

  double drift_;
  std::optional<std::uint64_t> incarnation_;
  std::optional<Sample> best_;
};

}  // namespace interlace::proxy
