// When nobody who is waited for will move by itself: who is sent out of the way, and what people are told when that fails.
#include <fmt/format.h>

#include <algorithm>

#include "planner/core/explain.hpp"
#include "planner/core/planner.hpp"

namespace interlace::core {

using model::CommandState;
using model::CommandStatus;
using model::Reason;

WaitGraph Planner::wait_graph() const {
  std::vector<WaitNode> nodes;
  for (const RobotRecord& r : robots_) {
    WaitNode n;
    if (r.committed) {
      n.state = WaitNode::State::moves;
    } else if (r.lost() || !r.ready) {
      n.state = WaitNode::State::unknown;
    } else if (r.next()) {
      n.state = WaitNode::State::waits;
      n.blockers = r.blockers;
    }
    nodes.push_back(std::move(n));
  }
  return WaitGraph{std::move(nodes)};
}

bool Planner::all_stand() const {
  return std::none_of(robots_.begin(), robots_.end(), [](const RobotRecord& r) { return r.committed.has_value(); });
}

/// Resolves one deadlock, if there is one that can be resolved. True when something was committed.
bool Planner::make_room(Instant now, Decisions& out) {
  if (!may_escape()) return false;
  const WaitGraph graph = wait_graph();
  std::vector<RobotRecord*> deadlocked;
  for (RobotRecord* r : candidates()) {
    if (graph.deadlocked(index_of(*r))) deadlocked.push_back(r);
  }
  // First whoever is kept by idle robots or by a circle he is part of: clearing those clears the queue of others behind them.
  const auto at_the_root = [&](const RobotRecord* r) {
    const auto circle = graph.circle(index_of(*r));
    return std::all_of(r->blockers.begin(), r->blockers.end(), [&](model::RobotIndex b) {
      return graph.node(b).state != WaitNode::State::waits || std::find(circle.begin(), circle.end(), b) != circle.end();
    });
  };
  std::stable_partition(deadlocked.begin(), deadlocked.end(), at_the_root);
  for (RobotRecord* r : deadlocked) {
    if (r->room_sought != revision_ && make_room_for(*r, now, out)) return true;
  }
  return false;
}

EscapeView Planner::escape_view(const RobotRecord& r, Instant now) const {
  EscapeView view;
  view.now = r.as_neighbour(index_of(r), now);
  if (r.lost()) {
    view.immovable = r.foreign ? "it moves although nobody told it to" : "it is not heard from";
  } else if (!r.ready) {
    view.immovable = "its controller is not ready";
  }
  view.tolerance = candidate_of(r, nullptr).tolerance;
  view.trail.assign(r.trail.begin(), r.trail.end());
  const model::Pose X_WT = r.robot->X_WB * model::tcp_pose(r.robot->model, r.robot->home);
  view.home.target = model::LinearTarget{X_WT};
  if (!r.queue.empty()) view.next = &r.queue.front().request;
  return view;
}

/// Escapes for all that stand in the way of the command whose turn it is at `r`, and its start, committed together or not at all.
bool Planner::make_room_for(RobotRecord& r, Instant now, Decisions& out) {
  if (!may_escape() || r.lost() || !r.ready || r.room_sought == revision_) return false;
  r.room_sought = revision_;
  std::vector<EscapeView> views;
  for (const RobotRecord& other : robots_) views.push_back(escape_view(other, now));
  const QueuedCommand& waiting = *r.next();
  const Candidate served = candidate_of(r, waiting.motion);
  EscapeSearch search{*cell_, std::move(views), *strategy_, timing_at(now), maps_};
  auto plan = search.make_room(served);
  if (!plan) {
    // Who waits for a robot that is not heard from waits for it to come back: no command of a person could move it.
    if (all_stand() && waiting.status.reason != Reason::robot_unknown) warn(r, std::move(plan.error()));
    return false;
  }
  // A way back makes no room for itself: what it leads to is what the escapes serve.
  const model::CommandId serves = waiting.origin == QueuedCommand::Origin::client ? waiting.status.id : waiting.status.serves;
  for (PlannedMotion& e : plan->escapes) {
    RobotRecord& b = robots_[e.robot];
    QueuedCommand escape;
    escape.origin = QueuedCommand::Origin::escape;
    escape.status.id = model::CommandId{options_.escape_prefix + std::to_string(++last_escape_)};
    escape.status.robot = b.robot->name;
    escape.status.escape = true;
    escape.status.serves = serves;
    escape.status.submitted = now;
    escape.request = e.request;
    escape.motion = e.motion;
    e.assessment.reason = Reason::escape;
    b.way_back.push_back(undoing(e.motion->motion()));
    b.escapes.push_front(std::move(escape));
    commit_next(b, candidate_of(b, e.motion), std::move(e.assessment), now + options_.lead, out,
                fmt::format("{} goes {} to make room for {}", b.robot->name.str(), to_string(e.way), serves.str()));
    rejudge_queue(b, out);
  }
  plan->served.reason = Reason::escape;
  commit_next(r, served, std::move(plan->served), r.ready_since + options_.lead, out);
  return true;
}

/// Nothing helps: says so to people, once, with all that was tried.
void Planner::warn(RobotRecord& r, EscapeRefusals refusals) {
  CommandStatus& status = r.next()->status;
  const WaitGraph graph = wait_graph();
  std::string who;
  const auto circle = graph.circle(index_of(r));
  for (std::size_t i = 0; i < circle.size(); ++i) who += fmt::format("{}{}", i > 0 ? " for " : "", robots_[circle[i]].robot->name.str());
  if (circle.empty()) {
    for (const model::RobotIndex b : r.blockers) who += fmt::format("{}{}", who.empty() ? "" : ", ", robots_[b].robot->name.str());
  }
  status.state = CommandState::waiting;
  status.reason = Reason::deadlock;
  status.refusals = std::move(refusals);
  status.text = fmt::format("{}; none of {} ways out helps: move a robot by a command",
                            circle.empty() ? fmt::format("{} cannot pass {}", r.robot->name.str(), who)
                                           : fmt::format("deadlock, {} for {}", who, r.robot->name.str()),
                            status.refusals.size());
}

}  // namespace interlace::core
