#pragma once

#include <chrono>
#include <cstdint>
#include <utility>

#include "common/dds/participant.hpp"
#include "common/dds/writer.hpp"
#include "planner/core/journal.hpp"

namespace interlace::daemon {

/// Says on `planner_journal` what the planner was told and decided, ten times a second and whenever a message is full. Takes notes while
/// the planner works and sends when it has nothing else to do. Waits for nobody: what cannot be sent is dropped, and listeners see the gap
/// in the numbers. Not thread-safe.
class JournalWriter {
 public:
  using Clock = std::chrono::steady_clock;

  /// `head`: everything but the calls.
  JournalWriter(dds::Participant& participant, const model::PlannerJournal& head);

  template <typename Event>
  void note(model::Instant now, const Event& event, const core::Decisions& decisions) {
    keeper_.note(now, event, decisions);
  }

  /// Sends full messages, and all there is when a tenth of a second has passed since it last did.
  void send_when_due(Clock::time_point now);
  /// Sends all there is.
  void send_all();

 private:
  void send_one();

  core::JournalKeeper keeper_;
  dds::Writer<model::PlannerJournal> writer_;
  Clock::time_point next_{};
  bool failing_ = false;
};

}  // namespace interlace::daemon
