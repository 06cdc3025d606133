#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

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

/// Numbers a planner's calls and gathers them into messages that each fit into one datagram. Pure.
class JournalKeeper {
 public:
  /// No message takes more bytes than this on the wire.
  static constexpr std::size_t kLargest = std::size_t{56} * 1024;
  /// Nor has it more calls.
  static constexpr std::size_t kMostCalls = 64;

  /// `head`: everything but `first` and `calls`.
  explicit JournalKeeper(const model::PlannerJournal& head) : head_(head) {}

  /// The planner was told `event` and decided `decisions`.
  void note(Instant now, model::PlannerEvent event, const Decisions& decisions);

  /// The next message has no room for more.
  [[nodiscard]] bool full() const { return messages_.size() > 1 || (!messages_.empty() && messages_.front().size() >= kMostCalls); }

  [[nodiscard]] bool empty() const { return messages_.empty(); }

  /// The next message: the oldest calls that were not taken yet; empty when there are none.
  [[nodiscard]] std::optional<model::PlannerJournal> take();

 private:
  model::PlannerJournal head_;                            // of the next message
  std::deque<std::vector<model::PlannerCall>> messages_;  // the last one has room
  std::size_t size_ = 0;                                  // of the last one, at most [bytes]
};

}  // namespace interlace::core
