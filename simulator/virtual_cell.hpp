#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/app/report.hpp"
#include "common/model/journal.hpp"
#include "common/model/program.hpp"
#include "planner/core/planner.hpp"
#include "simulator/trace.hpp"

namespace interlace::sim {

struct VirtualOptions {
  std::string strategy = "event";
  std::uint64_t seed = 1;                                          ///< of the controllers' latencies and speed errors
  double trace_period = 0.01;                                      ///< [s]
  double check_period = 0.001;                                     ///< between the postures whose clearance is judged [s]
  TraceWriter* trace = nullptr;                                    ///< not owned; null: no trace
  std::function<double()> stopwatch;                               ///< elapsed seconds, for the statistics; may be empty
  std::function<void(double, std::size_t, std::size_t)> progress;  ///< virtual time [s], commands finished, commands in all
  bool prepare = false;  ///< the planner builds maps while nothing is due, as much as a daemon would manage; decisions are the same
  bool observe = true;   ///< judge clearance and collisions; false leaves them empty in the report

  // For judges of their own.
  std::function<void(const model::CommandStatus&)> on_status;                  ///< everything the planner says of a command
  std::function<void(double, const std::vector<model::Joints>&)> on_postures;  ///< every check_period: time [s], all robots [rad]
  /// What a robot holds, before the first posture and the first after each change.
  std::function<void(model::RobotIndex, model::ToolSet)> on_tools;
  std::function<void(const std::vector<double>&)> on_map_builds;    ///< at the end: what each map took [s]; needs a stopwatch
  core::MapStore::Listener on_map;                                  ///< before each map is built
  std::function<void(double, const core::Decisions&)> on_decision;  ///< each call of the planner: what it took [s], 0 without a stopwatch
  std::function<void(const core::MapStatistics&)> on_maps;          ///< at the end

  // For a recording.
  std::function<void(const core::PlannerOptions&)> on_begin;  ///< before all others: what the planner is built with
  /// Each call of the planner: what it was told, when, and what it decided.
  std::function<void(model::Instant, const model::PlannerEvent&, const core::Decisions&)> on_call;
  std::function<void(const model::PostureReported&)> on_row;  ///< every trace_period, of every robot
  std::function<void(const model::PlannerState&)> on_state;   ///< every second; what only its sender knows is empty
};

/// A client's request at its time.
struct Release {
  model::Instant at;
  model::ClientRequest request;
};

/// Runs `program` on `cell` in virtual time: the daemon's planner core, the proxies' executors and the simulated controllers, joined by
/// messages that take no time. Deterministic for a seed. Ends when every command is final or nothing can happen any more.
/// The least clearance and the collisions are judged from the controllers' postures by the observer, not by the planner.
/// Throws std::invalid_argument when the strategy is unknown.
[[nodiscard]] app::RunReport run_virtual(std::shared_ptr<const model::Cell> cell, const model::Program& program,
                                         const VirtualOptions& options);
/// The same for requests in the order of their time.
[[nodiscard]] app::RunReport run_virtual(std::shared_ptr<const model::Cell> cell, const std::vector<Release>& requests,
                                         const VirtualOptions& options);

}  // namespace interlace::sim
