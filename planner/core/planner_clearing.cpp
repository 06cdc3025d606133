// The last resort against a deadlock: the robots around a command are taken apart step by step, by a plan that is known to end with it.
#include <fmt/format.h>

#include <algorithm>

#include "planner/core/planner.hpp"
#include "planner/core/untangle.hpp"

namespace interlace::core {

bool Planner::begin_clearing(RobotRecord& r, Instant now, Decisions& out) {
  if (r.clearing_given_up == scene_around(r) || !strategy_->service().rules.step_aside) return false;
  clearing_ = Clearing{index_of(r), served_by(*r.next()), {}, 0};
  return go_on_clearing(now, out);
}

/// Plans once everybody around stands, then sends one robot after the other; the command itself starts like any other, as soon as it can.
bool Planner::go_on_clearing(Instant now, Decisions& out) {
  bool progress = false;
  while (!clearing_->steps.empty() && !robots_[clearing_->steps.front().robot].committed) {
    const bool sent = send(clearing_->steps.front(), now, out);
    clearing_->steps.pop_front();
    if (!sent) clearing_->steps.clear();  // the scene is another one than was planned for
    progress = progress || sent;
  }
  RobotRecord& r = robots_[clearing_->robot];
  if (progress || !all_stand_around(r)) return progress;
  if (make_room_for(r, now, out)) return true;
  if (clearing_->plans++ < kPlans) {
    const QueuedCommand& waiting = *r.next();
    if (auto steps = untangle(*cell_, neighbourhood_, escape_views(r, now), neighbourhood_.around(clearing_->robot),
                              candidate_of(r, waiting.motion), waiting.request, *strategy_, timing_at(now), maps_)) {
      clearing_->steps.assign(steps->begin(), steps->end());
      return go_on_clearing(now, out);
    }
  }
  r.clearing_given_up = scene_around(r);
  clearing_.reset();
  warn(r);
  return false;
}

/// Sends a robot off for the clearing when its way is clear.
bool Planner::send(const UntangleStep& step, Instant now, Decisions& out) {
  RobotRecord& b = robots_[step.robot];
  if (!escape_view(b, now).immovable.empty()) return false;
  auto motion = admit(*cell_, step.robot, b.standing->robot(), b.standing->motion().to(), step.request);
  if (!motion || (*motion)->motion().duration() <= 0) return false;
  const Candidate candidate = candidate_of(b, *motion);
  Assessment a = strategy_->assess(candidate, neighbours_of(b, now), timing_at(now), maps_);
  if (!a.start) return false;
  commit_escape({step.robot, step.way, step.request, std::move(*motion), candidate.tolerance, {}, std::move(a)}, clearing_->command, now,
                out);
  return true;
}

/// The command that is cleared for may have been given up, its robot lost.
void Planner::check_clearing() {
  if (!clearing_) return;
  const RobotRecord& r = robots_[clearing_->robot];
  if (!r.next() || served_by(*r.next()) != clearing_->command || r.lost() || !r.ready || r.held) clearing_.reset();
}

}  // namespace interlace::core
