// What clients ask of a robot beside commands: hold it, resume it, replace its queue. Decisions: docs/adr/0007-priorities-and-control.md.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "planner/core/planner.hpp"

namespace interlace::core {

using model::CommandState;
using model::CommandStatus;
using model::Reason;

namespace {

CommandStatus answer_to(const model::CommandId& id, const model::RobotName& robot, Instant now) {
  CommandStatus answer;
  answer.id = id;
  answer.robot = robot;
  answer.submitted = now;
  answer.state = CommandState::completed;
  answer.reason = Reason::on_request;
  return answer;
}

/// "1 command", "3 commands".
std::string commands_text(std::size_t n) {
  return fmt::format("{} command{}", n, n == 1 ? "" : "s");
}

/// "1 command waits", "3 commands wait".
std::string waiting_text(std::size_t n) {
  return fmt::format("{} wait{}", commands_text(n), n == 1 ? "s" : "");
}

std::string held_text(const RobotRecord& r) {
  return fmt::format("{} is held: it starts nothing until it is resumed", r.robot->name.str());
}

}  // namespace

/// The robot that a request is for; null when the request is answered already: known, or for no robot of the cell.
RobotRecord* Planner::robot_asked(const CommandStatus& answer, Decisions& out) {
  if (const auto known = known_.find(answer.id); known != known_.end()) {
    out.statuses.push_back(known->second);
    return nullptr;
  }
  if (const auto index = cell_->find(answer.robot)) return &robots_[*index];
  reject(answer, Reason::bad_request, fmt::format("there is no robot \"{}\" in cell {}", answer.robot.str(), cell_->name), out);
  return nullptr;
}

/// Nothing of what was assessed in vain holds any more.
void Planner::scene_is_new() {
  for (RobotRecord& r : robots_) r.in_vain = {};
}

/// Takes back all that `r` has not begun. What the proxy was told already may begin before it hears of that, and is then finished. So is a
/// departure that a robot under way relies on: that promise is kept first.
void Planner::hold(RobotRecord& r, Decisions& out) {
  r.held = true;
  changed(r);
  if (r.following && !is_relied_on(r, r.following)) put_following_back(r, out);
  const bool not_begun = r.committed && !is_relied_on(r, r.committed);
  if (not_begun && r.committed->phase == Commitment::Phase::held) {
    put_back(r, Reason::held, held_text(r), out);
  } else if (not_begun && r.committed->phase == Commitment::Phase::dispatched) {
    out.withdrawals.push_back({r.committed->command.status.id, r.robot->name, r.committed->command.attempts});
  }
  r.blockers.clear();
  r.gives_way = false;
  scene_is_new();
}

Decisions Planner::on(const model::HoldRequested& event, Instant now) {
  Decisions out;
  CommandStatus answer = answer_to(event.id, event.robot, now);
  RobotRecord* const asked = robot_asked(answer, out);
  if (!asked) return out;
  RobotRecord& r = *asked;
  const bool was_held = r.held;
  hold(r, out);
  answer.text = fmt::format("{}{}; {}", was_held ? "it was held already" : "held", r.committed ? "; what it has begun it ends" : "",
                            waiting_text(r.queue.size()));
  publish(answer, out);
  schedule(now, out);
  return out;
}

Decisions Planner::on(const model::ResumeRequested& event, Instant now) {
  Decisions out;
  CommandStatus answer = answer_to(event.id, event.robot, now);
  RobotRecord* const asked = robot_asked(answer, out);
  if (!asked) return out;
  RobotRecord& r = *asked;
  answer.text = fmt::format("{}; {}", r.held ? "resumed" : "it was not held", waiting_text(r.queue.size()));
  if (r.held) {
    r.held = false;
    changed(r);
    scene_is_new();
    if (!r.committed) r.ready_since = now;  // it was its own hold that it waited for, and nobody is to make up for that
    if (QueuedCommand* next = r.next(); next && next->status.reason == Reason::held) {
      next->status.state = CommandState::queued;
      next->status.reason = Reason::none;
      next->status.text.clear();
    }
  }
  publish(answer, out);
  schedule(now, out);
  return out;
}

/// Says of the commands of held robots what they wait for.
void Planner::tell_held(Decisions& out) {
  for (RobotRecord& r : robots_) {
    if (!r.held || r.committed || !r.next()) continue;
    CommandStatus& status = r.next()->status;
    status.state = CommandState::waiting;
    status.reason = Reason::held;
    status.text = held_text(r);
    status.conflicts.clear();
    status.refusals.clear();
    publish(status, out);
  }
}

/// "r2, which is held", for those of `blockers` that are and stand; empty when none is.
std::string Planner::held_in_the_way(const std::vector<model::RobotIndex>& blockers) const {
  std::string text;
  for (const model::RobotIndex b : blockers) {
    const RobotRecord& r = robots_[b];
    if (r.held && !r.committed) text += fmt::format("{}{}, which is held", text.empty() ? "" : "; ", r.robot->name.str());
  }
  return text;
}

/// What is wrong with a replacement before any of its motions is looked at.
std::optional<std::pair<Reason, std::string>> Planner::why_not_replaced(const RobotRecord& r, const model::QueueReplaced& event) const {
  if (event.commands.size() > options_.queue_limit) {
    return std::pair{Reason::queue_full,
                     fmt::format("{} are more than the {} that may wait", commands_text(event.commands.size()), options_.queue_limit)};
  }
  std::set<model::CommandId> ids{event.id};
  for (const model::CommandSubmitted& c : event.commands) {
    if (c.robot != r.robot->name) {
      return std::pair{Reason::bad_request, fmt::format("{} is for {}, not for {}", c.id.str(), c.robot.str(), r.robot->name.str())};
    }
    if (!ids.insert(c.id).second || known_.find(c.id) != known_.end()) {
      return std::pair{Reason::bad_request, fmt::format("the id {} was used before", c.id.str())};
    }
  }
  return std::nullopt;
}

Decisions Planner::on(const model::QueueReplaced& event, Instant now) {
  Decisions out;
  if (const auto known = known_.find(event.id); known != known_.end()) {
    out.statuses.push_back(known->second);
    return out;
  }
  CommandStatus answer = answer_to(event.id, event.robot, now);
  const auto refuse = [&](Reason reason, const std::string& why) {
    for (const model::CommandSubmitted& c : event.commands) {
      if (known_.find(c.id) != known_.end() || c.id == event.id) continue;
      CommandStatus status = answer_to(c.id, event.robot, now);
      reject(status, reason, fmt::format("the replacement {} was refused as a whole: {}", event.id.str(), why), out);
    }
    reject(answer, reason, why + "; the queue stays as it was", out);
  };
  const auto index = cell_->find(event.robot);
  if (!index) {
    refuse(Reason::bad_request, fmt::format("there is no robot \"{}\" in cell {}", event.robot.str(), cell_->name));
    return out;
  }
  RobotRecord& r = robots_[*index];
  if (const auto why = why_not_replaced(r, event)) {
    refuse(why->first, why->second);
    return out;
  }
  // What is decided but not told to anybody is part of the queue; what was told counts as being done.
  if (r.following && !is_relied_on(r, r.following)) put_following_back(r, out);
  if (r.committed && r.committed->phase == Commitment::Phase::held && !is_relied_on(r, r.committed)) put_back(r, Reason::none, {}, out);
  std::deque<QueuedCommand> commands;
  for (const model::CommandSubmitted& c : event.commands) {
    QueuedCommand& command = commands.emplace_back();
    command.status.id = c.id;
    command.status.robot = c.robot;
    command.status.submitted = now;
    command.request = c.motion;
    command.priority = c.priority;
  }
  std::deque<QueuedCommand> old = std::exchange(r.queue, std::move(commands));
  std::deque<QueuedCommand> ways_back = std::exchange(r.escapes, {});
  auto chain = judge_queue(r);
  if (!chain) {
    const std::string where = first_impossible(r);
    r.queue = std::move(old);
    r.escapes = std::move(ways_back);
    refuse(chain.error().reason, where + chain.error().text);
    schedule(now, out);
    return out;
  }
  std::swap(r.escapes, ways_back);
  drop_escapes(r, out);
  r.escapes = std::move(ways_back);
  for (QueuedCommand& gone : old) {
    CommandStatus status = gone.status;
    status.state = CommandState::cancelled;
    status.reason = Reason::replaced;
    status.text = fmt::format("replaced by {}", event.id.str());
    status.conflicts.clear();
    status.refusals.clear();
    publish(status, out);
  }
  fill_queue(r, event, std::move(*chain), now, out);
  changed(r);
  r.blockers.clear();
  r.in_vain = {};
  if (!r.committed) r.ready_since = now;
  answer.text = fmt::format("{} replaced by {}", commands_text(old.size()), commands_text(event.commands.size()));
  publish(answer, out);
  schedule(now, out);
  return out;
}

/// The commands of `event`, which are in the main queue as they were asked for, as they are admitted.
void Planner::fill_queue(RobotRecord& r, const model::QueueReplaced& event, AdmittedQueue chain, Instant now, Decisions& out) {
  // One after the other: the deadline of each counts with what waits before it.
  std::deque<QueuedCommand> admitted = std::exchange(r.queue, {});
  for (std::size_t i = 0; i < admitted.size(); ++i) {
    QueuedCommand& command = admitted[i];
    command.motion = std::move(chain[i].motion);
    command.tools = chain[i].tools;
    if (event.commands[i].deadline) set_deadline(r, command, *event.commands[i].deadline, now);
    ++accepted_;
    publish(command.status, out);
    r.queue.push_back(std::move(command));
  }
}

/// Which of the commands in the main queue cannot be carried out after those before it: "command 2 of 3 (id): ".
std::string Planner::first_impossible(const RobotRecord& r) const {
  model::Joints from = r.joints_after_motion();
  model::ToolSet held = r.tools_after_motion();
  for (std::size_t i = 0; i < r.queue.size(); ++i) {
    const auto admitted = judge(r, from, held, r.queue[i].request);
    if (!admitted) return fmt::format("command {} of {} ({}): ", i + 1, r.queue.size(), r.queue[i].status.id.str());
    from = admitted->motion->motion().to();
    held = admitted->tools.after;
  }
  return {};
}

}  // namespace interlace::core
