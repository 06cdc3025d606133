// Deadlines: what is said of them. They move nobody up; a command that is late, or could never have been in time, is carried out all the
// same.
#include <fmt/format.h>

#include <algorithm>

#include "planner/core/planner.hpp"

namespace interlace::core {

using model::DeadlineVerdict;

namespace {

/// Shortest time that `motion` can take.
Duration least_duration(const SampledMotion& motion) {
  return model::from_seconds(motion.motion().duration() * (1 - motion.motion().robot().controller.speed_error));
}

}  // namespace

/// Least time from now to the end of `command`, were it appended to the queue of `r`: what the robot does, what waits before it, and
/// itself, with nobody ever in the way. Escapes are left out: they may be given up.
Duration Planner::least_time(const RobotRecord& r, const QueuedCommand& command, Instant now) const {
  Instant t = now;
  const auto carry_out = [&](const Commitment& c) {
    const Duration least = least_duration(*c.command.motion);
    if (c.phase == Commitment::Phase::started) {
      t = std::max(t, c.start_from + least);
    } else if (c.command.origin == QueuedCommand::Origin::client) {
      t += least;
    }
  };
  if (r.committed) carry_out(*r.committed);
  if (r.following) carry_out(*r.following);
  // Each start is decided once the motion before it has ended, and is `lead` after its decision.
  for (const QueuedCommand& q : r.queue) t += options_.lead + least_duration(*q.motion);
  return t + options_.lead + least_duration(*command.motion) - now;
}

void Planner::set_deadline(const RobotRecord& r, QueuedCommand& command, double within, Instant now) {
  model::CommandStatus& status = command.status;
  status.deadline = now + model::from_seconds(within);
  const Duration least = least_time(r, command, now);
  if (now + least > *status.deadline) {
    status.verdict = DeadlineVerdict::impossible;
    status.text =
        fmt::format("cannot be done within {:.2f} s: it takes at least {:.2f} s with what goes before it; it is carried out all the same",
                    within, model::to_seconds(least));
    return;
  }
  status.verdict = DeadlineVerdict::open;
  deadlines_.emplace(*status.deadline, index_of(r), status.id);
}

/// Says of commands whose deadline has just passed that they are late.
void Planner::notice_deadlines(Instant now, Decisions& out) {
  while (!deadlines_.empty() && std::get<Instant>(*deadlines_.begin()) < now) {
    const auto [at, robot, id] = *deadlines_.begin();
    deadlines_.erase(deadlines_.begin());
    const auto note = [&out, this, &id = id](QueuedCommand& command) {
      if (command.status.id != id || command.status.verdict != DeadlineVerdict::open) return;
      command.status.verdict = DeadlineVerdict::late;
      publish(command.status, out);
    };
    RobotRecord& r = robots_[robot];
    if (r.committed) note(r.committed->command);
    if (r.following) note(r.following->command);
    std::for_each(r.queue.begin(), r.queue.end(), note);
  }
}

}  // namespace interlace::core
