#pragma once

#include <atomic>
#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/app/config/cell_file.hpp"
#include "common/dds/participant.hpp"
#include "common/dds/reader.hpp"
#include "common/dds/wait.hpp"
#include "monitor/daemon/asked.hpp"
#include "monitor/daemon/ros2_publisher.hpp"
#include "monitor/live_view.hpp"
#include "monitor/server/web_server.hpp"

namespace interlace::monitor {

/// The observer of one cell on DDS: takes messages, hands them to the view, and its frames to the server. Writes nothing to the cell's
/// domain. One thread builds it, runs it and destroys it; only stop() may be called from another.
class MonitorNode {
 public:
  /// With `ros2_domain` it shows the cell to ROS 2's tools as well, on that domain, another than the cell's.
  /// Throws std::runtime_error when DDS cannot be joined or the address cannot be had.
  MonitorNode(app::LoadedCell cell, std::uint32_t domain, const ServerOptions& server, Bundle bundle,
              std::optional<std::uint32_t> ros2_domain = std::nullopt);

  /// Works until stop().
  void run();
  /// Ends run(). Any thread, not a signal handler.
  void stop();

  [[nodiscard]] std::string url() const { return server_.url(); }

 private:
  using Clock = dds::Wait::Clock;

  struct Link {
    Link(dds::Participant& participant, const std::string& cell, const model::RobotName& robot);
    dds::Reader<dds::CommandMessage> commands;
    dds::Reader<dds::StatusMessage> statuses;
    dds::Reader<dds::DispatchMessage> dispatches;
    dds::Reader<dds::ExecutionMessage> executions;
    dds::Reader<dds::PostureMessage> postures;
  };
  void take_all();
  void show(Clock::time_point now);

  app::LoadedCell cell_;
  LiveView view_;
  dds::Participant participant_;
  dds::Reader<model::PlannerState> states_;
  std::vector<std::unique_ptr<Link>> links_;
  dds::Wait wait_;
  std::unique_ptr<Ros2Publisher> ros2_;  // null: nobody asked for it
  Asked asked_;
  Clock::time_point next_pose_{};
  std::atomic<bool> stopping_{false};
  WebServer server_;  // last: its thread ends before what it calls goes
};

}  // namespace interlace::monitor
