#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "common/model/messages.hpp"

/// What a planner was told and when, call by call: fed to a planner with the same cell and settings it gives the same decisions.
namespace interlace::model {

/// Nothing but time has passed.
struct TimePassed {};

/// All that a planner's core is ever told.
using PlannerEvent = std::variant<ClientRequest, PostureReported, ExecutionReported, TimePassed>;

/// What came of a call: how much, and a number that differs when anything in it does.
struct DecisionDigest {
  std::uint32_t dispatches = 0, withdrawals = 0, statuses = 0;
  std::uint64_t digest = 0;

  friend bool operator==(const DecisionDigest& a, const DecisionDigest& b) {
    return a.dispatches == b.dispatches && a.withdrawals == b.withdrawals && a.statuses == b.statuses && a.digest == b.digest;
  }
  friend bool operator!=(const DecisionDigest& a, const DecisionDigest& b) { return !(a == b); }
};

/// One call of the core.
struct PlannerCall {
  Instant now{};
  PlannerEvent event = TimePassed{};
  DecisionDigest decided;
};

/// What a planner was built with beside its cell; see core::PlannerOptions.
struct PlannerSettings {
  std::string strategy;
  bool escapes = true;
  Duration lead{}, start_tolerance{}, confirm{};
  std::optional<Duration> posture_timeout;
  Duration answer_timeout{}, patience{};
  std::uint64_t queue_limit = 0;
  std::string escape_prefix;
  std::uint64_t remembered = 0;
};

/// Planner → everyone: some calls in their order.
struct PlannerJournal {
  std::string cell;
  std::uint64_t fingerprint = 0;  ///< of the cell description
  std::uint64_t incarnation = 0;  ///< of the planner
  PlannerSettings settings;
  std::uint64_t first = 0;  ///< number of the first of `calls`; the planner's own first call is 0, so that a gap shows
  std::vector<PlannerCall> calls;
};

}  // namespace interlace::model
