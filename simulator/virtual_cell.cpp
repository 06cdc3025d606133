#include "simulator/virtual_cell.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <limits>
#include <variant>

#include "monitor/clearance_observer.hpp"
#include "planner/core/journal.hpp"
#include "robot_proxy/drivers/sim/sim_controller.hpp"
#include "robot_proxy/executor.hpp"

namespace interlace::sim {

using model::Duration;
using model::Instant;
using proxy::LocalTime;

namespace {

/// In virtual time the proxies' clocks and the planner's show the same.
LocalTime local(Instant t) {
  return LocalTime{t.time_since_epoch()};
}
Instant planner_time(LocalTime t) {
  return Instant{t.time_since_epoch()};
}
proxy::Moment moment(Instant t) {
  return {local(t), proxy::ClockEstimate{}};
}

/// One robot with its controller and the proxy's decisions.
struct VirtualRobot {
  VirtualRobot(const model::Robot& r, std::uint64_t seed)
      : robot(r), controller(r, options(seed)), executor(r.name, controller.capabilities()) {}

  static proxy::SimOptions options(std::uint64_t seed) {
    proxy::SimOptions o;
    o.seed = seed;
    return o;
  }

  const model::Robot& robot;
  proxy::SimController controller;
  proxy::Executor executor;
};

using Message = std::variant<model::ClientRequest, model::PostureReported, model::ExecutionReported, model::Dispatch, model::Withdrawal>;

model::CommandSubmitted command_of(std::string id, const model::RobotName& robot, const model::ProgramStep& step) {
  return {model::CommandId{std::move(id)}, robot, step.motion, step.priority, step.deadline};
}

/// `number` counts the program's events, from 1.
model::ClientRequest request_of(const model::ProgramEvent& event, std::size_t number) {
  using What = model::ProgramEvent::What;
  const model::CommandId id{fmt::format("event-{}", number)};
  switch (event.what) {
    case What::hold: return model::HoldRequested{id, event.robot};
    case What::resume: return model::ResumeRequested{id, event.robot};
    case What::cancel:
      return model::CommandCancelled{model::CommandId{fmt::format("{}-{}", event.robot.str(), event.command)}, event.robot};
    case What::replace: break;
  }
  model::QueueReplaced replacement{id, event.robot, {}};
  for (const model::ProgramStep& step : event.commands) {
    replacement.commands.push_back(
        command_of(fmt::format("{}-event-{}-{}", event.robot.str(), number, replacement.commands.size() + 1), event.robot, step));
  }
  return replacement;
}

/// Commands and events in the order of their time; where several come at once commands first, robots in turn.
std::vector<Release> releases_of(const model::Program& program) {
  std::vector<Release> all;
  std::size_t longest = 0;
  for (const auto& [robot, steps] : program.robots) longest = std::max(longest, steps.size());
  for (std::size_t i = 0; i < longest; ++i) {
    for (const auto& [robot, steps] : program.robots) {
      if (i >= steps.size()) continue;
      all.push_back({model::at_seconds(steps[i].at), command_of(fmt::format("{}-{}", robot.str(), i + 1), robot, steps[i])});
    }
  }
  for (std::size_t i = 0; i < program.events.size(); ++i) {
    all.push_back({model::at_seconds(program.events[i].at), request_of(program.events[i], i + 1)});
  }
  std::stable_sort(all.begin(), all.end(), [](const Release& a, const Release& b) { return a.at < b.at; });
  return all;
}

/// Commands among them, those of replacements too.
std::size_t commands_in(const std::vector<Release>& releases) {
  std::size_t count = 0;
  for (const Release& r : releases) {
    if (std::holds_alternative<model::CommandSubmitted>(r.request)) ++count;
    if (const auto* replacement = std::get_if<model::QueueReplaced>(&r.request)) count += replacement->commands.size();
  }
  return count;
}

class World {
 public:
  World(std::shared_ptr<const model::Cell> cell, const std::vector<Release>& releases, const VirtualOptions& options)
      : cell_(std::move(cell)),
        options_(options),
        planner_(cell_, planner_options()),
        observer_(*cell_, options.check_period, std::numeric_limits<double>::infinity()),
        collector_(Instant{}),
        releases_(releases.begin(), releases.end()),
        total_(commands_in(releases)),
        postures_(cell_->robots.size()),
        held_(cell_->robots.size()) {
    planner_.maps().on_build(options.on_map);
    for (const model::Robot& robot : cell_->robots) robots_.push_back(std::make_unique<VirtualRobot>(robot, options.seed + robots_.size()));
  }

