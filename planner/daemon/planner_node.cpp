#include "planner/daemon/planner_node.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <random>
#include <type_traits>

#include "common/app/evidence.hpp"
#include "common/app/logging.hpp"
#include "common/app/report.hpp"

namespace interlace::daemon {

using app::log;
using app::LogLevel;

namespace {

// Defaults on a real network, where the cell file says nothing. A decision reaches the proxy well inside the lead, and the proxy finds the
// moment to start well inside the tolerance; when it does not, it refuses and the start is planned again.
constexpr double kLead = 0.04;            // [s]
constexpr double kStartTolerance = 0.06;  // [s]
constexpr std::chrono::milliseconds kPostureTimeout{500};
constexpr std::chrono::milliseconds kStateOnChange{50};  // the state follows changes no faster than this
constexpr std::chrono::milliseconds kQuiet{10};          // with nothing due for so long maps are prepared: hardly any takes longer
constexpr std::size_t kDecisionsKept = 100'000;

double elapsed_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

std::uint64_t random_incarnation() {
  std::random_device device;
  const std::uint64_t value = (std::uint64_t{device()} << 32) | device();
  return value == 0 ? 1 : value;
}

core::PlannerOptions core_options(const model::Cell& cell, const PlannerNodeOptions& options, std::uint64_t incarnation) {
  core::PlannerOptions o;
  o.strategy = options.strategy.empty() ? cell.planning.strategy : options.strategy;
  o.lead = model::from_seconds(cell.planning.lead.value_or(kLead));
  o.confirm = o.lead;
  o.start_tolerance = model::from_seconds(cell.planning.start_tolerance.value_or(kStartTolerance));
  o.posture_timeout = kPostureTimeout;
  o.escapes = cell.planning.escapes;
  o.patience = model::from_seconds(cell.planning.patience);
  o.escape_prefix = fmt::format("escape-{:016x}-", incarnation);  // no client and no proxy has heard of such an id before
  return o;
}

/// All that was tried for a deadlocked command.
std::string refusals_text(const std::vector<model::EscapeRefusal>& refusals) {
  std::string text;
  for (const auto& r : refusals) text += (text.empty() ? "" : "; ") + app::describe(r);
  return text;
}

/// One line for each change of a command. A deadlock is a warning with everything a person needs to resolve it.
void log_status(const model::CommandStatus& s) {
  const app::LogField robot{"robot", s.robot.str()}, command{"command", s.id.str()}, text{"text", s.text};
  if (s.reason == model::Reason::deadlock && !model::is_final(s.state)) {
    log(LogLevel::warning, "deadlock", {robot, command, text, {"refusals", refusals_text(s.refusals)}});
  } else if (s.escape) {
    log(LogLevel::info, model::to_string(s.state),
        {robot, {"escape", s.id.str()}, {"serves", s.serves.str()}, {"reason", model::to_string(s.reason)}, text});
  } else {
    log(LogLevel::info, model::to_string(s.state), {robot, command, {"reason", model::to_string(s.reason)}, text});
  }
}

}  // namespace

PlannerNode::Link::Link(dds::Participant& participant, const std::string& cell, const model::RobotName& name)
    : robot(name),
      commands(participant, dds::topics::command(cell, name)),
      executions(participant, dds::topics::execution(cell, name)),
      postures(participant, dds::topics::posture(cell, name)),
      statuses(participant, dds::topics::command_status(cell, name)),
      dispatches(participant, dds::topics::dispatch(cell, name)) {}

PlannerNode::PlannerNode(app::LoadedCell cell, const PlannerNodeOptions& options)
    : cell_(std::make_shared<const model::Cell>(std::move(cell.cell))),
      fingerprint_(cell.fingerprint),
      incarnation_(random_incarnation()),
      core_options_(core_options(*cell_, options, incarnation_)),
      planner_(cell_, core_options_),
      participant_({options.domain, "interlace-planner " + cell_->name}),
      states_(participant_, dds::topics::planner_state(cell_->name)),
      journal_(participant_, journal_head()) {
  for (const model::Robot& robot : cell_->robots) {
    links_.push_back(std::make_unique<Link>(participant_, cell_->name, robot.name));
    wait_.attach(links_.back()->commands);
    wait_.attach(links_.back()->executions);
    wait_.attach(links_.back()->postures);
  }
  log(LogLevel::info, "ready",
      {{"cell", cell_->name}, {"robots", cell_->robots.size()}, {"domain", options.domain}, {"strategy", planner_.state({}).strategy}});
}

void PlannerNode::stop() {
  stopping_ = true;
  wait_.wake();
}

void PlannerNode::run() {
  while (!stopping_) {
    auto deadline = std::min(next_heartbeat_, state_changed_ ? std::min(next_state_, Clock::now() + kStateOnChange) : next_state_);
    bool quiet = true;
    if (const auto due = planner_.next_deadline()) {
      deadline = std::min(deadline, epoch_ + due->time_since_epoch());
      quiet = Clock::now() + kQuiet < epoch_ + due->time_since_epoch();
    }
    // One map at a time: what comes in meanwhile waits no longer than that.
    const bool prepared = quiet && planner_.prepare();
    (void)wait_.until(prepared ? Clock::now() : deadline);
    take_all();
    const auto passed = now();
    const core::Decisions decisions = planner_.advance(passed);
    publish(decisions);
    journal_.note(passed, model::TimePassed{}, decisions);
    const auto t = Clock::now();
    if (t >= next_heartbeat_) {
      send_heartbeats();
      next_heartbeat_ = t + dds::kHeartbeatPeriod;
      log_refusals();
    }
    if (t >= next_state_ || (state_changed_ && t >= next_state_ - dds::kPlannerStatePeriod + kStateOnChange)) {
      send_state();
      next_state_ = t + dds::kPlannerStatePeriod;
    }
    journal_.send_when_due(t);
  }
  journal_.send_all();
  const auto decisions = app::statistics_of(decision_times_);
  const auto maps = planner_.maps().statistics();
  log(LogLevel::info, "stopped",
      {{"decisions", decisions.count},
       {"decision_p50_ms", decisions.p50},
       {"decision_p99_ms", decisions.p99},
       {"decision_max_ms", decisions.max},
       {"maps_built", maps.built},
       {"maps_reused", maps.reused},
       {"maps_evicted", maps.evicted},
       {"maps_kept", maps.kept},
       {"maps_bytes", maps.bytes}});
}

template <typename Event>
void PlannerNode::decide(const Event& event) {
  const double before = elapsed_seconds();
  const auto t = now();
  const core::Decisions decisions = planner_.on(event, t);
  if (!decisions.empty() && decision_times_.size() < kDecisionsKept) decision_times_.push_back(elapsed_seconds() - before);
  publish(decisions);
  journal_.note(t, event, decisions);
  // The proxies remember holds: they must know before this planner could be gone.
  if constexpr (std::is_same_v<Event, model::HoldRequested> || std::is_same_v<Event, model::ResumeRequested>) send_heartbeats();
}

void PlannerNode::take_all() {
  for (auto& link : links_) {
    // Postures and executions first: a command is judged by the newest that is known.
    link->postures.take([&](dds::PostureMessage&& m) { take_posture(*link, m); });
    link->executions.take([&](dds::ExecutionMessage&& m) {
      if (m.planner_incarnation == incarnation_ && link->proxy && m.proxy_incarnation == link->proxy->incarnation) decide(m.report);
    });
  }
  for (auto& link : links_) {
    link->commands.take([&](dds::CommandMessage&& m) { std::visit([&](const auto& request) { decide(request); }, m.request); });
  }
}

void PlannerNode::take_posture(Link& link, const dds::PostureMessage& m) {
  const auto t = now();
  const bool same_cell = m.fingerprint == fingerprint_;
  const bool in_charge = !link.proxy || link.proxy->incarnation == m.proxy_incarnation || t - link.proxy->received > kPostureTimeout;
  if (!same_cell || !in_charge) {
    if (link.stranger_logged != m.proxy_incarnation) {
      log(LogLevel::error, "proxy_ignored",
          {{"robot", link.robot.str()},
           {"why", same_cell ? "another proxy of this robot is working" : "its cell file differs from the planner's"}});
      link.stranger_logged = m.proxy_incarnation;
    }
    return;
  }
  if (!link.proxy || link.proxy->incarnation != m.proxy_incarnation) {
    log(LogLevel::info, "proxy_heard", {{"robot", link.robot.str()}});
    state_changed_ = true;
  }
  const bool first = !link.proxy;
  link.proxy = ProxyEcho{m.proxy_incarnation, m.proxy_sent, t};
  model::PostureReported posture = m.posture;
  if (m.planner_incarnation != incarnation_) {
    posture.at = t;         // the proxy does not know our time yet,
    posture.ready = false;  // so it could not keep a start window
  }
  decide(posture);
  // The planner before this one was told to hold it, and nobody has resumed it.
  if (first && m.held)
    decide(
        model::HoldRequested{model::CommandId{fmt::format("still-held-{:016x}-{}", incarnation_, *cell_->find(link.robot))}, link.robot});
}

PlannerNode::Link& PlannerNode::link_of(const model::RobotName& robot) {
  return *links_[cell_->find(robot).value()];
}

dds::DispatchMessage PlannerNode::envelope() const {
  dds::DispatchMessage message;
  message.planner_incarnation = incarnation_;
  message.fingerprint = fingerprint_;
  return message;
}

model::PlannerJournal PlannerNode::journal_head() const {
  model::PlannerJournal head;
  head.cell = cell_->name;
  head.fingerprint = fingerprint_;
  head.incarnation = incarnation_;
  head.settings = core::settings_of(core_options_);
  return head;
}

void PlannerNode::publish(const core::Decisions& decisions) {
  if (decisions.empty()) return;
  state_changed_ = true;
  const auto send = [](auto& writer, const auto& message) {
    if (!writer.write(message)) log(LogLevel::error, "not_sent", {{"topic", writer.name()}, {"why", writer.last_refusal()}});
  };
  // Orders before news: nothing may hold up a start.
  for (const auto& w : decisions.withdrawals) {
    auto message = envelope();
    message.order = w;
    send(link_of(w.robot).dispatches, message);
    log(LogLevel::info, "withdrawn", {{"robot", w.robot.str()}, {"command", w.id.str()}, {"attempt", w.attempt}});
  }
  for (const auto& d : decisions.dispatches) {
    auto message = envelope();
    message.order = d;
    send(link_of(d.robot).dispatches, message);
    log(LogLevel::info, "dispatched",
        {{"robot", d.robot.str()},
         {"command", d.id.str()},
         {"attempt", d.attempt},
         {"earliest_s", model::to_seconds(d.earliest)},
         {"latest_s", model::to_seconds(d.latest)},
         {"duration_s", d.duration}});
  }
  for (const auto& s : decisions.statuses) {
    if (cell_->find(s.robot)) send(link_of(s.robot).statuses, dds::StatusMessage{incarnation_, s});
    log_status(s);
  }
}

void PlannerNode::send_heartbeats() {
  for (auto& link : links_) {
    dds::Heartbeat beat;
    beat.robot = link->robot;
    if (link->proxy) {
      beat.proxy_incarnation = link->proxy->incarnation;
      beat.proxy_sent = link->proxy->sent;
      beat.planner_received = link->proxy->received;
    }
    beat.planner_sent = now();
    beat.held = planner_.is_held(*cell_->find(link->robot));
    auto message = envelope();
    message.order = beat;
    (void)link->dispatches.write(message);  // the next one comes in a tenth of a second
  }
}

model::PlannerState PlannerNode::state() {
  model::PlannerState s = planner_.state(now());
  s.fingerprint = fingerprint_;
  s.incarnation = incarnation_;
  for (const auto& link : links_) {
    s.refused_samples += link->commands.counters().refused + link->executions.counters().refused + link->postures.counters().refused;
  }
  return s;
}

void PlannerNode::send_state() {
  const model::PlannerState s = state();
  for (std::size_t i = 0; i < links_.size(); ++i) {
    const bool known = s.robots[i].mode != model::RobotMode::unknown;
    const bool was_known = links_[i]->mode != model::RobotMode::unknown;
    if (known != was_known)
      log(known ? LogLevel::info : LogLevel::warning, known ? "robot_known" : "robot_lost", {{"robot", links_[i]->robot.str()}});
    links_[i]->mode = s.robots[i].mode;
  }
  if (!states_.write(s)) log(LogLevel::error, "not_sent", {{"topic", states_.name()}, {"why", states_.last_refusal()}});
  state_changed_ = false;
}

void PlannerNode::log_refusals() {
  for (auto& link : links_) {
    const auto refused = link->commands.counters().refused + link->executions.counters().refused + link->postures.counters().refused;
    if (refused == link->refusals_logged) continue;
    for (const dds::ReaderBase* reader :
         std::initializer_list<const dds::ReaderBase*>{&link->commands, &link->executions, &link->postures}) {
      if (reader->counters().last_refusal.empty()) continue;
      log(LogLevel::warning, "sample_refused",
          {{"topic", reader->name()}, {"total", reader->counters().refused}, {"last", reader->counters().last_refusal}});
    }
    link->refusals_logged = refused;
  }
}

}  // namespace interlace::daemon
