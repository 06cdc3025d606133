// Who goes first when commands of different robots compete, and that nobody waits for ever. Decision:
// docs/adr/0007-priorities-and-control.md.
#include <fmt/format.h>

#include <algorithm>

#include "planner/core/planner.hpp"

namespace interlace::core {

using model::CommandState;
using model::CommandStatus;
using model::Reason;

/// Whether the command whose turn it is at `a` goes before the one at `b`, whatever their robots waited for: those that have waited longer
/// than anybody should, the longest first, then the higher priority. With equal priorities and patience left nobody goes before another.
bool Planner::goes_before(const RobotRecord& a, const RobotRecord& b, Instant now) const {
  const bool a_overdue = now - a.ready_since > options_.patience;
  const bool b_overdue = now - b.ready_since > options_.patience;
  if (a_overdue != b_overdue) return a_overdue;
  return a_overdue ? a.ready_since < b.ready_since : a.priority() > b.priority();
}

/// Whether there is one whose turn it is and who goes before another.
bool Planner::somebody_goes_before(Instant now) const {
  std::vector<const RobotRecord*> waiting;
  for (const RobotRecord& r : robots_) {
    if (!r.committed && r.next()) waiting.push_back(&r);
  }
  return std::any_of(waiting.begin(), waiting.end(), [&](const RobotRecord* a) {
    return now - a->ready_since > options_.patience ||
           std::any_of(waiting.begin(), waiting.end(), [&](const RobotRecord* b) { return goes_before(*a, *b, now); });
  });
}

/// Whether waiting for `w` is of use: what keeps it moves and will have arrived, or may be sent away. Where everything was tried in vain in
/// this scene, others go on, and change it.
bool Planner::can_be_let_through(const RobotRecord& w) const {
  if (w.blockers.empty()) return false;
  const auto any_blocker = [&](auto&& is) {
    return std::any_of(w.blockers.begin(), w.blockers.end(), [&](model::RobotIndex b) { return is(robots_[b]); });
  };
  if (any_blocker([](const RobotRecord& b) { return b.lost() || !b.ready || b.held; })) return false;
  if (any_blocker([](const RobotRecord& b) { return b.committed.has_value(); })) return true;
  if (!may_escape()) return false;
  const std::uint64_t scene = scene_around(w);
  return w.room_sought != scene || (strategy_->service().rules.step_aside && w.clearing_given_up != scene);
}

/// Whether the command that waits at `w` would have no start because of `moving`, were that a fact.
bool Planner::kept_out_by(const RobotRecord& w, const Neighbour& moving, Instant now) {
  std::vector<Neighbour> neighbours = neighbours_of(w, now);
  for (Neighbour& n : neighbours) {
    if (n.robot == moving.robot) n = moving;
  }
  const SampledMotionPtr& motion = w.next()->motion;
  const Assessment a = strategy_->assess(candidate_of(w, motion), neighbours, timing_at(now), maps_, Evidence::no);
  return !a.start && std::find(a.blockers.begin(), a.blockers.end(), moving.robot) != a.blockers.end();
}

/// `r`'s next command could go, but one that goes before it waits, and would be kept waiting by it: then `r` stands and waits for that one.
bool Planner::gives_way(RobotRecord& r, Instant now) {
  r.gives_way = false;
  std::vector<const RobotRecord*> before;
  for (const model::RobotIndex i : neighbourhood_.of(index_of(r))) {
    const RobotRecord& w = robots_[i];
    const bool waits = !w.committed && w.next() && !w.lost() && w.ready && !w.held;
    if (waits && goes_before(w, r, now) && can_be_let_through(w)) before.push_back(&w);
  }
  if (before.empty() || r.lost() || !r.ready) return false;
  QueuedCommand& head = *r.next();
  const Candidate candidate = candidate_of(r, head.motion);
  const Assessment a = strategy_->assess(candidate, neighbours_of(r, now), timing_at(now), maps_, Evidence::no);
  if (!a.start) return false;
  Neighbour moving;
  moving.robot = index_of(r);
  moving.motion = head.motion;
  moving.committed = true;
  moving.start_from = *a.start;
  moving.start_until = *a.start + candidate.tolerance;
  moving.reach = r.reach;
  const auto first = std::find_if(before.begin(), before.end(), [&](const RobotRecord* w) { return kept_out_by(*w, moving, now); });
  if (first == before.end()) return false;
  const RobotRecord& w = **first;
  const bool overdue = now - w.ready_since > options_.patience;
  r.gives_way = true;
  r.blockers = {index_of(w)};
  r.in_vain = {};
  CommandStatus& status = head.status;
  status.state = CommandState::waiting;
  status.reason = Reason::priority;
  status.text = overdue ? fmt::format("{} waits: {} goes first, which has waited too long", r.robot->name.str(), w.robot->name.str())
                        : fmt::format("{} waits: {} goes first with priority {}, this has {}", r.robot->name.str(), w.robot->name.str(),
                                      w.priority(), r.priority());
  status.conflicts.clear();
  status.refusals.clear();
  return true;
}

}  // namespace interlace::core
