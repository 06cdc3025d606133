#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/model/messages.hpp"
#include "monitor/timeline.hpp"

namespace interlace::monitor {

/// A command as an observer knows it. Times [s] on the observer's line.
struct CommandRecord {
  model::CommandStatus status;          ///< the newest
  std::size_t number = 0;               ///< which command of its robot that was heard of it is, from 1 on; escapes are counted apart
  std::uint64_t planner = 0;            ///< incarnation whose time the stamps of `status` are in
  std::optional<double> waiting_since;  ///< when it was first seen unable to start although its robot was free
  std::optional<std::pair<double, double>> window;  ///< start window of its newest dispatch

  double submitted = 0;
  std::optional<double> start, end;
};

/// All commands of a cell that were heard of: those in work and the latest finished ones, within limits. Pure. Not thread-safe.
class CommandBook {
 public:
  static constexpr std::size_t kFinished = 400;   ///< finished commands that are remembered
  static constexpr std::size_t kRequests = 4000;  ///< targets of commands that are remembered
  static constexpr std::size_t kOpen = 20000;     ///< commands in work; beyond it the oldest are forgotten

  explicit CommandBook(const Timeline& line) : line_(line) {}

  /// What a client asked for; the newest request under an id counts.
  void on_request(const model::CommandSubmitted& command);
  /// `now`: of its reception [s]. Null when the planner's time is not known yet and it cannot be placed. The record stays where it is until
  /// the next call.
  const CommandRecord* on_status(std::uint64_t planner, const model::CommandStatus& status, double now);
  /// The start window that a dispatch gives the command; null when the command is not known.
  const CommandRecord* on_window(const model::CommandId& id, double earliest, double latest);
  /// Everything of other planners that is not final is lost; returns what that changed.
  std::vector<const CommandRecord*> on_planner(std::uint64_t planner, double now);

  [[nodiscard]] const CommandRecord* find(const model::CommandId& id) const;
  [[nodiscard]] const model::MotionRequest* request(const model::CommandId& id) const;
  /// The command of `robot` that cannot start although the robot is free, or is going to start later than it could; null: none.
  [[nodiscard]] const CommandRecord* held_up(const model::RobotName& robot, double now) const;
  /// Oldest first.
  [[nodiscard]] std::vector<const CommandRecord*> all() const;

 private:
  void forget();

  const Timeline& line_;
  std::map<model::CommandId, CommandRecord> records_;
  std::deque<model::CommandId> order_;                              // of the records, oldest first
  std::deque<model::CommandId> finished_;                           // final ones, oldest first
  std::map<std::pair<model::RobotName, bool>, std::size_t> heard_;  // commands and escapes of each robot so far
  std::map<model::CommandId, model::MotionRequest> requests_;
  std::deque<model::CommandId> request_order_;
};

/// The record as a frame has it (docs/monitor.md).
[[nodiscard]] nlohmann::json to_json(const CommandRecord& record);

/// Evidence with its times on the observer's line, on which the planner's zero lies at `zero` [s].
[[nodiscard]] nlohmann::json to_json(const std::vector<model::Conflict>& conflicts, double zero);

}  // namespace interlace::monitor