  app::RunReport run() {
    if (options_.on_begin) options_.on_begin(planner_options());
    for (auto& r : robots_) look_at(*r);
    deliver();
    while (const auto next = next_instant()) {
      if (options_.prepare) prepare_until(*next);
      watch_until(*next);
      now_ = std::max(now_, *next);
      step();
      if (options_.progress)
        options_.progress(model::to_seconds(now_), std::min(total_, collector_.rows().size() - collector_.open()), total_);
      if (releases_.empty() && collector_.all_final()) break;
    }
    watch_until(now_ + model::from_seconds(options_.trace_period));
    app::RunReport report = collector_.finish(options_.strategy);
    if (options_.observe) report.collisions = observer_.contacts();
    report.fixture_contacts = observer_.fixtures().report();
    report.least_clearance = observer_.least_clearance();
    if (options_.on_maps) options_.on_maps(planner_.maps().statistics());
    if (options_.stopwatch) {
      auto builds = planner_.maps().take_build_times();
      if (options_.on_map_builds) options_.on_map_builds(builds);
      report.map_build = app::statistics_of(std::move(builds));
      report.decision = app::statistics_of(std::move(decision_times_));
    }
    return report;
  }

 private:
  core::PlannerOptions planner_options() const {
    core::PlannerOptions o;
    o.strategy = options_.strategy;
    o.escapes = cell_->planning.escapes;
    o.patience = model::from_seconds(cell_->planning.patience);
    o.lead = model::from_seconds(cell_->planning.lead.value_or(0));
    o.confirm = o.lead;
    o.start_tolerance = model::from_seconds(cell_->planning.start_tolerance.value_or(0));
    o.queue_limit = std::numeric_limits<std::size_t>::max();
    o.stopwatch = options_.stopwatch;
    return o;
  }

  [[nodiscard]] std::optional<Instant> next_instant() const {
    std::optional<Instant> next;
    const auto consider = [&](const std::optional<Instant>& t) {
      if (t) next = next ? std::min(*next, *t) : *t;
    };
    if (!releases_.empty()) consider(releases_.front().at);
    consider(planner_.next_deadline());
    for (const auto& r : robots_) {
      if (const auto t = r->controller.next_event(local(now_))) consider(planner_time(*t));
      if (const auto t = r->executor.next_event(proxy::ClockEstimate{})) consider(planner_time(*t));
    }
    return next;
  }

  /// What the daemon does between events: it prepares as long as nothing is due within `kQuiet`.
  void prepare_until(Instant next) {
    constexpr Duration kQuiet = std::chrono::milliseconds{10};
    constexpr Duration kMap = std::chrono::milliseconds{2};  // on average it takes a fraction of this
    for (Instant t = now_; t + kQuiet < next && planner_.prepare(); t += kMap) {
    }
  }

  void step() {
    for (auto& r : robots_) look_at(*r);
    deliver();
    for (auto& r : robots_) act(*r, r->executor.advance(moment(now_)));
    deliver();
    while (!releases_.empty() && releases_.front().at <= now_) {
      Release& next = releases_.front();
      const auto note = [&](const model::CommandSubmitted& c) { collector_.on_submitted(c.id, c.robot, model::to_seconds(next.at)); };
      if (const auto* command = std::get_if<model::CommandSubmitted>(&next.request)) note(*command);
      if (const auto* replacement = std::get_if<model::QueueReplaced>(&next.request)) {
        std::for_each(replacement->commands.begin(), replacement->commands.end(), note);
      }
      mail_.emplace_back(std::move(next.request));
      releases_.pop_front();
    }
    deliver();
    decide(model::TimePassed{});
    deliver();
  }

  /// The proxy reads its controller, as it does at every change, and says where the robot is.
  void look_at(VirtualRobot& r) {
    const auto seen = r.controller.observe(local(now_));
    act(r, r.executor.on(seen, moment(now_)));
    mail_.emplace_back(posture_of(r, seen, now_));
  }

  [[nodiscard]] static model::PostureReported posture_of(const VirtualRobot& r, const proxy::ControllerState& seen, Instant at) {
    model::PostureReported posture;
    posture.robot = r.robot.name;
    posture.at = at;
    posture.joints = seen.joints;
    posture.holds = seen.holds;
    posture.X_WT = seen.X_WT;
    posture.moving = seen.moving;
    posture.ready = seen.ready;
    if (const auto* id = r.executor.running()) posture.motion = *id;
    return posture;
  }

  /// One row of what goes on: postures, and once a second what the planner knows.
  void show_row(double t) {
    const Instant at = model::at_seconds(t);
    for (std::size_t i = 0; i < robots_.size(); ++i) {
      const auto seen = robots_[i]->controller.observe(local(at));
      if (options_.trace) options_.trace->row(t, robots_[i]->robot, seen.joints, seen.moving ? ids_[i] : std::string{});
      if (options_.on_row) options_.on_row(posture_of(*robots_[i], seen, at));
    }
    if (!options_.on_state || at < next_state_) return;
    options_.on_state(planner_.state(at));
    next_state_ = at + std::chrono::seconds{1};
  }

