#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/app/config/cell_file.hpp"
#include "common/dds/participant.hpp"
#include "common/dds/reader.hpp"
#include "common/dds/wait.hpp"
#include "common/dds/writer.hpp"
#include "planner/core/planner.hpp"
#include "planner/daemon/journal_writer.hpp"

namespace interlace::daemon {

struct PlannerNodeOptions {
  std::uint32_t domain = 0;
  std::string strategy;  ///< empty: the cell file's
};

/// The planner of one cell on DDS: takes messages, converts, asks the core, publishes what changed. Owns planner time.
/// One thread builds it, runs it and destroys it; only stop() may be called from another.
class PlannerNode {
 public:
  /// Throws std::invalid_argument for an unknown strategy, std::runtime_error when DDS cannot be joined.
  PlannerNode(app::LoadedCell cell, const PlannerNodeOptions& options);

  /// Works until stop().
  void run();

  /// Ends run(). Any thread, not a signal handler.
  void stop();

 private:
  using Clock = std::chrono::steady_clock;

  /// What the proxy last said of itself: for the echo, and to tell a second proxy from the one in charge.
  struct ProxyEcho {
    std::uint64_t incarnation = 0;
    model::Duration sent{};
    model::Instant received{};
  };
  struct Link {
    Link(dds::Participant& participant, const std::string& cell, const model::RobotName& name);
    model::RobotName robot;
    dds::Reader<dds::CommandMessage> commands;
    dds::Reader<dds::ExecutionMessage> executions;
    dds::Reader<dds::PostureMessage> postures;
    dds::Writer<dds::StatusMessage> statuses;
    dds::Writer<dds::DispatchMessage> dispatches;
    std::optional<ProxyEcho> proxy;
    std::uint64_t refusals_logged = 0;
    std::uint64_t stranger_logged = 0;                  // incarnation of the last proxy that was not listened to
    model::RobotMode mode = model::RobotMode::unknown;  // as last logged
  };

  [[nodiscard]] model::Instant now() const { return model::Instant{Clock::now() - epoch_}; }
  void take_all();
  void take_posture(Link& link, const dds::PostureMessage& message);
  void publish(const core::Decisions& decisions);
  void send_heartbeats();
  void send_state();
  void log_refusals();
  [[nodiscard]] model::PlannerState state();
  [[nodiscard]] Link& link_of(const model::RobotName& robot);
  [[nodiscard]] dds::DispatchMessage envelope() const;
  [[nodiscard]] model::PlannerJournal journal_head() const;

  template <typename Event>
  void decide(const Event& event);

  std::shared_ptr<const model::Cell> cell_;
  std::uint64_t fingerprint_;
  std::uint64_t incarnation_;
  Clock::time_point epoch_ = Clock::now();
  core::PlannerOptions core_options_;
  core::Planner planner_;
  dds::Participant participant_;
  std::vector<std::unique_ptr<Link>> links_;
  dds::Writer<model::PlannerState> states_;
  JournalWriter journal_;
  dds::Wait wait_;
  Clock::time_point next_heartbeat_{}, next_state_{};
  bool state_changed_ = true;
  std::vector<double> decision_times_;
  std::atomic<bool> stopping_{false};
};

}  // namespace interlace::daemon
