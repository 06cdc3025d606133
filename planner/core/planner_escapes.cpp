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

bool Planner::all_stand_around(const std::vector<bool>& around) const {
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    if (around[i] && robots_[i].committed) return false;
  }
  return true;
}

/// Resolves one deadlock, if there is one that can be resolved. True when something was committed.
bool Planner::make_room(Instant now, Decisions& out) {
  if (!may_escape()) return false;
  if (clearing_) return go_on_clearing(now, out);
  const WaitGraph graph = wait_graph();
  std::vector<RobotRecord*> deadlocked;
  for (RobotRecord* r : candidates()) {
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
    if (r->room_sought != revision_ && make_room_for(*r, now, out)) return true;
  }
  // Nobody can be let through at one stroke. The one who waits longest at the root of it gets the space around it cleared.
  for (RobotRecord* r : deadlocked) {
    if (r->clearing_given_up == revision_ || !strategy_->service().rules.step_aside) continue;
    clearing_ = Clearing{index_of(*r), served_by(*r->next()), around(*r), std::vector<bool>(robots_.size(), false)};
    if (go_on_clearing(now, out)) return true;
    if (clearing_) return false;  // waits for those around to stand
  }
  return false;
}

/// What the command, or the way back that leads to it, is to be done for.
const model::CommandId& Planner::served_by(const QueuedCommand& command) {
  return command.origin == QueuedCommand::Origin::client ? command.status.id : command.status.serves;
}

/// All that can meet `r` or somebody who can.
std::vector<bool> Planner::around(const RobotRecord& r) const {
  std::vector<bool> near(robots_.size(), false);
  near[index_of(r)] = true;
  for (const model::RobotIndex a : neighbourhood_.of(index_of(r))) {
    near[a] = true;
    for (const model::RobotIndex b : neighbourhood_.of(a)) near[b] = true;
  }
  return near;
}

/// One step of clearing: everybody around stands; whoever can goes home, until the command that all this is for can be let through.
bool Planner::go_on_clearing(Instant now, Decisions& out) {
  RobotRecord& r = robots_[clearing_->robot];
  if (!all_stand_around(clearing_->around)) return false;
  const int most = 2 * static_cast<int>(std::count(clearing_->around.begin(), clearing_->around.end(), true));
  if (make_room_for(r, now, out) || (clearing_->steps++ < most && send_home(r, now, out))) return true;
  r.clearing_given_up = revision_;
  clearing_.reset();
  return false;
}

/// The command that is cleared for may have been given up, its robot lost.
void Planner::check_clearing() {
  if (!clearing_) return;
  const RobotRecord& r = robots_[clearing_->robot];
  if (!r.next() || served_by(*r.next()) != clearing_->command || r.lost() || !r.ready) clearing_.reset();
}

/// Everybody around `r` who can go home does; when nobody can, the first for whom others can make room; `r` itself last.
bool Planner::send_home(RobotRecord& r, Instant now, Decisions& out) {
  std::vector<RobotRecord*> others;
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    if (clearing_->around[i] && &robots_[i] != &r) others.push_back(&robots_[i]);
  }
  bool progress = false;
  for (RobotRecord* b : others) progress = goes_home(*b, false, now, out) || progress;
  if (progress || goes_home(r, false, now, out)) return true;
  others.push_back(&r);
  return std::any_of(others.begin(), others.end(), [&](RobotRecord* b) { return goes_home(*b, true, now, out); }) ||
         std::any_of(others.begin(), others.end(), [&](RobotRecord* b) { return goes_back(*b, now, out); });
}

/// Back where it came from, once in a clearing: whoever came last into a tangle can leave it the same way.
bool Planner::goes_back(RobotRecord& b, Instant now, Decisions& out) {
  const EscapeView view = escape_view(b, now);
  if (!view.immovable.empty() || clearing_->went_back[index_of(b)]) return false;
  for (const model::MotionRequest& back : view.trail) {
    if (!go_if_clear(b, model::EscapeWay::retreat, back, false, now, out)) continue;
    clearing_->went_back[index_of(b)] = true;
    return true;
  }
  return false;
}

