#include "robot_proxy/clock_offset.hpp"

#include <cmath>

namespace interlace::proxy {

using model::Duration;
using model::Instant;

Instant ClockEstimate::to_planner(LocalTime t) const {
  return later(Instant{t.time_since_epoch()}, offset);
}

LocalTime ClockEstimate::to_local(Instant t) const {
  return later(LocalTime{t.time_since_epoch()}, -offset);
}

void ClockOffset::on_incarnation(std::uint64_t incarnation) {
  if (incarnation_ != incarnation) best_.reset();
  incarnation_ = incarnation;
}

void ClockOffset::on_echo(const Echo& echo, LocalTime now) {
  on_incarnation(echo.incarnation);
  const Duration trip = echo.returned - echo.sent;
  const Duration stay = echo.answered - echo.received;
  // The stay is read on another clock, which may run faster by the drift; both readings are whole nanoseconds.
  const Duration slack{static_cast<Duration::rep>(std::ceil(drift_ * static_cast<double>(trip.count()))) + 1};
  if (trip.count() < 0 || stay.count() < 0 || stay > trip + slack) return;

  const Duration there = echo.received.time_since_epoch() - echo.sent.time_since_epoch();
  const Duration back = echo.answered.time_since_epoch() - echo.returned.time_since_epoch();
  // One nanosecond for the two halvings that drop a remainder.
  const Duration half_trip = stay < trip ? (trip - stay) / 2 + Duration{1} : Duration{trip == stay ? 0 : 1};
  const Sample sample{back + (there - back) / 2, half_trip, echo.sent};
  if (best_) {
    const ClockEstimate kept = aged(*best_, now);
    const ClockEstimate fresh = aged(sample, now);
    const bool agree = std::chrono::abs(kept.offset - fresh.offset) <= kept.uncertainty + fresh.uncertainty;
    if (agree && kept.uncertainty < fresh.uncertainty) return;
  }
  best_ = sample;
}

std::optional<ClockEstimate> ClockOffset::at(LocalTime now) const {
  if (!best_) return std::nullopt;
  return aged(*best_, now);
}

ClockEstimate ClockOffset::aged(const Sample& sample, LocalTime now) const {
  const double age = static_cast<double>(std::chrono::abs(now - sample.sent).count());
  return {sample.offset, sample.half_trip + Duration{static_cast<Duration::rep>(std::ceil(drift_ * age))}};
}

}  // namespace interlace::proxy
