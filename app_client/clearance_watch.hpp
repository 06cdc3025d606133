#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "common/app/config/cell_file.hpp"
#include "common/dds/envelope.hpp"
#include "monitor/clearance_observer.hpp"
#include "monitor/timeline.hpp"

namespace interlace::client {

/// Judges a running cell by the postures of its robots alone. Not thread-safe.
class ClearanceWatch {
 public:
  /// `cell` must outlive it; `origin` is the zero of its times.
  ClearanceWatch(const app::LoadedCell& cell, monitor::Timeline::LocalTime origin);

  /// Postures from proxies that work with another cell description are left out, and counted.
  void on_posture(const dds::PostureMessage& message, monitor::Timeline::LocalTime received);

  [[nodiscard]] bool saw_anything() const { return observer_.least_clearance().has_value(); }
  [[nodiscard]] bool saw_collision() const;
  [[nodiscard]] std::size_t of_another_cell() const { return strangers_; }
  [[nodiscard]] const monitor::ClearanceObserver& observer() const { return observer_; }

  /// Lengths [m], times [s] after the origin.
  [[nodiscard]] nlohmann::json to_json() const;
  /// A few lines for people.
  [[nodiscard]] std::string summary() const;

 private:
  const app::LoadedCell& cell_;
  monitor::Timeline timeline_;
  monitor::ClearanceObserver observer_;
  std::size_t strangers_ = 0;
};

}  // namespace interlace::client
