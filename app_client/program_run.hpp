#pragma once

#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "app_client/client.hpp"
#include "app_client/release_plan.hpp"
#include "common/app/report.hpp"

namespace interlace::client {

struct ProgramRunOptions {
  double stalled_after = 30;  ///< give up when no robot of the cell has moved and nothing has changed for this long [s]; 0: never
  double wind_down = 60;      ///< longest wait for running motions after giving up [s]
  std::size_t window = 500;   ///< commands per robot on their way at a time; below the planner's queue limit
};

/// How a run ended.
enum class RunEnd {
  finished,     ///< every command is final
  interrupted,  ///< asked to stop; what had not started was given up
  stalled,      ///< nothing could move any more; likewise
  planner_lost  ///< the planner is silent or was restarted
};

/// Runs a program through a connected client: releases commands in time, follows them to their end, collects the report.
/// Same thread as the client, whose callback on_answer it takes over.
class ProgramRun {
 public:
  /// Called for every change of a command of the program, and of an escape that serves one: which command (null: an escape), what is
  /// known, seconds since the start.
  using OnChange = std::function<void(const PlannedCommand*, const Answer&, double)>;

  ProgramRun(Client& client, std::vector<PlannedCommand> plan, ProgramRunOptions options, OnChange on_change);
  ~ProgramRun();
  ProgramRun(const ProgramRun&) = delete;
  ProgramRun& operator=(const ProgramRun&) = delete;

  /// Runs to the end. `interrupted` is asked after everything that happens and after Client::wake().
  [[nodiscard]] RunEnd run(const std::function<bool()>& interrupted);

  /// What it came to, with a row for every command of the program, also for those never submitted.
  [[nodiscard]] app::RunReport report() const;

 private:
  void on_answer(const Answer& answer);
  void release(LocalTime now);
  [[nodiscard]] LocalTime next_release() const;
  [[nodiscard]] bool all_done() const { return released_ == plan_.size() && client_.open() == 0; }
  [[nodiscard]] bool stalled(LocalTime now);
  [[nodiscard]] bool planner_lost(LocalTime now);
  void give_up();
  app::ReportCollector& collector(model::Instant origin);

  Client& client_;
  std::vector<PlannedCommand> plan_;
  ProgramRunOptions options_;
  OnChange on_change_;
  std::unordered_map<model::CommandId, std::size_t> index_;
  std::map<model::RobotName, std::deque<std::size_t>> waiting_;  // per robot, not submitted yet
  std::size_t released_ = 0;
  bool giving_up_ = false;
  LocalTime start_{};
  LocalTime changed_{};  // when anything last happened that is no standstill
  LocalTime planner_seen_{};
  std::vector<model::CommandStatus> early_escapes_;  // heard before the first status: topics of different robots keep no common order
  std::optional<app::ReportCollector> collector_;    // from the first status on: that places the start of the run in planner time
};

}  // namespace interlace::client
