#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <optional>

#include "common/model/time.hpp"

namespace interlace::monitor {

/// Puts the stamps of postures on one local time line. Stamps of one planner's time keep their distances exactly; each planner is anchored
/// at the first posture received in its time, so a restart of the planner does not break the line. Postures without planner time count at
/// the moment they are received. Pure.
class Timeline {
 public:
  using LocalTime = std::chrono::steady_clock::time_point;

  explicit Timeline(LocalTime origin) : origin_(origin) {}

  /// Seconds since the origin of something stamped `at` by `planner_incarnation` (0: no planner, `at` means nothing).
  [[nodiscard]] double place(std::uint64_t planner_incarnation, model::Instant at, LocalTime received) {
    const double heard = std::chrono::duration<double>(received - origin_).count();
    if (planner_incarnation == 0) return heard;
    const auto anchor = anchors_.try_emplace(planner_incarnation, heard - model::to_seconds(at)).first;
    return anchor->second + model::to_seconds(at);
  }

  /// Where the zero of that planner's time lies [s]; empty as long as nothing stamped by it was placed.
  [[nodiscard]] std::optional<double> zero_of(std::uint64_t planner_incarnation) const {
    const auto anchor = anchors_.find(planner_incarnation);
    return anchor == anchors_.end() ? std::nullopt : std::optional{anchor->second};
  }

 private:
  LocalTime origin_;
  std::map<std::uint64_t, double> anchors_;  // local seconds at the planner's zero
};

}  // namespace interlace::monitor