  void act(VirtualRobot& r, const proxy::Actions& actions) {
    for (const auto& report : actions.reports) mail_.emplace_back(report);
    if (actions.stop) (void)r.controller.stop(local(now_));
    if (!actions.start) return;
    if (const auto taken = r.controller.execute(actions.start->request, actions.start->number, local(now_)); !taken) {
      act(r, r.executor.refused_by_controller(actions.start->number, taken.error(), moment(now_)));
      return;
    }
    ids_[cell_->find(r.robot.name).value()] = actions.start->id.str();
    act(r, r.executor.on(r.controller.observe(local(now_)), moment(now_)));
  }

  void decide(const model::PlannerEvent& event) {
    const double before = options_.stopwatch ? options_.stopwatch() : 0;
    core::Decisions d = core::apply(planner_, event, now_);
    const double took = options_.stopwatch ? options_.stopwatch() - before : 0;
    if (options_.stopwatch) decision_times_.push_back(took);
    if (options_.on_decision) options_.on_decision(took, d);
    if (options_.on_call) options_.on_call(now_, event, d);
    for (const auto& s : d.statuses) {
      collector_.on_status(s);
      if (options_.on_status) options_.on_status(s);
    }
    for (auto& x : d.withdrawals) mail_.emplace_back(std::move(x));
    for (auto& x : d.dispatches) mail_.emplace_back(std::move(x));
  }

  VirtualRobot& proxy_of(const model::RobotName& name) { return *robots_[cell_->find(name).value()]; }

  void deliver() {
    while (!mail_.empty()) {
      const Message message = std::move(mail_.front());
      mail_.pop_front();
      if (const auto* d = std::get_if<model::Dispatch>(&message)) {
        VirtualRobot& r = proxy_of(d->robot);
        act(r, r.executor.on(*d, moment(now_)));
      } else if (const auto* w = std::get_if<model::Withdrawal>(&message)) {
        VirtualRobot& r = proxy_of(w->robot);
        act(r, r.executor.on(*w, moment(now_)));
      } else if (const auto* q = std::get_if<model::ClientRequest>(&message)) {
        decide(*q);
      } else if (const auto* p = std::get_if<model::PostureReported>(&message)) {
        decide(*p);
      } else if (const auto* e = std::get_if<model::ExecutionReported>(&message)) {
        decide(*e);
      }
    }
  }

  void look_for_watchers(model::RobotIndex i, LocalTime at) {
    postures_[i] = robots_[i]->controller.joints(at);
    if (held_[i] && cell_->tools.empty()) return;
    const model::ToolSet held = cell_->set_of(robots_[i]->controller.holds(at));
    if (held_[i] != held && options_.on_tools) options_.on_tools(i, held);
    held_[i] = held;
  }

  /// Feeds trace and observer with what happens up to `until`.
  void watch_until(Instant until) {
    const double end = model::to_seconds(until);
    for (; checked_ * options_.check_period < end; ++checked_) {
      const double t = checked_ * options_.check_period;
      for (std::size_t i = 0; i < robots_.size(); ++i) look_for_watchers(i, local(model::at_seconds(t)));
      if (options_.on_postures) options_.on_postures(t, postures_);
      if (!options_.observe) continue;
      for (std::size_t i = 0; i < robots_.size(); ++i) observer_.on_posture(i, t, postures_[i], held_[i].value_or(model::ToolSet{}));
    }
    if (!options_.trace && !options_.on_row) return;
    for (; traced_ * options_.trace_period < end; ++traced_) show_row(traced_ * options_.trace_period);
  }

  std::shared_ptr<const model::Cell> cell_;
  const VirtualOptions& options_;
  core::Planner planner_;
  monitor::ClearanceObserver observer_;
  app::ReportCollector collector_;
  std::vector<std::unique_ptr<VirtualRobot>> robots_;
  std::map<std::size_t, std::string> ids_;  // command each robot was last started with
  std::deque<Release> releases_;
  std::size_t total_;
  std::vector<model::Joints> postures_;              // at the last check
  std::vector<std::optional<model::ToolSet>> held_;  // likewise
  std::deque<Message> mail_;
  std::vector<double> decision_times_;
  Instant now_{};
  Instant next_state_{};
  double checked_ = 0, traced_ = 0;  // steps done
};

}  // namespace

app::RunReport run_virtual(std::shared_ptr<const model::Cell> cell, const model::Program& program, const VirtualOptions& options) {
  return World{std::move(cell), releases_of(program), options}.run();
}

app::RunReport run_virtual(std::shared_ptr<const model::Cell> cell, const std::vector<Release>& requests, const VirtualOptions& options) {
  return World{std::move(cell), requests, options}.run();
}

}  // namespace interlace::sim
