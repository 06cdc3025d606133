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
    } else if (r.lost() || !r.ready || r.held) {
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

bool Planner::all_stand_around(const RobotRecord& r) const {
  const auto& around = neighbourhood_.around(index_of(r));
  return std::none_of(around.begin(), around.end(), [&](model::RobotIndex i) { return robots_[i].committed.has_value(); });
}

/// Changes with everything that a search for room for `r` depends on.
std::uint64_t Planner::scene_around(const RobotRecord& r) const {
  std::uint64_t newest = 0;
  for (const model::RobotIndex i : neighbourhood_.around(index_of(r))) newest = std::max(newest, robots_[i].changed);
  return newest;
}

/// Resolves one deadlock, if there is one that can be resolved. True when something was committed.
bool Planner::make_room(Instant now, Decisions& out) {
  if (!may_escape()) return false;
  if (clearing_) return go_on_clearing(now, out);
  // Who waits for one that is under way is in no deadlock: mostly that is everybody, and nothing else has to be looked at.
  std::vector<RobotRecord*> stuck = candidates(now);
  const auto waits_for_a_mover = [&](const RobotRecord* r) {
    return std::any_of(r->blockers.begin(), r->blockers.end(), [&](model::RobotIndex b) { return robots_[b].committed.has_value(); });
  };
  const auto needs_no_room = [&](const RobotRecord* r) { return r->gives_way || waits_for_a_mover(r); };
  stuck.erase(std::remove_if(stuck.begin(), stuck.end(), needs_no_room), stuck.end());
  if (stuck.empty()) return false;
  const WaitGraph graph = wait_graph();
  std::vector<RobotRecord*> deadlocked;
  for (RobotRecord* r : stuck) {
    const bool knows_all = std::none_of(r->blockers.begin(), r->blockers.end(),
                                        [&](model::RobotIndex b) { return graph.node(b).state == WaitNode::State::unknown; });
    if (graph.deadlocked(index_of(*r)) && knows_all) deadlocked.push_back(r);
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
    if (make_room_for(*r, now, out)) return true;
  }
  // Nobody can be let through at one stroke. The one who waits longest at the root of it gets the space around it cleared.
  return std::any_of(deadlocked.begin(), deadlocked.end(), [&](RobotRecord* r) { return begin_clearing(*r, now, out); });
}

/// What the command, or the way back that leads to it, is to be done for.
const model::CommandId& Planner::served_by(const QueuedCommand& command) {
  return command.origin == QueuedCommand::Origin::client ? command.status.id : command.status.serves;
}

/// All that a search for room for `r` may look at: whoever it or an escape that it needs may meet.
std::vector<EscapeView> Planner::escape_views(const RobotRecord& r, Instant now) const {
  std::vector<EscapeView> views(robots_.size());
  const int farthest = EscapeRules{}.cascade + 1;
  for (const model::RobotIndex i : neighbourhood_.within(index_of(r), farthest)) views[i] = escape_view(robots_[i], now);
  return views;
}

EscapeView Planner::escape_view(const RobotRecord& r, Instant now) const {
  EscapeView view;
  r.add_as_neighbour(index_of(r), now, view.seen);
  if (r.lost()) {
    view.immovable = r.foreign ? "it moves although nobody told it to" : "it is not heard from";
  } else if (!r.ready) {
    view.immovable = "its controller is not ready";
  } else if (r.held) {
    view.immovable = "it is held";
  }
  view.tolerance = candidate_of(r, nullptr).tolerance;
  view.trail.assign(r.trail.begin(), r.trail.end());
  model::MotionRequest home;
  home.target = model::LinearTarget{r.robot->X_WB * model::tcp_pose(r.robot->model, r.robot->home)};
  view.home.push_back(home);
  if (r.robot->model.joints.velocity && r.robot->model.joints.acceleration) {
    home.target = model::JointTarget{r.robot->home};
    view.home.push_back(home);
  }
  if (!r.queue.empty()) {
    view.next = &r.queue.front().request;
    view.next_bodies = r.queue.front().motion->bodies();
  }
  return view;
}

/// Escapes for all that stand in the way of the command whose turn it is at `r`, and its start, committed together or not at all. Looks
/// once at each scene; `r.refused` says what was tried in vain.
bool Planner::make_room_for(RobotRecord& r, Instant now, Decisions& out) {
  if (!may_escape() || r.lost() || !r.ready || r.room_sought == scene_around(r)) return false;
  r.room_sought = scene_around(r);
  const QueuedCommand& waiting = *r.next();
  const Candidate served = candidate_of(r, waiting.motion);
  auto plan =
      EscapeSearch{*cell_, neighbourhood_, escape_views(r, now), *strategy_, timing_at(now), maps_}.make_room(served, waiting.request);
  if (!plan) {
    r.refused = std::move(plan.error());
    return false;
  }
  const model::CommandId serves = served_by(waiting);
  for (PlannedMotion& e : plan->escapes) commit_escape(std::move(e), serves, now, out);
  plan->served.reason = Reason::escape;
  commit_next(r, served, std::move(plan->served), r.ready_since + options_.lead, out);
  return true;
}

/// Makes a planned escape a fact: it goes through its robot's escape queue, ahead of the main queue, which is judged again from its goal.
void Planner::commit_escape(PlannedMotion e, const model::CommandId& serves, Instant now, Decisions& out) {
  RobotRecord& b = robots_[e.robot];
  QueuedCommand escape;
  escape.origin = QueuedCommand::Origin::escape;
  escape.way = e.way;
  escape.status.id = model::CommandId{options_.escape_prefix + std::to_string(++last_escape_)};
  escape.status.robot = b.robot->name;
  escape.status.escape = true;
  escape.status.serves = serves;
  escape.status.submitted = now;
  escape.request = e.request;
  escape.motion = e.motion;
  escape.tools = {b.tools_after_motion(), b.tools_after_motion(), b.tools_after_motion()};
  e.assessment.reason = Reason::escape;
  b.way_back.push_back(undoing(e.motion->motion()));
  b.escapes.push_front(std::move(escape));
  const std::string where = e.way == model::EscapeWay::retreat ? "back where it came from" : to_string(e.way);
  commit_next(b, candidate_of(b, e.motion), std::move(e.assessment), now + options_.lead, out,
              fmt::format("{} goes {} to make room for {}", b.robot->name.str(), where, serves.str()));
  rejudge_queue(b, out);
}

/// Nothing helps: says so to people, once, with all that was tried.
void Planner::warn(RobotRecord& r) {
  CommandStatus& status = r.next()->status;
  // Who waits for a robot that is not heard from waits for it to come back, for a held one until it is resumed: no command could move it.
  if (r.lost() || !r.ready || status.reason == Reason::robot_unknown || status.reason == Reason::held) return;
  const WaitGraph graph = wait_graph();
  std::string who;
  const auto circle = graph.circle(index_of(r));
  for (std::size_t i = 0; i < circle.size(); ++i) who += fmt::format("{}{}", i > 0 ? " for " : "", robots_[circle[i]].robot->name.str());
  if (circle.empty()) {
    for (const model::RobotIndex b : r.blockers) who += fmt::format("{}{}", who.empty() ? "" : ", ", robots_[b].robot->name.str());
  }
  r.blockers_told = r.blockers;
  status.state = CommandState::waiting;
  status.reason = Reason::deadlock;
  status.refusals = r.refused;
  status.text = fmt::format("{}; none of {} ways out helps: move a robot by a command",
                            circle.empty() ? fmt::format("{} cannot pass {}", r.robot->name.str(), who)
                                           : fmt::format("deadlock, {} for {}", who, r.robot->name.str()),
                            status.refusals.size());
}

}  // namespace interlace::core
