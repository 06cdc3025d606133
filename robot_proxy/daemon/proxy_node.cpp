#include "robot_proxy/daemon/proxy_node.hpp"

#include <algorithm>
#include <random>
#include <stdexcept>

#include "common/app/logging.hpp"

namespace interlace::proxy {

using app::log;
using app::LogLevel;

namespace {

constexpr model::Duration kConnectTimeout = std::chrono::seconds{10};
constexpr model::Duration kFarewell = std::chrono::milliseconds{250};  // what was written last goes with its writer: time to be sent again
constexpr model::Duration kPlannerSilence = std::chrono::seconds{1};   // after which another planner is obeyed

std::uint64_t random_incarnation() {
  std::random_device device;
  const std::uint64_t value = (std::uint64_t{device()} << 32) | device();
  return value == 0 ? 1 : value;
}

}  // namespace

ProxyNode::ProxyNode(const app::LoadedCell& cell, model::RobotIndex robot, std::uint32_t domain, std::unique_ptr<Driver> driver)
    : robot_(cell.cell.robots[robot].name),
      fingerprint_(cell.fingerprint),
      incarnation_(random_incarnation()),
      driver_(std::move(driver)),
      participant_({domain, "interlace-proxy " + cell.cell.name + "/" + robot_.str()}),
      orders_(participant_, dds::topics::dispatch(cell.cell.name, robot_)),
      executions_(participant_, dds::topics::execution(cell.cell.name, robot_)),
      postures_(participant_, dds::topics::posture(cell.cell.name, robot_)) {
  wait_.attach(orders_);
  if (const auto connected = driver_->connect([this] { wait_.wake(); }, kConnectTimeout); !connected) {
    throw std::runtime_error("the controller of " + robot_.str() + " cannot be reached: " + connected.error());
  }
  executor_.emplace(robot_, driver_->capabilities());
  log(LogLevel::info, "ready", {{"cell", cell.cell.name}, {"robot", robot_.str()}, {"domain", domain}});
}

ProxyNode::~ProxyNode() {
  driver_->disconnect();
}

void ProxyNode::stop() {
  ++stops_;
  wait_.wake();
}

Moment ProxyNode::moment() const {
  const LocalTime t = now();
  return {t, clock_.at(t)};
}

void ProxyNode::run() {
  while (stops_ < 2) {
    auto deadline = next_posture_;
    if (const auto due = executor_->next_event(clock_.at(now()))) deadline = std::min(deadline, *due);
    (void)wait_.until(deadline);
    look_at_controller();
    take_orders();
    carry_out(executor_->advance(moment()));
    if (now() >= next_posture_) {
      publish_posture();
      next_posture_ = std::max(next_posture_ + dds::kPosturePeriod, now());
    }
    const bool idle = !executor_->running() && !executor_->waiting();
    if (leaving() && idle && !farewell_) farewell_ = now() + kFarewell;
    if (farewell_ && now() >= *farewell_) break;
  }
  log(LogLevel::info, "stopped", {{"robot", robot_.str()}, {"in_motion", executor_->running() != nullptr}});
}

void ProxyNode::look_at_controller() {
  seen_ = driver_->observe();
  carry_out(executor_->on(seen_, moment()));
}

bool ProxyNode::obeys(const dds::DispatchMessage& m) {
  const LocalTime t = now();
  const bool same_cell = m.fingerprint == fingerprint_;
  const bool in_charge = !planner_ || planner_->incarnation == m.planner_incarnation || t - planner_->heard > kPlannerSilence;
  if (same_cell && in_charge) {
    if (!planner_ || planner_->incarnation != m.planner_incarnation) {
      planner_ = PlannerInCharge{m.planner_incarnation, t, false};
      clock_.on_incarnation(m.planner_incarnation);
      carry_out(executor_->on_planner(m.planner_incarnation, moment()));
      log(LogLevel::info, "planner_heard", {{"robot", robot_.str()}});
    }
    planner_->heard = t;
    return true;
  }
  if (stranger_logged_ != m.planner_incarnation) {
    log(LogLevel::error, "planner_ignored",
        {{"robot", robot_.str()},
         {"why", same_cell ? "another planner of this cell is in charge" : "its cell file differs from the proxy's"}});
    stranger_logged_ = m.planner_incarnation;
  }
  return false;
}

void ProxyNode::on_heartbeat(const dds::Heartbeat& beat, std::uint64_t planner) {
  planner_->chose_us = beat.proxy_incarnation == incarnation_;
  if (!planner_->chose_us) return;
  held_ = beat.held;  // from a planner that has heard of us, and so of what we were told before
  const LocalTime t = now();
  clock_.on_echo({planner, LocalTime{beat.proxy_sent}, beat.planner_received, beat.planner_sent, t}, t);
}

void ProxyNode::take_orders() {
  orders_.take([this](dds::DispatchMessage&& m) {
    if (!obeys(m)) return;
    if (const auto* beat = std::get_if<dds::Heartbeat>(&m.order)) {
      on_heartbeat(*beat, m.planner_incarnation);
    } else if (const auto* withdrawal = std::get_if<model::Withdrawal>(&m.order)) {
      carry_out(executor_->on(*withdrawal, moment()));
    } else if (planner_->chose_us && !leaving()) {
      look_at_controller();
      carry_out(executor_->on(std::get<model::Dispatch>(m.order), moment()));
    }
  });
  if (orders_.counters().refused != refusals_logged_) {
    refusals_logged_ = orders_.counters().refused;
    log(LogLevel::warning, "sample_refused",
        {{"topic", orders_.name()}, {"total", refusals_logged_}, {"last", orders_.counters().last_refusal}});
  }
}

void ProxyNode::carry_out(const Actions& actions) {
  if (actions.start) {
    const auto& start = *actions.start;
    log(LogLevel::info, "starting", {{"robot", robot_.str()}, {"command", start.id.str()}});
    if (const auto taken = driver_->execute(start.request, start.number); !taken) {
      carry_out(executor_->refused_by_controller(start.number, taken.error(), moment()));
    }
  }
  if (actions.stop) {
    log(LogLevel::error, "stopping_controller", {{"robot", robot_.str()}});
    if (const auto stopped = driver_->stop(); !stopped)
      log(LogLevel::error, "not_stopped", {{"robot", robot_.str()}, {"why", stopped.error()}});
  }
  for (const auto& report : actions.reports) {
    if (!executions_.write({planner_ ? planner_->incarnation : 0, incarnation_, report})) {
      log(LogLevel::error, "not_sent", {{"topic", executions_.name()}, {"why", executions_.last_refusal()}});
    }
    log(LogLevel::info, model::to_string(report.state),
        {{"robot", robot_.str()},
         {"command", report.id.str()},
         {"attempt", report.attempt},
         {"at_s", model::to_seconds(report.at)},
         {"uncertainty_ms", 1e3 * report.uncertainty},
         {"text", report.text}});
  }
}

void ProxyNode::publish_posture() {
  dds::PostureMessage m;
  m.fingerprint = fingerprint_;
  m.proxy_incarnation = incarnation_;
  m.posture.robot = robot_;
  if (const auto clock = clock_.at(now()); clock && planner_) {
    m.planner_incarnation = planner_->incarnation;
    m.posture.at = clock->to_planner(seen_.at);
    m.posture.uncertainty = model::to_seconds(clock->uncertainty);
  }
  m.posture.joints = seen_.joints;
  m.posture.X_WT = seen_.X_WT;
  m.posture.holds = seen_.holds;
  m.held = held_;
  m.posture.moving = seen_.moving;
  m.posture.ready = seen_.ready && !leaving();
  if (const auto* id = executor_->running()) m.posture.motion = *id;
  m.proxy_sent = now().time_since_epoch();
  if (!postures_.write(m)) log(LogLevel::error, "not_sent", {{"topic", postures_.name()}, {"why", postures_.last_refusal()}});
}

}  // namespace interlace::proxy
