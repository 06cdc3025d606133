#pragma once

#include <cstddef>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "common/model/messages.hpp"

namespace interlace::app {

/// Count, mean, least, median, 99th percentile and largest of a set of durations.
struct DurationStatistics {
  std::size_t count = 0;
  double mean = 0, min = 0, p50 = 0, p99 = 0, max = 0;  ///< [ms]
};

/// Statistics of durations given in seconds.
[[nodiscard]] DurationStatistics statistics_of(std::vector<double> seconds);

/// One command of a run, times from the start of the run [s].
struct CommandRow {
  model::CommandId id;
  model::RobotName robot;
  bool escape = false;
  model::CommandId serves;  ///< of an escape
  double release = 0;
  std::optional<double> start, end;
  double delay = 0;
  model::CommandState state = model::CommandState::queued;
  model::Reason reason = model::Reason::none;
  std::string explanation;
  std::vector<model::Conflict> conflicts;      ///< what it last waited for; their times are from the start of the run, too
  std::vector<model::EscapeRefusal> refusals;  ///< of its last deadlock: what was tried in vain
  std::optional<double> deadline;              ///< from the start of the run [s]
  model::DeadlineVerdict verdict = model::DeadlineVerdict::none;
};

/// How a robot touched something that never moves.
struct FixtureContact {
  model::RobotName robot;
  std::string link, fixture;
  std::size_t count = 0;  ///< how often it began
  double clearance = 0;   ///< of the deepest one [m], ≤ 0
  double at = 0;          ///< its time [s]
};

/// Commands with a deadline, by what became of it. `open`: neither completed nor late when the run ended.
struct DeadlineCounts {
  std::size_t met = 0, late = 0, impossible = 0, open = 0;
};

/// What a run came to: the report of the contract (DESIGN section 8). What a program cannot know stays empty and is null in JSON.
struct RunReport {
  std::string strategy;
  double makespan = 0;  ///< first start to last end [s]
  std::size_t submitted = 0, completed = 0, rejected = 0, cancelled = 0, unserved = 0, escapes = 0;
  std::size_t warnings = 0;  ///< how often a command came into a deadlock that a person was asked to resolve
  DeadlineCounts deadlines;
  std::optional<std::size_t> collisions;  ///< with fixtures too
  std::vector<FixtureContact> fixture_contacts;
  std::optional<double> least_clearance;  ///< [m], from fixtures too
  std::optional<DurationStatistics> map_build, decision;
  std::vector<CommandRow> commands;
};

/// The report as one JSON object with the contract's field names.
[[nodiscard]] nlohmann::json to_json(const RunReport& report);

/// A few lines for people: how many completed, how long, what went wrong.
[[nodiscard]] std::string summary(const RunReport& report);

/// Collects a run's commands from their statuses. The same collector serves virtual time and DDS.
class ReportCollector {
 public:
  /// `origin`: planner time that counts as the start of the run.
  explicit ReportCollector(model::Instant origin) : origin_(origin) {}

  void on_submitted(const model::CommandId& id, const model::RobotName& robot, double release);

  /// Statuses of commands nobody submitted here are taken only when they are escapes.
  void on_status(const model::CommandStatus& status);

  [[nodiscard]] bool all_final() const { return open_ == 0; }
  [[nodiscard]] std::size_t open() const { return open_; }  ///< submitted and not yet final
  [[nodiscard]] const std::vector<CommandRow>& rows() const { return rows_; }

  /// How often a command newly came to the reason `deadlock`: each is a warning to people.
  [[nodiscard]] std::size_t warnings() const { return warnings_; }

  /// The counts, the makespan and the rows.
  [[nodiscard]] RunReport finish(std::string strategy) const;

 private:
  void note_deadlock(const model::CommandStatus& status);

  model::Instant origin_;
  std::vector<CommandRow> rows_;
  std::map<model::CommandId, std::size_t> by_id_;
  std::set<model::CommandId> deadlocked_;  // now
  std::size_t warnings_ = 0;
  std::size_t open_ = 0;
};

}  // namespace interlace::app
