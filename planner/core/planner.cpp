#include "planner/core/planner.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <stdexcept>

#include "planner/core/admission.hpp"
#include "planner/core/explain.hpp"
#include "planner/core/reach.hpp"

namespace interlace::core {

using model::CommandState;
using model::CommandStatus;
using model::ExecutionState;
using model::Reason;
using model::RobotMode;

namespace {

/// Joints nearer than this to where a robot is thought to stand are the same place [rad].
constexpr double kSamePlace = 1e-4;

/// A dispatch that got no answer is given up this long after its window: the proxy never starts after it.
constexpr Duration kGrace = std::chrono::milliseconds{500};

/// Latest time a started motion can end.
Instant latest_end(const Commitment& c) {
  const model::Motion& motion = c.command.motion->motion();
  return c.start_until + model::from_seconds(motion.duration() * (1 + motion.robot().controller.speed_error));
}

void append(Decisions more, Decisions& out) {
  std::move(more.dispatches.begin(), more.dispatches.end(), std::back_inserter(out.dispatches));
  std::move(more.withdrawals.begin(), more.withdrawals.end(), std::back_inserter(out.withdrawals));
  std::move(more.statuses.begin(), more.statuses.end(), std::back_inserter(out.statuses));
}

/// Saying it again would tell nobody anything new.
bool same_message(const CommandStatus& a, const CommandStatus& b) {
  return a.state == b.state && a.reason == b.reason && a.start == b.start && a.end == b.end && a.text == b.text;
}

}  // namespace

Planner::Planner(std::shared_ptr<const model::Cell> cell, PlannerOptions options)
    : cell_(std::move(cell)),
      options_(std::move(options)),
      strategy_(make_strategy(options_.strategy)),
      maps_(cell_->planning.margin, options_.stopwatch) {
  if (!strategy_) throw std::invalid_argument(fmt::format("unknown strategy \"{}\"", options_.strategy));
  robots_.resize(cell_->robots.size());
  for (model::RobotIndex i = 0; i < robots_.size(); ++i) {
    const model::Robot& robot = cell_->robots[i];
    robots_[i].robot = &robot;
    robots_[i].standing = std::make_shared<SampledMotion>(model::Motion::rest(robot, robot.start), cell_->planning.resolution);
  }
}

// ---- commands

void Planner::publish(const CommandStatus& status, Decisions& out) {
  auto [entry, fresh] = known_.try_emplace(status.id, status);
  if (!fresh) {
    if (same_message(entry->second, status)) return;
    entry->second = status;
  }
  out.statuses.push_back(status);
  if (!model::is_final(status.state)) return;
  finished_.push_back(status.id);
  if (finished_.size() > options_.remembered) {
    known_.erase(finished_.front());
    finished_.pop_front();
  }
}

void Planner::reject(CommandStatus status, Reason reason, std::string text, Decisions& out) {
  status.state = CommandState::rejected;
  status.reason = reason;
  status.text = std::move(text);
  ++rejected_;
  publish(status, out);
}

model::Result<SampledMotionPtr, model::MotionError> Planner::admit(model::RobotIndex robot, const model::Joints& from,
                                                                   const model::MotionRequest& request) const {
  auto motion = model::plan_motion(cell_->robots[robot], from, request);
  if (!motion) return model::unexpected(motion.error());
  auto sampled = std::make_shared<SampledMotion>(std::move(*motion), cell_->planning.resolution);
  if (auto collision = path_collision(*sampled, *cell_, robot, cell_->planning.margin)) return model::unexpected(*collision);
  return sampled;
}

Decisions Planner::on(const model::CommandSubmitted& event, Instant now) {
  Decisions out;
  if (const auto known = known_.find(event.id); known != known_.end()) {
    out.statuses.push_back(known->second);  // said twice, answered twice, done once
    return out;
  }
  CommandStatus status;
  status.id = event.id;
  status.robot = event.robot;
  status.submitted = now;
  const auto index = cell_->find(event.robot);
  if (!index) {
    reject(status, Reason::bad_request, fmt::format("there is no robot \"{}\" in cell {}", event.robot.str(), cell_->name), out);
    return out;
  }
  RobotRecord& r = robots_[*index];
  if (r.queue.size() >= options_.queue_limit) {
    reject(status, Reason::queue_full, fmt::format("{} commands are waiting for {}; no more are taken", r.queue.size(), event.robot.str()),
           out);
    return out;
  }
  auto motion = admit(*index, r.joints_at_end(), event.motion);
  if (!motion) {
    reject(status, motion.error().reason, motion.error().text, out);
    return out;
  }
  ++accepted_;
  if (r.queue.empty() && !r.committed) r.ready_since = now;
  status.state = CommandState::queued;
  publish(status, out);
  r.queue.push_back({status, event.motion, event.priority, std::move(*motion), 0});
  schedule(now, out);
  return out;
}

void Planner::rejudge_queue(RobotRecord& r, Decisions& out) {
  model::Joints from = r.joints_before_queue();
  for (auto it = r.queue.begin(); it != r.queue.end();) {
    if ((it->motion->motion().from() - from).cwiseAbs().maxCoeff() > 0) {
      auto motion = admit(index_of(r), from, it->request);
      if (!motion) {
        reject(it->status, motion.error().reason, fmt::format("no longer possible from where the robot is now: {}", motion.error().text),
               out);
        it = r.queue.erase(it);
        continue;
      }
      it->motion = std::move(*motion);
    }
    from = it->motion->motion().to();
    ++it;
  }
}

bool Planner::cancel(RobotRecord& r, const model::CommandId& id, Decisions& out) {
  const auto queued = std::find_if(r.queue.begin(), r.queue.end(), [&](const QueuedCommand& c) { return c.status.id == id; });
  if (queued != r.queue.end()) {
    CommandStatus status = queued->status;
    status.state = CommandState::cancelled;
    status.reason = Reason::on_request;
    status.text.clear();
    status.conflicts.clear();
    r.queue.erase(queued);
    publish(status, out);
    return true;
  }
  if (!r.committed || r.committed->command.status.id != id || r.committed->phase == Commitment::Phase::started) return false;
  if (r.committed->phase == Commitment::Phase::held) {
    put_back(r, Reason::none, {}, out);
    return cancel(r, id, out);
  }
  r.committed->cancel_requested = true;  // final once the proxy says it has not started
  out.withdrawals.push_back({id, r.robot->name, r.committed->command.attempts});
  return true;
}

Decisions Planner::on(const model::CommandCancelled& event, Instant now) {
  Decisions out;
  const auto index = cell_->find(event.robot);
  const auto known = known_.find(event.id);
  if (!index || known == known_.end()) {
    CommandStatus status;
    status.id = event.id;
    status.robot = event.robot;
    status.submitted = now;
    status.state = CommandState::rejected;
    status.reason = Reason::unknown_id;
    status.text = "there is no such command to cancel";
    out.statuses.push_back(status);
    return out;
  }
  if (!cancel(robots_[*index], event.id, out)) {
    CommandStatus status = known->second;
    if (!model::is_final(status.state)) status.text = "it has started: a running motion cannot be taken back";
    out.statuses.push_back(status);
    return out;
  }
  rejudge_queue(robots_[*index], out);
  schedule(now, out);
  return out;
}

Decisions Planner::on(const model::StopRequested& event, Instant now) {
  Decisions out;
  CommandStatus answer;
  answer.id = event.id;
  answer.robot = event.robot;
  answer.submitted = now;
  if (const auto known = known_.find(event.id); known != known_.end()) {
    out.statuses.push_back(known->second);
    return out;
  }
  const auto index = cell_->find(event.robot);
  if (!index) {
    reject(answer, Reason::bad_request, fmt::format("there is no robot \"{}\" in cell {}", event.robot.str(), cell_->name), out);
    return out;
  }
  RobotRecord& r = robots_[*index];
  std::size_t given_up = r.queue.size();
  while (!r.queue.empty()) cancel(r, model::CommandId{r.queue.back().status.id}, out);
  if (r.committed && r.committed->phase != Commitment::Phase::started) {
    ++given_up;
    cancel(r, model::CommandId{r.committed->command.status.id}, out);
  }
  answer.state = CommandState::completed;
  answer.reason = Reason::on_request;
  answer.text = fmt::format("{} commands given up{}", given_up, r.committed ? "; the running motion ends where it was going" : "");
  publish(answer, out);
  schedule(now, out);
  return out;
}

// ---- robots

void Planner::stand_at(RobotRecord& r, const model::Joints& q, Instant now, Decisions& out) {
  if ((r.standing->motion().to() - q).cwiseAbs().maxCoeff() > 0) {
    r.standing = std::make_shared<SampledMotion>(model::Motion::rest(*r.robot, q), cell_->planning.resolution);
  }
  r.ready_since = now;
  rejudge_queue(r, out);
}

void Planner::put_back(RobotRecord& r, Reason why, const std::string& text, Decisions& out) {
  QueuedCommand command = std::move(r.committed->command);
  r.committed.reset();
  command.status.state = why == Reason::none ? CommandState::queued : CommandState::waiting;
  command.status.reason = why;
  command.status.text = text;
  command.status.start.reset();
  command.status.end.reset();
  command.status.conflicts.clear();
  if (why != Reason::none) publish(command.status, out);
  r.queue.push_front(std::move(command));
}

/// Takes back what was decided in the belief that `robot` would do what it promised, as far as it has not begun.
void Planner::revoke_dependents(model::RobotIndex robot, Decisions& out) {
  for (model::RobotIndex i = 0; i < robots_.size(); ++i) {
    RobotRecord& r = robots_[i];
    if (i == robot || !r.committed || r.committed->phase == Commitment::Phase::started) continue;
    const SampledMotionPtr theirs = robots_[robot].committed ? robots_[robot].committed->command.motion : robots_[robot].standing;
    const bool meets = robots_[robot].lost() ? enters_reach(*r.committed->command.motion, *robots_[robot].robot)
                                             : !maps_.get(r.committed->command.motion, theirs).blocked.empty();
    if (!meets) continue;
    if (r.committed->phase == Commitment::Phase::held) {
      put_back(r, Reason::none, {}, out);
    } else {
      out.withdrawals.push_back({r.committed->command.status.id, r.robot->name, r.committed->command.attempts});
    }
  }
}

Decisions Planner::on(const model::PostureReported& event, Instant now) {
  Decisions out;
  const auto index = cell_->find(event.robot);
  if (!index) return out;
  RobotRecord& r = robots_[*index];
  if (event.at < r.known_at) return out;  // overtaken by a report of something later
  r.known_at = std::min(event.at, now);
  if (!event.moving) r.stood = event;
  const bool was_lost = r.lost();
  const bool was_ready = r.ready;
  r.heard = true;
  r.last_heard = now;
  r.ready = event.ready;
  if (event.moving && r.committed && r.committed->phase == Commitment::Phase::dispatched &&
      r.committed->command.status.id == event.motion) {
    const Instant seen = event.at + model::from_seconds(event.uncertainty);
    begin(r, {r.committed->start_from, std::clamp(seen, r.committed->start_from, r.committed->start_until)}, out);
    r.foreign = false;
    schedule(now, out);
    return out;
  }
  const bool sent = r.committed && r.committed->phase != Commitment::Phase::held;
  const bool ours = r.committed && r.committed->phase == Commitment::Phase::started;
  r.foreign = event.moving && !ours;
  bool changed = was_lost != r.lost() || was_ready != r.ready;
  if (!event.moving && !sent && (event.joints - r.standing->motion().to()).cwiseAbs().maxCoeff() > kSamePlace) {
    if (r.committed) put_back(r, Reason::none, {}, out);
    stand_at(r, event.joints, now, out);
    revoke_dependents(*index, out);
    changed = true;
  }
  if (const auto outcome = unreported_outcome(r, now)) {
    append(on(*outcome, now), out);
    return out;
  }
  if (r.foreign && !was_lost) {
    if (sent) {
      out.withdrawals.push_back({r.committed->command.status.id, r.robot->name, r.committed->command.attempts});
    } else if (r.committed) {
      put_back(r, Reason::not_ready, fmt::format("{} moves although nobody told it to", r.robot->name.str()), out);
    }
    revoke_dependents(*index, out);
  }
  if (changed) schedule(now, out);
  return out;
}

void Planner::begin(RobotRecord& r, const StartInterval& start, Decisions& out) {
  Commitment& c = *r.committed;
  c.phase = Commitment::Phase::started;
  c.start_from = start.from;
  c.start_until = start.until;
  r.last_started = c.serial;
  CommandStatus& status = c.command.status;
  status.state = CommandState::started;
  status.start = start.from + (start.until - start.from) / 2;
  status.end = *status.start + model::from_seconds(c.command.motion->motion().duration());
  if (c.cancel_requested) status.text = "it had started when it was to be given up";
  publish(status, out);
}

/// What the proxy must have reported and nobody heard: the robot stands, long after it must have started or arrived.
std::optional<model::ExecutionReported> Planner::unreported_outcome(const RobotRecord& r, Instant now) {
  if (!r.committed || r.committed->phase == Commitment::Phase::held || r.lost() || !r.stood) return std::nullopt;
  const Commitment& c = *r.committed;
  const bool started = c.phase == Commitment::Phase::started;
  const Instant over = started ? latest_end(c) : c.start_until;
  if (now <= over + kGrace || r.stood->at <= over) return std::nullopt;
  const auto stands_at = [&](const model::Joints& q) { return (r.stood->joints - q).cwiseAbs().maxCoeff() <= kSamePlace; };
  model::ExecutionReported report;
  report.id = c.command.status.id;
  report.robot = r.robot->name;
  report.attempt = c.command.attempts;
  report.at = r.stood->at;
  report.joints = r.stood->joints;
  if (stands_at(c.command.motion->motion().to())) {
    report.state = ExecutionState::completed;
  } else if (!started && stands_at(c.command.motion->motion().from())) {
    report.state = ExecutionState::refused;
    report.text = "the start was not confirmed and the robot has not moved";
  } else {
    report.state = ExecutionState::failed;
    report.text = "the robot stands away from its target and nothing was reported";
  }
  return report;
}

Decisions Planner::on(const model::ExecutionReported& event, Instant now) {
  Decisions out;
  const auto index = cell_->find(event.robot);
  if (!index) return out;
  RobotRecord& r = robots_[*index];
  // A proxy never starts a command twice: asked again for one that it has started, it answers with the attempt that it carried out.
  const bool executed =
      event.state == ExecutionState::started || event.state == ExecutionState::completed || event.state == ExecutionState::failed;
  const bool ours = r.committed && r.committed->phase != Commitment::Phase::held && r.committed->command.status.id == event.id &&
                    (event.attempt == r.committed->command.attempts || (executed && event.attempt < r.committed->command.attempts));
  if (!ours) return out;  // of an older plan, or said twice
  Commitment& c = *r.committed;
  CommandStatus& status = c.command.status;
  const Duration uncertainty = model::from_seconds(event.uncertainty);

  switch (event.state) {
    case ExecutionState::accepted: c.accepted = true; return out;
    case ExecutionState::started:
      if (c.start_told) return out;
      c.start_told = true;
      r.known_at = std::max(r.known_at, std::min(event.at, now));
      begin(r, {event.at - uncertainty, event.at + uncertainty}, out);
      break;
    case ExecutionState::completed: {
      status.state = CommandState::completed;
      status.end = event.at;
      if (c.phase != Commitment::Phase::started) r.last_started = c.serial;
      publish(status, out);
      ++completed_;
      const model::Joints promised = c.command.motion->motion().to();
      const bool arrived = (event.joints - promised).cwiseAbs().maxCoeff() <= kSamePlace;
      r.known_at = std::max(r.known_at, std::min(event.at, now));
      r.committed.reset();
      stand_at(r, arrived ? promised : event.joints, now, out);
      if (!arrived) revoke_dependents(*index, out);
      break;
    }
    case ExecutionState::refused:
    case ExecutionState::withdrawn: {
      const bool cancelled = c.cancel_requested;
      const model::CommandId id = status.id;
      if (event.state == ExecutionState::refused) {
        put_back(r, Reason::refused_by_proxy, fmt::format("planned again, the proxy refused: {}", event.text), out);
      } else {
        put_back(r, Reason::none, {}, out);
      }
      r.ready_since = now;
      if (cancelled) {
        cancel(r, id, out);
        rejudge_queue(r, out);
      }
      revoke_dependents(*index, out);
      break;
    }
    case ExecutionState::failed:
      status.state = CommandState::failed;
      status.reason = Reason::controller_fault;
      status.text = event.text;
      status.end = event.at;
      publish(status, out);
      if (c.phase != Commitment::Phase::started) r.last_started = c.serial;
      revoke_dependents(*index, out);
      r.known_at = std::max(r.known_at, std::min(event.at, now));
      r.committed.reset();
      stand_at(r, event.joints, now, out);
      revoke_dependents(*index, out);
      break;
  }
  schedule(now, out);
  return out;
}

void Planner::notice_silence(Instant now, Decisions& out) {
  for (RobotRecord& r : robots_) {
    if (options_.posture_timeout && r.heard && now - r.last_heard > *options_.posture_timeout) {
      r.heard = false;
      revoke_dependents(index_of(r), out);
    }
    if (const auto outcome = unreported_outcome(r, now)) append(on(*outcome, now), out);
  }
}

// ---- scheduling

Decisions Planner::advance(Instant now) {
  Decisions out;
  notice_silence(now, out);
  schedule(now, out);
  return out;
}

void Planner::schedule(Instant now, Decisions& out) {
  send_due(now, out);
  for (bool progress = true; progress;) {
    progress = false;
    std::vector<RobotRecord*> candidates;
    for (RobotRecord& r : robots_) {
      if (!r.committed && !r.queue.empty()) candidates.push_back(&r);
    }
    std::stable_sort(candidates.begin(), candidates.end(), [](const auto* a, const auto* b) { return a->ready_since < b->ready_since; });
    for (RobotRecord* r : candidates) {
      if (try_commit(*r, now, out)) {
        progress = true;  // a robot that leaves may open the way for one that could not start
        break;
      }
    }
  }
  send_due(now, out);
}

bool Planner::try_commit(RobotRecord& r, Instant now, Decisions& out) {
  QueuedCommand& head = r.queue.front();
  if (r.lost() || !r.ready) {
    head.status.state = CommandState::waiting;
    head.status.reason = Reason::not_ready;
    head.status.text = r.foreign ? fmt::format("{} moves although nobody told it to", r.robot->name.str())
                       : r.heard ? fmt::format("{} is not ready to take a start window", r.robot->name.str())
                                 : fmt::format("{} is not heard from", r.robot->name.str());
    head.status.conflicts.clear();
    publish(head.status, out);
    return false;
  }
  const Candidate candidate{index_of(r), head.motion, options_.start_tolerance + model::from_seconds(r.robot->controller.latest_start())};
  std::vector<Neighbour> neighbours;
  for (RobotRecord& other : robots_) {
    if (&other != &r) neighbours.push_back(other.as_neighbour(index_of(other), now));
  }
  const Timing timing{now + options_.lead, options_.confirm};
  Assessment a = strategy_->assess(candidate, neighbours, timing, maps_);
  const double delay = a.start ? model::to_seconds(*a.start - (r.ready_since + options_.lead)) : 0;
  if (a.start && a.conflicts.empty() && delay > 0 && !head.status.conflicts.empty()) {
    // It goes at once now, but it stood waiting before: what kept it is the evidence of its delay.
    a.conflicts = head.status.conflicts;
    for (model::Conflict& c : a.conflicts) c.until = std::min(c.until, *a.start);
    a.reason = Reason::delayed;
  }
  head.status.reason = a.reason;
  head.status.conflicts = a.conflicts;
  if (!a.start) {
    head.status.state = CommandState::waiting;
    head.status.text = sentence(r.robot->name, a, 0);
    publish(head.status, out);
    return false;
  }
  Commitment c;
  c.command = std::move(head);
  r.queue.pop_front();
  c.serial = ++r.last_serial;
  c.start_from = *a.start;
  c.start_until = *a.start + candidate.tolerance;
  for (const model::RobotIndex other : a.departures) c.departures.emplace_back(other, robots_[other].committed->serial);
  CommandStatus& status = c.command.status;
  status.state = CommandState::scheduled;
  status.start = c.start_from;
  status.end = c.start_from + model::from_seconds(c.command.motion->motion().duration());
  status.delay = delay;
  status.text = sentence(r.robot->name, a, status.delay);
  publish(status, out);
  r.committed = std::move(c);
  return true;
}

Planner::Departures Planner::departures_of(const Commitment& c) const {
  Departures result = Departures::met;
  for (const auto& [robot, serial] : c.departures) {
    const RobotRecord& other = robots_[robot];
    if (other.last_started >= serial) continue;
    if (!other.committed || other.committed->serial != serial) return Departures::broken;
    result = Departures::open;
  }
  return result;
}

void Planner::send_due(Instant now, Decisions& out) {
  for (RobotRecord& r : robots_) {
    if (!r.committed) continue;
    Commitment& c = *r.committed;
    if (c.phase == Commitment::Phase::dispatched && !c.accepted && now >= c.sent + options_.answer_timeout && now <= c.start_until) {
      dispatch(r, now, out);  // unanswered: say it again, the proxy executes it once
      continue;
    }
    if (c.phase != Commitment::Phase::held) continue;
    const Departures departures = departures_of(c);
    const bool too_late = now > c.start_from;
    if (departures == Departures::broken || too_late || r.lost() || !r.ready) {
      put_back(r, Reason::none, {}, out);  // what its window was proven for no longer holds
    } else if (now >= c.start_from - options_.lead && departures == Departures::met) {
      ++c.command.attempts;
      c.phase = Commitment::Phase::dispatched;
      dispatch(r, now, out);
    }
  }
}

void Planner::dispatch(RobotRecord& r, Instant now, Decisions& out) {
  Commitment& c = *r.committed;
  c.sent = now;
  model::Dispatch d;
  d.id = c.command.status.id;
  d.robot = r.robot->name;
  d.attempt = c.command.attempts;
  d.motion = c.command.request;
  d.from = c.command.motion->motion().from();
  d.earliest = c.start_from;
  d.latest = c.start_until;
  d.duration = c.command.motion->motion().duration();
  out.dispatches.push_back(std::move(d));
}

std::optional<Instant> Planner::next_deadline() const {
  std::optional<Instant> next;
  const auto consider = [&](Instant t) { next = next ? std::min(*next, t) : t; };
  for (const RobotRecord& r : robots_) {
    if (options_.posture_timeout && r.heard) consider(r.last_heard + *options_.posture_timeout + Duration{1});
    if (!r.committed) continue;
    const Commitment& c = *r.committed;
    if (c.phase == Commitment::Phase::held) {
      consider(departures_of(c) == Departures::met ? c.start_from - options_.lead : c.start_from + Duration{1});
    } else if (c.phase == Commitment::Phase::dispatched) {
      if (!c.accepted && c.sent + options_.answer_timeout <= c.start_until) consider(c.sent + options_.answer_timeout);
      if (!r.lost() && r.stood && r.stood->at > c.start_until) consider(c.start_until + kGrace + Duration{1});
    }
  }
  return next;
}

model::PlannerState Planner::state(Instant now) const {
  model::PlannerState s;
  s.cell = cell_->name;
  s.at = now;
  s.strategy = strategy_->name();
  s.accepted = accepted_;
  s.rejected = rejected_;
  s.completed = completed_;
  for (const RobotRecord& r : robots_) {
    model::RobotStatus status;
    status.name = r.robot->name;
    status.queued = static_cast<std::uint32_t>(r.queue.size());
    const CommandStatus* current = r.committed ? &r.committed->command.status : r.queue.empty() ? nullptr : &r.queue.front().status;
    if (current) {
      status.current = current->id;
      status.reason = current->reason;
      status.text = current->text;
      status.conflicts = current->conflicts;
    }
    status.mode = r.lost()                                                          ? RobotMode::unknown
                  : r.committed && r.committed->phase == Commitment::Phase::started ? RobotMode::moving
                  : current                                                         ? RobotMode::commanded
                                                                                    : RobotMode::standby;
    s.robots.push_back(std::move(status));
  }
  return s;
}

}  // namespace interlace::core
