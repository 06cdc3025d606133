#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "common/app/config/cell_file.hpp"
#include "common/dds/participant.hpp"
#include "common/dds/reader.hpp"
#include "common/dds/wait.hpp"
#include "common/dds/writer.hpp"
#include "robot_proxy/clock_offset.hpp"
#include "robot_proxy/driver.hpp"
#include "robot_proxy/executor.hpp"

namespace interlace::proxy {

/// One robot's proxy on DDS: publishes the controller's posture, feeds the executor and carries out what it decides.
/// One thread builds it, runs it and destroys it; only stop() may be called from another.
class ProxyNode {
 public:
  /// `driver` must be connected only by this object. Throws std::runtime_error when the controller or DDS cannot be reached.
  ProxyNode(const app::LoadedCell& cell, model::RobotIndex robot, std::uint32_t domain, std::unique_ptr<Driver> driver);
  ~ProxyNode();
  ProxyNode(const ProxyNode&) = delete;
  ProxyNode& operator=(const ProxyNode&) = delete;

  /// Works until stop().
  void run();

  /// First call: takes no more work, run() ends when the running motion has ended, as others count on its arrival. Second call: run()
  /// ends at once. Any thread, not a signal handler.
  void stop();

 private:
  /// The planner obeyed, as long as it is heard.
  struct PlannerInCharge {
    std::uint64_t incarnation = 0;
    LocalTime heard{};
    bool chose_us = false;  // its echo names this proxy, so no other proxy of the robot is meant
  };

  [[nodiscard]] static LocalTime now() { return std::chrono::steady_clock::now(); }
  [[nodiscard]] Moment moment() const;
  [[nodiscard]] bool leaving() const { return stops_ > 0; }
  void look_at_controller();
  void take_orders();
  [[nodiscard]] bool obeys(const dds::DispatchMessage& message);
  void on_heartbeat(const dds::Heartbeat& beat, std::uint64_t planner);
  void carry_out(const Actions& actions);
  void publish_posture();

  model::RobotName robot_;
  std::uint64_t fingerprint_;
  std::uint64_t incarnation_;
  std::unique_ptr<Driver> driver_;
  dds::Participant participant_;
  dds::Reader<dds::DispatchMessage> orders_;
  dds::Writer<dds::ExecutionMessage> executions_;
  dds::Writer<dds::PostureMessage> postures_;
  dds::Wait wait_;
  ClockOffset clock_;
  std::optional<Executor> executor_;
  ControllerState seen_;
  std::optional<PlannerInCharge> planner_;
  bool held_ = false;  // what the planner said last; a planner that starts learns it from us
  std::uint64_t stranger_logged_ = 0;
  std::uint64_t refusals_logged_ = 0;
  LocalTime next_posture_{};
  std::optional<LocalTime> farewell_;  // when to go, once told to and idle
  std::atomic<int> stops_{0};
};

}  // namespace interlace::proxy
