#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "common/model/journal.hpp"
#include "planner/core/planner.hpp"

/// What a planner is told and decides, as values that can be kept, sent and made to happen again.
namespace interlace::core {

[[nodiscard]] model::PlannerSettings settings_of(const PlannerOptions& options);
/// Without a stopwatch.
[[nodiscard]] PlannerOptions options_of(const model::PlannerSettings& settings);

/// Of all fields of all decisions in their order; of doubles every bit.
[[nodiscard]] model::DecisionDigest digest_of(const Decisions& decisions);

/// Tells `planner` what `event` says.
[[nodiscard]] Decisions apply(Planner& planner, const model::PlannerEvent& event, Instant now);

/// Numbers a planner's calls and gathers them into messages of bounded size. Pure.
class JournalKeeper {
 public:
  /// `head`: everything but `first` and `calls`.
  explicit JournalKeeper(model::PlannerJournal head) : batch_(std::move(head)) {}

  /// The planner was told `event` and decided `decisions`.
  void note(Instant now, model::PlannerEvent event, const Decisions& decisions);

  /// take() should not wait any longer: more would become too large to send.
  [[nodiscard]] bool full() const { return weight_ >= kFull; }

  /// The calls since the last take(); empty when there were none.
  [[nodiscard]] std::optional<model::PlannerJournal> take();

 private:
  static constexpr std::size_t kFull = 64;  // commands and postures: with one replacement more they still fit into one datagram

  model::PlannerJournal batch_;
  std::size_t weight_ = 0;
};

}  // namespace interlace::core
