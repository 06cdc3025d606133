// What the robots' proxies report, and what it takes back when a robot does not do what it promised.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "planner/core/planner.hpp"
#include "planner/core/reach.hpp"

namespace interlace::core {

using model::CommandState;
using model::CommandStatus;
using model::DeadlineVerdict;
using model::ExecutionState;
using model::Reason;

namespace {

/// Joints nearer than this to where a robot is thought to stand are the same place [rad].
constexpr double kSamePlace = 1e-4;

/// Places a robot came from that are remembered for a retreat.
constexpr std::size_t kTrail = 3;

/// A robot is seen moving from this long after the start of its motion until this long before its end.
constexpr Duration kUnderWay = std::chrono::milliseconds{200};

/// Latest time a started motion can end.
Instant latest_end(const Commitment& c) {
  const model::Motion& motion = c.command.motion->motion();
  return c.start_until + model::from_seconds(motion.duration() * (1 + motion.robot().controller.speed_error));
}

/// Earliest time a started motion can end.
Instant earliest_end(const Commitment& c) {
  const model::Motion& motion = c.command.motion->motion();
  return c.start_from + model::from_seconds(motion.duration() * (1 - motion.robot().controller.speed_error));
}

/// It was slowed down for a start that it will not have.
void at_full_speed(QueuedCommand& command) {
  if (!command.full_speed) return;
  command.request = command.full_speed->first;
  command.motion = command.full_speed->second;
  command.full_speed.reset();
}

void append(Decisions more, Decisions& out) {
  std::move(more.dispatches.begin(), more.dispatches.end(), std::back_inserter(out.dispatches));
  std::move(more.withdrawals.begin(), more.withdrawals.end(), std::back_inserter(out.withdrawals));
  std::move(more.statuses.begin(), more.statuses.end(), std::back_inserter(out.statuses));
}

}  // namespace

void Planner::stand_at(RobotRecord& r, const model::Joints& q, Instant now, Decisions& out, bool escaped) {
  if ((r.standing->motion().to() - q).cwiseAbs().maxCoeff() > 0 || r.standing->robot().tools != r.tools) {
    const model::Robot& body = bodies_->of(index_of(r), r.tools);
    r.standing = std::make_shared<SampledMotion>(model::Motion::rest(body, q), cell_->planning.resolution);
  }
  // A robot that was only sent out of the way keeps its place among those that wait.
  if (!escaped || r.queue.empty()) r.ready_since = now;
  rejudge_queue(r, out);
}

/// What was to follow waits again: it was decided for a place the robot may not come to.
void Planner::put_following_back(RobotRecord& r, Decisions& out) {
  QueuedCommand command = std::move(r.following->command);
  r.following.reset();
  put_in_queue_again(r, std::move(command), Reason::none, {}, out);
}

void Planner::put_back(RobotRecord& r, Reason why, const std::string& text, Decisions& out) {
  if (r.following) put_following_back(r, out);
  QueuedCommand command = std::move(r.committed->command);
  r.committed.reset();
  put_in_queue_again(r, std::move(command), why, text, out);
}

/// A command that was decided and will not start as that. An escape is given up: what it made room for is planned anew, and may need
/// another one or none.
void Planner::put_in_queue_again(RobotRecord& r, QueuedCommand command, Reason why, const std::string& text, Decisions& out) {
  at_full_speed(command);
  command.status.start.reset();
  command.status.end.reset();
  command.status.conflicts.clear();
  changed(r);
  if (command.origin == QueuedCommand::Origin::escape) {
    command.status.state = CommandState::cancelled;
    command.status.text = why == Reason::none ? "no longer needed" : text;
    publish(command.status, out);
    if (!r.way_back.empty()) r.way_back.pop_back();
    rejudge_queue(r, out);
    return;
  }
  command.status.state = why == Reason::none ? CommandState::queued : CommandState::waiting;
  command.status.reason = why;
  command.status.text = text;
  if (why != Reason::none) publish(command.status, out);
  (command.origin == QueuedCommand::Origin::way_back ? r.escapes : r.queue).push_front(std::move(command));
}

/// Takes back what was decided in the belief that `robot` would do what it promised, as far as it has not begun.
void Planner::revoke_dependents(model::RobotIndex robot, Decisions& out) {
  for (model::RobotIndex i = 0; i < robots_.size(); ++i) {
    RobotRecord& r = robots_[i];
    if (!r.committed || !neighbourhood_.meet(i, robot)) continue;
    if (r.following) put_following_back(r, out);
    if (r.committed->phase == Commitment::Phase::started) continue;
    const SampledMotionPtr theirs = robots_[robot].committed ? robots_[robot].committed->command.motion : robots_[robot].standing;
    const bool meets = robots_[robot].lost() ? enters_reach(*r.committed->command.motion, robots_[robot].reach)
                                             : !maps_.get(r.committed->command.motion, theirs).map.blocked.empty();
    if (!meets) continue;
    if (r.committed->phase == Commitment::Phase::held) {
      put_back(r, Reason::none, {}, out);
      continue;
    }
    const model::CommandId& id = r.committed->command.status.id;
    const bool said = std::any_of(out.withdrawals.begin(), out.withdrawals.end(), [&](const auto& w) { return w.id == id; });
    if (!said) out.withdrawals.push_back({id, r.robot->name, r.committed->command.attempts});
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
  const bool sent = r.committed && r.committed->phase != Commitment::Phase::held;
  const model::ToolSet held = cell_->set_of(event.holds);
  // With something in its hand that it was not to hold, nothing that was proven of its motion is true.
  const bool with_more = sent && !(event.moving ? r.committed->command.tools.during : r.committed->command.tools.all()).covers(held);
  if (event.moving && sent && !with_more && r.committed->phase == Commitment::Phase::dispatched &&
      r.committed->command.status.id == event.motion) {
    const Instant seen = event.at + model::from_seconds(event.uncertainty);
    begin(r, {r.committed->start_from, std::clamp(seen, r.committed->start_from, r.committed->start_until)}, out);
    r.foreign = false;
    schedule(now, out);
    return out;
  }
  const bool ours = r.committed && r.committed->phase == Commitment::Phase::started;
  r.foreign = (event.moving && !ours) || with_more;
  const bool newly = was_lost != r.lost() || was_ready != r.ready;
  if (newly) changed(r);
  bool moved = false;
  const bool elsewhere = (event.joints - r.standing->motion().to()).cwiseAbs().maxCoeff() > kSamePlace;
  if (!event.moving && !sent && (elsewhere || held != r.tools)) {
    if (r.committed) put_back(r, Reason::none, {}, out);
    r.way_back.clear();
    r.trail.clear();
    r.tools = held;
    stand_at(r, event.joints, now, out);
    revoke_dependents(*index, out);
    moved = true;
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
  if (newly || moved) schedule(now, out);
  return out;
}

void Planner::begin(RobotRecord& r, const StartInterval& start, Decisions& out) {
  Commitment& c = *r.committed;
  c.phase = Commitment::Phase::started;
  c.endangered = false;  // it is now, and people have not been told
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

/// What the proxy must have reported and nobody heard: the robot stands, long after it must have started or arrived, or in the middle of
/// its motion, as when its proxy or controller was restarted.
std::optional<model::ExecutionReported> Planner::unreported_outcome(const RobotRecord& r, Instant now) {
  if (!r.committed || r.committed->phase == Commitment::Phase::held || r.lost() || !r.stood) return std::nullopt;
  const Commitment& c = *r.committed;
  const bool started = c.phase == Commitment::Phase::started;
  const Instant over = started ? latest_end(c) : c.start_until;
  const bool silent = now > over + kGrace && r.stood->at > over;
  const bool stopped_short =
      started && r.stood->at >= r.known_at && r.stood->at > c.start_until + kUnderWay && r.stood->at < earliest_end(c) - kUnderWay;
  if (!silent && !stopped_short) return std::nullopt;
  const auto stands_at = [&](const model::Joints& q) { return (r.stood->joints - q).cwiseAbs().maxCoeff() <= kSamePlace; };
  model::ExecutionReported report;
  report.id = c.command.status.id;
  report.robot = r.robot->name;
  report.attempt = c.command.attempts;
  report.at = r.stood->at;
  report.joints = r.stood->joints;
  report.holds = r.stood->holds;
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
    case ExecutionState::accepted:
      c.accepted = true;
      if (relying_on(r, c, false) != nullptr) schedule(now, out);
      return out;
    case ExecutionState::started:
      if (c.start_told) return out;
      c.start_told = true;
      r.known_at = std::max(r.known_at, std::min(event.at, now));
      begin(r, {event.at - uncertainty, event.at + uncertainty}, out);
      break;
    case ExecutionState::completed: {
      status.state = CommandState::completed;
      status.end = event.at;
      if (status.deadline && event.at <= *status.deadline) {
        status.verdict = DeadlineVerdict::met;  // also when its report came after it had been called late
      } else if (status.verdict == DeadlineVerdict::open) {
        status.verdict = DeadlineVerdict::late;
      }
      if (c.phase != Commitment::Phase::started) r.last_started = c.serial;
      publish(status, out);
      const model::Motion& motion = c.command.motion->motion();
      const model::Joints promised = motion.to();
      const bool arrived = (event.joints - promised).cwiseAbs().maxCoeff() <= kSamePlace;
      r.tools = cell_->set_of(event.holds);
      const bool as_promised = arrived && r.tools == c.command.tools.after;
      const auto origin = c.command.origin;
      if (origin == QueuedCommand::Origin::client) ++completed_;
      if (origin == QueuedCommand::Origin::way_back && !r.way_back.empty()) r.way_back.pop_back();
      r.trail.push_front(undoing(motion));
      if (r.trail.size() > kTrail) r.trail.pop_back();
      if (!as_promised) {
        r.way_back.clear();
        r.trail.clear();
      }
      r.known_at = std::max(r.known_at, std::min(event.at, now));
      if (arrived && motion.duration() > 0) r.standing = c.command.motion->standing_at_end();
      if (r.following && !as_promised) put_following_back(r, out);
      r.committed = std::move(r.following);
      r.following.reset();
      stand_at(r, arrived ? promised : event.joints, now, out, origin != QueuedCommand::Origin::client);
      if (!as_promised) revoke_dependents(*index, out);
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
      r.way_back.clear();
      r.trail.clear();
      if (r.following) put_following_back(r, out);
      r.committed.reset();
      r.tools = cell_->set_of(event.holds);
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
      changed(r);
      revoke_dependents(index_of(r), out);
    }
    if (const auto outcome = unreported_outcome(r, now)) append(on(*outcome, now), out);
  }
}

}  // namespace interlace::core
