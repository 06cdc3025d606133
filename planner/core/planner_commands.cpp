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
  return a.state == b.state && a.reason == b.reason && a.start == b.start && a.end == b.end && a.text == b.text && a.verdict == b.verdict &&
         a.refusals.size() == b.refusals.size();
}

/// Nearer than controllers and rounding tell apart [rad], and far below what the maps add for rounding.
bool same_joints(const model::Joints& a, const model::Joints& b) {
  constexpr double kSame = 1e-9;
  return (a - b).cwiseAbs().maxCoeff() <= kSame;
}

}  // namespace

void Planner::publish(const CommandStatus& status, Decisions& out) {
  auto [entry, fresh] = known_.try_emplace(status.id, status);
  if (!fresh) {
    if (same_message(entry->second, status)) return;
    entry->second = status;
  }
  out.statuses.push_back(status);
  const bool as_expected = status.state == CommandState::waiting || status.state == CommandState::scheduled ||
                           status.state == CommandState::started || status.state == CommandState::completed;
  if (!as_expected && !status.escape) ahead_.event_ends.reset();
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
  // The first in the queue may need the way back from an escape; the others start where the one before them ends.
  model::Result<Admitted, model::MotionError> admitted;
  if (r.queue.empty()) {
    r.queue.push_back(command);
    auto chain = judge_queue(r);
    r.queue.pop_back();
    admitted = chain ? model::Result<Admitted, model::MotionError>{chain->front()} : model::unexpected(chain.error());
  } else {
    admitted = judge(r, r.joints_at_end(), r.tools_at_end(), event.motion);
  }
  if (!admitted) {
    reject(status, admitted.error().reason, admitted.error().text, out);
    return out;
  }
  ++accepted_;
  changed(r);
  if (!r.next() && !r.committed) r.ready_since = now;
  command.status.state = CommandState::queued;
  command.motion = std::move(admitted->motion);
  command.tools = admitted->tools;
  if (event.deadline) set_deadline(r, command, *event.deadline, now);
  publish(command.status, out);
  r.queue.push_back(std::move(command));
  if (ahead_.outlook) {
    ahead_.arrived = true;  // others may come at the same time: advance() decides for all of them
  } else {
    schedule(now, out);
  }
  return out;
}

/// `request` for the robot standing at `from` [rad] with `held` in its hand, or why it is impossible.
model::Result<Planner::Admitted, model::MotionError> Planner::judge(const RobotRecord& r, const model::Joints& from, model::ToolSet held,
                                                                    const model::MotionRequest& request) const {
  const auto steps = model::tool_steps(*cell_, r.robot->name, held, request.tools);
  if (!steps) {
    const Vector3 place = (r.robot->X_WB * model::tcp_pose(r.robot->model, from)).translation();
    return model::unexpected(model::MotionError{Reason::tool, 0, place, steps.error()});
  }
  auto motion = admit(*cell_, index_of(r), model::MotionBodies::of(*bodies_, index_of(r), *steps), from, request);
  if (!motion) return model::unexpected(motion.error());
  return Admitted{std::move(*motion), *steps};
}

/// The motions of the commands in the main queue, one after the other from `from` on [rad]; those that stay as they are included.
model::Result<Planner::AdmittedQueue, model::MotionError> Planner::chain_from(const RobotRecord& r, model::Joints from) const {
  AdmittedQueue chain;
  model::ToolSet held = r.tools_after_motion();
  for (const QueuedCommand& command : r.queue) {
    if (command.motion && same_joints(command.motion->motion().from(), from) && command.tools.before == held) {
      // From here on nothing changes.
      for (std::size_t i = chain.size(); i < r.queue.size(); ++i) chain.push_back({r.queue[i].motion, r.queue[i].tools});
      return chain;
    }
    auto next = judge(r, from, held, command.request);
    if (!next) return model::unexpected(next.error());
    from = next->motion->motion().to();
    held = next->tools.after;
    chain.push_back(std::move(*next));
  }
  return chain;
}

