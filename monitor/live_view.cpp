#include "monitor/live_view.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "planner/core/neighbourhood.hpp"

namespace interlace::monitor {

namespace {

constexpr double kObserverStep = 0.005;  // [s]
constexpr double kSilence = 0.5;         // after which a robot is no longer known [s]
constexpr double kFirstWords = 3;        // as long may those take that were never heard [s]

Pairs pairs_of(const model::Cell& cell) {
  const core::Neighbourhood neighbourhood{cell};
  Pairs pairs;
  for (model::RobotIndex a = 0; a < cell.robots.size(); ++a) {
    for (model::RobotIndex b = a + 1; b < cell.robots.size(); ++b) {
      if (neighbourhood.meet(a, b)) pairs.emplace_back(a, b);
    }
  }
  return pairs;
}

}  // namespace

LiveView::LiveView(const app::LoadedCell& cell, LocalTime origin, std::optional<double> recorded)
    : cell_(cell),
      origin_(origin),
      recorded_(recorded),
      line_(origin),
      pairs_(pairs_of(cell.cell)),
      observer_(cell.cell, kObserverStep, kSilence),
      commands_(line_),
      motions_(cell.cell),
      seen_(cell.cell.robots.size()),
      placed_(cell.cell.robots.size()),
      contacts_(observer_.pairs().size()) {
  near_ = measure(cell_.cell, pairs_, placed_);
}

bool LiveView::heard_lately(const Seen& seen) const {
  return seen.heard && now_ - *seen.heard <= kSilence;
}

void LiveView::on_command(const dds::CommandMessage& message) {
  if (const auto* command = std::get_if<model::CommandSubmitted>(&message.request)) commands_.on_request(*command);
}

void LiveView::use_planner(std::uint64_t incarnation, LocalTime received) {
  const double t = seconds_at(received);
  if (incarnation == incarnation_) {
    planner_heard_ = t;
    return;
  }
  if (planner_heard_ && t - *planner_heard_ < kPlannerSilence) return;  // two of them: the one in charge stays it
  incarnation_ = incarnation;
  planner_heard_ = t;
  planner_.reset();
  for (const CommandRecord* lost : commands_.on_planner(incarnation, t)) {
    drop_motion(lost->status.robot, lost->status.id, true);
    add_command(lost);
  }
}

void LiveView::on_state(const model::PlannerState& state, LocalTime received) {
  const bool other_cell = state.fingerprint != cell_.fingerprint;
  alarms_.set("planner", other_cell,
              {"other_cell", true, {}, "the planner works with another cell file than this page shows", seconds_at(received), {}});
  use_planner(state.incarnation, received);
  if (!other_cell && state.incarnation == incarnation_) planner_ = state;
}

void LiveView::on_status(const dds::StatusMessage& message, LocalTime received) {
  const model::CommandStatus& status = message.status;
  const CommandRecord* record = commands_.on_status(message.planner_incarnation, status, seconds_at(received));
  if (record == nullptr) return;
  note_status(status);
  // Orders come before news of them: what was dispatched is taken back by an order or is over, whatever older news still say.
  const bool undone = status.state == model::CommandState::queued || status.state == model::CommandState::waiting;
  const bool over = model::is_final(status.state) && status.state != model::CommandState::completed;
  if (undone || over) drop_motion(status.robot, status.id, over);
  if (status.state == model::CommandState::scheduled && record->start) {
    const model::MotionRequest* request = commands_.request(status.id);
    const auto robot = cell_.cell.find(status.robot);
    if (request != nullptr && robot && seen_[*robot].posture && !seen_[*robot].posture->moving) {
      add_motion(
          motions_.on_decision(status.id, status.robot, *request, seen_[*robot].posture->joints, seen_[*robot].held, *record->start));
    }
  }
  // What belongs to the same decision of the planner may still be on its way: the neighbours are looked at with the next advance().
  if (status.state == model::CommandState::waiting || status.state == model::CommandState::scheduled) judged_.push_back(status.id);
  add_command(commands_.find(status.id));
}

/// What a person should hear of a command.
void LiveView::note_status(const model::CommandStatus& status) {
  const std::string key = "deadlock " + status.id.str();
  const bool deadlock = status.reason == model::Reason::deadlock && !model::is_final(status.state);
  const std::string text = fmt::format("{} of {} cannot start, nobody in its way will move by itself, and no way out helps",
                                       status.id.str(), status.robot.str());
  alarms_.set(key, deadlock, {"deadlock", true, {status.robot.str()}, text, now_, {}});
  if (status.state == model::CommandState::failed) {
    alarms_.note({"controller_fault",
                  true,
                  {status.robot.str()},
                  fmt::format("{} of {} failed: {}", status.id.str(), status.robot.str(),
                              status.text.empty() ? model::to_string(status.reason) : status.text),
                  now_,
                  {}});
  }
}

void LiveView::on_dispatch(const dds::DispatchMessage& message, LocalTime received) {
  if (message.fingerprint != cell_.fingerprint) return;
  if (const auto* beat = std::get_if<dds::Heartbeat>(&message.order)) {
    (void)line_.place(message.planner_incarnation, beat->planner_sent, received);
    use_planner(message.planner_incarnation, received);
    return;
  }
  const auto zero = line_.zero_of(message.planner_incarnation);
  if (!zero) return;
  if (const auto* order = std::get_if<model::Dispatch>(&message.order)) {
    const double earliest = *zero + model::to_seconds(order->earliest), latest = *zero + model::to_seconds(order->latest);
    add_motion(motions_.on_dispatch(*order, earliest, latest));
    add_command(commands_.on_window(order->id, earliest, latest));
  } else if (const auto* withdrawal = std::get_if<model::Withdrawal>(&message.order)) {
    drop_motion(withdrawal->robot, withdrawal->id, true);
  }
}

void LiveView::on_execution(const dds::ExecutionMessage& message, LocalTime received) {
  const auto zero = line_.zero_of(message.planner_incarnation);
  const model::ExecutionReported& report = message.report;
  const double at = zero ? *zero + model::to_seconds(report.at) : seconds_at(received);
  if (!motions_.on_execution(report, at)) return;
  if (report.state >= model::ExecutionState::completed || report.state == model::ExecutionState::refused ||
      report.state == model::ExecutionState::withdrawn) {
    add_event("motion_over", {{"robot", report.robot.str()}, {"id", report.id.str()}});
  }
}

void LiveView::on_posture(const dds::PostureMessage& message, LocalTime received) {
  const auto robot = cell_.cell.find(message.posture.robot);
  if (!robot) return;
  Seen& seen = seen_[*robot];
  const double t = line_.place(message.planner_incarnation, message.posture.at, received);
  seen.stranger = message.fingerprint != cell_.fingerprint;
  if (seen.stranger) return;
  seen.heard = seconds_at(received);
  seen.posture = message.posture;
  seen.held = cell_.cell.set_of(message.posture.holds);
  observer_.on_posture(*robot, t, message.posture.joints, seen.held);
}

void LiveView::add_command(const CommandRecord* record) {
  if (record != nullptr) add_event("command", to_json(*record));
}

void LiveView::add_motion(const KnownMotion* motion) {
  if (motion != nullptr) add_event("motion", to_json(*motion));
}

void LiveView::drop_motion(const model::RobotName& robot, const model::CommandId& id, bool dispatched_too) {
  if (!motions_.forget(robot, id, dispatched_too)) return;
  add_event("motion_over", {{"robot", robot.str()}, {"id", id.str()}});
}

void LiveView::place_robots() {
  for (model::RobotIndex i = 0; i < seen_.size(); ++i) {
    const Seen& seen = seen_[i];
    if (!seen.posture) continue;
    const model::Robot& body = motions_.body(i, seen.held);
    if (placed_[i].robot != &body) {
      placed_[i].robot = &body;
      nlohmann::json json = bodies_json(body);
      json["robot"] = body.name.str();
      add_event("bodies", std::move(json));
    }
    model::place_capsules(body.model, body.X_WB, seen.posture->joints, placed_[i].bodies);
  }
  near_ = measure(cell_.cell, pairs_, placed_);
}

void LiveView::advance(LocalTime now) {
  now_ = seconds_at(now);
  note_judgements();
  place_robots();
  watch_alarms();
  if (now_ >= next_curve_) {
    curve_.push_back({now_, near_.pairs});
    if (curve_.size() > kCurvePoints) curve_.pop_front();
    next_curve_ = now_ + std::chrono::duration<double>(kCurvePeriod).count();
  }
  if (now_ >= next_state_) {
    add_event("state", state_json());
    next_state_ = now_ + std::chrono::duration<double>(kStatePeriod).count();
  }
  if (alarms_.take_changed()) add_event("alarms", {{"alarms", to_json(alarms_.all())}});
}

void LiveView::watch_alarms() {
  const bool silent = planner_heard_ ? now_ - *planner_heard_ > kPlannerSilence : now_ > kFirstWords;
  alarms_.set("planner silent", silent,
              {"planner_silent", true, {}, "the planner is not heard from: no new motion starts, those under way go on", now_, {}});
  for (model::RobotIndex i = 0; i < seen_.size(); ++i) {
    const std::string& name = cell_.cell.robots[i].name.str();
    const bool quiet = !heard_lately(seen_[i]) && (seen_[i].heard || now_ > kFirstWords);
    alarms_.set("silent " + name, quiet,
                {"proxy_silent", true, {name}, fmt::format("{} is not heard from: it could be anywhere in its reach", name), now_, {}});
    alarms_.set(
        "stranger " + name, seen_[i].stranger,
        {"other_cell", true, {name}, fmt::format("the proxy of {} works with another cell file than this page shows", name), now_, {}});
  }
  watch_contacts();
}

/// A contact is an alarm as long as it lasts, and stays in sight with what was seen of it; also one that was over before anybody looked.
void LiveView::watch_contacts() {
  const auto& robots = cell_.cell.robots;
  const auto tell = [&](const std::string& key, bool touching, bool is_new, Alarm alarm, const std::string& what_was) {
    if (touching) return alarms_.raise(key, std::move(alarm));
    const bool held = alarms_.holds(key);
    alarm.text = what_was;
    if (held) alarms_.raise(key, alarm);
    if (held) alarms_.end(key, now_);
    if (!held && is_new) alarms_.note(std::move(alarm));
  };
  for (std::size_t k = 0; k < contacts_.size(); ++k) {
    const PairClearance& pair = observer_.pairs()[k];
    const auto near = std::find(pairs_.begin(), pairs_.end(), std::make_pair(pair.a, pair.b));
    const double now = near == pairs_.end() ? kFar : near_.pairs[static_cast<std::size_t>(near - pairs_.begin())].value_or(kFar);
    const std::string a = robots[pair.a].name.str(), b = robots[pair.b].name.str();
    const bool is_new = std::exchange(contacts_[k], pair.contacts) != pair.contacts;
    tell(fmt::format("contact {} {}", a, b), now <= 0, is_new,
         {"contact", true, {a, b}, fmt::format("{} and {} touch each other", a, b), now_, {}},
         fmt::format("{} and {} touched; deepest so far {:.1f} mm, {}'s {} in {}'s {}", a, b, -1e3 * pair.least, a, pair.link_a, b,
                     pair.link_b));
  }
  const bool any_new = std::exchange(fixture_contacts_, observer_.fixtures().contacts()) != observer_.fixtures().contacts();
  const FixtureClearance* deepest = observer_.fixtures().least();
  for (model::RobotIndex i = 0; deepest != nullptr && i < robots.size(); ++i) {
    const std::string robot = robots[i].name.str();
    tell("fixture " + robot, near_.fixtures[i].value_or(kFar) <= 0, any_new && deepest->robot == i,
         {"contact", true, {robot}, robot + " touches a fixture", now_, {}},
         fmt::format("{} touched {}; deepest so far {:.1f} mm, its {}", robot, cell_.cell.fixtures[deepest->fixture].name,
                     -1e3 * deepest->least, deepest->link));
  }
}

}  // namespace interlace::monitor