bool Planner::goes_home(RobotRecord& b, bool with_escapes, Instant now, Decisions& out) {
  const EscapeView view = escape_view(b, now);
  if (!view.immovable.empty()) return false;
  return std::any_of(view.home.begin(), view.home.end(), [&](const model::MotionRequest& home) {
    return go_if_clear(b, model::EscapeWay::home, home, with_escapes, now, out);
  });
}

/// Sends `b` off for the clearing when its way is clear, or can be made so.
bool Planner::go_if_clear(RobotRecord& b, model::EscapeWay way, const model::MotionRequest& request, bool with_escapes, Instant now,
                          Decisions& out) {
  auto motion = admit(*cell_, index_of(b), b.standing->motion().to(), request);
  if (!motion || (*motion)->motion().duration() <= 0) return false;
  const Candidate candidate = candidate_of(b, *motion);
  Assessment a = strategy_->assess(candidate, neighbours_of(b, now), timing_at(now), maps_);
  const model::CommandId serves = clearing_->command;
  if (!a.start && with_escapes) {
    if (auto plan = escape_search(now).make_room(candidate, request)) {
      for (PlannedMotion& e : plan->escapes) commit_escape(std::move(e), serves, now, out);
      a = std::move(plan->served);
    }
  }
  if (!a.start || b.committed) return a.start.has_value();
  commit_escape({index_of(b), way, request, std::move(*motion), candidate.tolerance, {}, std::move(a)}, serves, now, out);
  return true;
}

EscapeSearch Planner::escape_search(Instant now) {
  std::vector<EscapeView> views;
  for (const RobotRecord& other : robots_) views.push_back(escape_view(other, now));
  return {*cell_, neighbourhood_, std::move(views), *strategy_, timing_at(now), maps_};
}

EscapeView Planner::escape_view(const RobotRecord& r, Instant now) const {
  EscapeView view;
  r.add_as_neighbour(index_of(r), now, view.seen);
  if (r.lost()) {
    view.immovable = r.foreign ? "it moves although nobody told it to" : "it is not heard from";
  } else if (!r.ready) {
    view.immovable = "its controller is not ready";
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
  if (!r.queue.empty()) view.next = &r.queue.front().request;
  return view;
}

/// Escapes for all that stand in the way of the command whose turn it is at `r`, and its start, committed together or not at all.
bool Planner::make_room_for(RobotRecord& r, Instant now, Decisions& out) {
  if (!may_escape() || r.lost() || !r.ready || r.room_sought == revision_) return false;
  r.room_sought = revision_;
  const QueuedCommand& waiting = *r.next();
  const Candidate served = candidate_of(r, waiting.motion);
  auto plan = escape_search(now).make_room(served, waiting.request);
  if (!plan) {
    // Who waits for a robot that is not heard from waits for it to come back: no command of a person could move it.
    if (waiting.status.reason != Reason::robot_unknown && all_stand_around(around(r))) warn(r, std::move(plan.error()));
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
  const std::string where = e.way == model::EscapeWay::retreat ? "back where it came from" : to_string(e.way);
  commit_next(b, candidate_of(b, e.motion), std::move(e.assessment), now + options_.lead, out,
              fmt::format("{} goes {} to make room for {}", b.robot->name.str(), where, serves.str()));
  rejudge_queue(b, out);
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
  r.blockers_told = r.blockers;
  status.state = CommandState::waiting;
  status.reason = Reason::deadlock;
  status.refusals = std::move(refusals);
  status.text = fmt::format("{}; none of {} ways out helps: move a robot by a command",
                            circle.empty() ? fmt::format("{} cannot pass {}", r.robot->name.str(), who)
                                           : fmt::format("deadlock, {} for {}", who, r.robot->name.str()),
                            status.refusals.size());
}

}  // namespace interlace::core