/// Judges the main queue from where the robot will be, as a whole. When an escape has left the robot where that is impossible, the way back
/// to where the queue was judged from goes into the escape queue first, as far as it takes.
model::Result<Planner::AdmittedQueue, model::MotionError> Planner::judge_queue(RobotRecord& r) {
  model::Joints from = r.joints_after_motion();
  auto direct = chain_from(r, from);
  if (direct || r.way_back.empty()) return direct;
  const model::ToolSet held = r.tools_after_motion();
  std::deque<QueuedCommand> way;
  for (auto back = r.way_back.rbegin(); back != r.way_back.rend(); ++back) {
    auto motion = admit(*cell_, index_of(r), bodies_->of(index_of(r), held), from, *back);
    if (!motion) return direct;
    from = (*motion)->motion().to();
    QueuedCommand escape;
    escape.origin = QueuedCommand::Origin::way_back;
    escape.status.id = model::CommandId{options_.escape_prefix + std::to_string(++last_escape_)};
    escape.status.robot = r.robot->name;
    escape.status.escape = true;
    escape.status.serves = r.queue.front().status.id;
    escape.status.reason = Reason::escape;
    escape.status.submitted = r.queue.front().status.submitted;
    escape.request = *back;
    escape.motion = std::move(*motion);
    escape.tools = {held, held, held};
    way.push_back(std::move(escape));
    if (auto chain = chain_from(r, from)) {
      r.escapes = std::move(way);
      return chain;
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
  changed(r);
  drop_escapes(r, out);
  if (const auto chain = judge_queue(r)) {
    for (std::size_t i = 0; i < r.queue.size(); ++i) {
      r.queue[i].motion = (*chain)[i].motion;
      r.queue[i].tools = (*chain)[i].tools;
    }
    return;
  }
  // Not all of it is possible any more: what is not is rejected.
  model::Joints from = r.joints_after_motion();
  model::ToolSet held = r.tools_after_motion();
  for (auto it = r.queue.begin(); it != r.queue.end();) {
    if (!same_joints(it->motion->motion().from(), from) || it->tools.before != held) {
      auto admitted = judge(r, from, held, it->request);
      if (!admitted) {
        const char* why = admitted.error().reason == Reason::tool ? "with what the robot holds" : "from where the robot is";
        reject(it->status, admitted.error().reason, fmt::format("no longer possible {} now: {}", why, admitted.error().text), out);
        it = r.queue.erase(it);
        continue;
      }
      it->motion = std::move(admitted->motion);
      it->tools = admitted->tools;
    }
    from = it->motion->motion().to();
    held = it->tools.after;
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
    if (relying_on(r, *r.following, true) != nullptr) return false;
    put_following_back(r, out);
    return cancel(r, id, out);
  }
  if (!r.committed || r.committed->command.status.id != id || r.committed->phase == Commitment::Phase::started) return false;
  if (relying_on(r, *r.committed, true) != nullptr) return false;
  if (r.committed->phase == Commitment::Phase::held) {
    const bool by_client = r.committed->command.origin == QueuedCommand::Origin::client;
    put_back(r, Reason::none, {}, out);
    return !by_client || cancel(r, id, out);
  }
  r.committed->cancel_requested = true;  // final once the proxy says it has not started
  out.withdrawals.push_back({id, r.robot->name, r.committed->command.attempts});
  return true;
}

/// Why a command that is not finished cannot be given up.
std::string Planner::why_not_cancelled(const RobotRecord& r, const CommandStatus& status) const {
  for (const auto* c : {&r.committed, &r.following}) {
    if (!*c || (*c)->command.status.id != status.id) continue;
    if (const RobotRecord* other = relying_on(r, **c, true))
      return fmt::format("{} is under way and relies on {} leaving: it cannot be given up any more", other->robot->name.str(),
                         r.robot->name.str());
  }
  return "it has started: a running motion cannot be taken back";
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
    if (!model::is_final(status.state)) status.text = why_not_cancelled(robots_[*index], status);
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
  RobotRecord* const asked = robot_asked(answer, out);
  if (!asked) return out;
  RobotRecord& r = *asked;
  // A departure that somebody under way relies on is not given up: the robot stops where that leads.
  const bool relied_on = is_relied_on(r, r.following);
  if (r.following && !relied_on) put_following_back(r, out);
  std::size_t given_up = r.queue.size();
  drop_escapes(r, out);
  while (!r.queue.empty()) cancel(r, model::CommandId{r.queue.back().status.id}, out);
  if (r.committed && r.committed->phase != Commitment::Phase::started && cancel(r, model::CommandId{r.committed->command.status.id}, out)) {
    ++given_up;
  }
  answer.state = CommandState::completed;
  answer.reason = Reason::on_request;
  answer.text = fmt::format("{} commands given up{}", given_up, r.committed ? "; the running motion ends where it was going" : "");
  publish(answer, out);
  schedule(now, out);
  return out;
}

}  // namespace interlace::core
