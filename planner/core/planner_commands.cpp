// What clients ask of the planner: submit, cancel, stop, and the queues they fill.
#include <fmt/format.h>

#include <algorithm>

#include "planner/core/admission.hpp"
#include "planner/core/planner.hpp"

namespace interlace::core {

using model::CommandState;
using model::CommandStatus;
using model::Reason;

namespace {

/// Saying it again would tell nobody anything new.
bool same_message(const CommandStatus& a, const CommandStatus& b) {
  return a.state == b.state && a.reason == b.reason && a.start == b.start && a.end == b.end && a.text == b.text;
}

}  // namespace

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
  QueuedCommand command;
  command.status = status;
  command.request = event.motion;
  command.priority = event.priority;
  auto motion = r.queue.empty() ? admit_next(r, command) : admit(*cell_, *index, r.joints_at_end(), event.motion);
  if (!motion) {
    reject(status, motion.error().reason, motion.error().text, out);
    return out;
  }
  ++accepted_;
  ++revision_;
  if (!r.next() && !r.committed) r.ready_since = now;
  command.status.state = CommandState::queued;
  publish(command.status, out);
  command.motion = std::move(*motion);
  r.queue.push_back(std::move(command));
  schedule(now, out);
  return out;
}

/// The motion of the command at the front of the main queue. When an escape has left the robot where the command is impossible, the way
/// back to where it was judged from goes into the escape queue first.
model::Result<SampledMotionPtr, model::MotionError> Planner::admit_next(RobotRecord& r, const QueuedCommand& command) {
  model::Joints from = r.joints_after_motion();
  auto direct = admit(*cell_, index_of(r), from, command.request);
  if (direct || r.way_back.empty()) return direct;
  std::deque<QueuedCommand> way;
  for (auto back = r.way_back.rbegin(); back != r.way_back.rend(); ++back) {
    auto motion = admit(*cell_, index_of(r), from, *back);
    if (!motion) return direct;
    from = (*motion)->motion().to();
    QueuedCommand escape;
    escape.origin = QueuedCommand::Origin::way_back;
    escape.status.id = model::CommandId{options_.escape_prefix + std::to_string(++last_escape_)};
    escape.status.robot = r.robot->name;
    escape.status.escape = true;
    escape.status.serves = command.status.id;
    escape.status.reason = Reason::escape;
    escape.status.submitted = command.status.submitted;
    escape.request = *back;
    escape.motion = std::move(*motion);
    way.push_back(std::move(escape));
    if (auto motion_from_there = admit(*cell_, index_of(r), from, command.request)) {
      r.escapes = std::move(way);
      return motion_from_there;
    }
  }
  return direct;
}

/// Gives up what stands in the escape queue.
void Planner::drop_escapes(RobotRecord& r, Decisions& out) {
  for (QueuedCommand& escape : r.escapes) {
    if (known_.find(escape.status.id) == known_.end()) continue;  // nobody has heard of it
    escape.status.state = CommandState::cancelled;
    escape.status.text = "no longer needed";
    publish(escape.status, out);
  }
  r.escapes.clear();
}

/// Judges the queues again from where the robot will be.
void Planner::rejudge_queue(RobotRecord& r, Decisions& out) {
  ++revision_;
  drop_escapes(r, out);
  model::Joints from = r.joints_after_motion();
  for (auto it = r.queue.begin(); it != r.queue.end();) {
    if ((it->motion->motion().from() - from).cwiseAbs().maxCoeff() > 0) {
      auto motion = it == r.queue.begin() ? admit_next(r, *it) : admit(*cell_, index_of(r), from, it->request);
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
  if (r.following && r.following->command.status.id == id) {
    put_following_back(r);
    return cancel(r, id, out);
  }
  if (!r.committed || r.committed->command.status.id != id || r.committed->phase == Commitment::Phase::started) return false;
  if (r.committed->phase == Commitment::Phase::held) {
    const bool by_client = r.committed->command.origin == QueuedCommand::Origin::client;
    put_back(r, Reason::none, {}, out);
    return !by_client || cancel(r, id, out);
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
  if (known->second.escape) {
    CommandStatus status = known->second;
    if (!model::is_final(status.state))
      status.text = fmt::format("an escape is the planner's own: cancel {}, which it serves", status.serves.str());
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
  if (r.following) put_following_back(r);
  std::size_t given_up = r.queue.size();
  drop_escapes(r, out);
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

}  // namespace interlace::core
