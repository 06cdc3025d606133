// When motions start: who is next, what is due, what is sent.
#include "planner/core/planner.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "planner/core/explain.hpp"

namespace interlace::core {

using model::CommandState;
using model::CommandStatus;
using model::Reason;
using model::RobotMode;

namespace {

/// Room for the maps of each pair's motions now and next, as they are and after they have ended, and for those of some searches.
MapLimits map_limits(const Neighbourhood& neighbourhood) {
  MapLimits limits;
  limits.maps += 6 * neighbourhood.pairs();
  return limits;
}

}  // namespace

Planner::Planner(std::shared_ptr<const model::Cell> cell, PlannerOptions options)
    : cell_(std::move(cell)),
      bodies_(std::make_shared<model::Bodies>(*cell_)),
      options_(std::move(options)),
      strategy_(make_strategy(options_.strategy, *cell_)),
      neighbourhood_(*cell_),
      maps_(cell_->planning.margin, options_.stopwatch, map_limits(neighbourhood_)) {
  if (!strategy_) throw std::invalid_argument(fmt::format("unknown strategy \"{}\"", options_.strategy));
  if (strategy_->service().ahead) ahead_.outlook = std::make_shared<Outlook>(*cell_, neighbourhood_);
  robots_.resize(cell_->robots.size());
  for (model::RobotIndex i = 0; i < robots_.size(); ++i) {
    const model::Robot& robot = cell_->robots[i];
    robots_[i].robot = &robot;
    robots_[i].tools = cell_->set_of(robot.holds);
    robots_[i].reach = neighbourhood_.volume(i);
    robots_[i].standing =
        std::make_shared<SampledMotion>(model::Motion::rest(bodies_->of(i, robots_[i].tools), robot.start), cell_->planning.resolution);
  }
}

Decisions Planner::advance(Instant now) {
  Decisions out;
  notice_silence(now, out);
  notice_deadlines(now, out);
  schedule(now, out);
  return out;
}

void Planner::schedule(Instant now, Decisions& out) {
  prepared_ = false;
  send_due(now, out);
  if (strategy_->service().in_turn) {
    serve_in_turn(now, out);
  } else if (ahead_.outlook) {
    serve_ahead(now, out);
  } else {
    serve_whoever_can(now, out);
  }
  tell_held(out);
  for (RobotRecord& r : robots_) {
    if (const QueuedCommand* next = r.next(); next && !r.committed && next->status.state == CommandState::waiting)
      publish(next->status, out);
  }
  send_due(now, out);
  give_up_broken_promises(out);
}

/// Robots that stand and have a command: first whose command goes before others (goes_before), then who is longest ready.
std::vector<RobotRecord*> Planner::candidates(Instant now) {
  std::vector<RobotRecord*> result;
  for (RobotRecord& r : robots_) {
    const bool held_up = clearing_ && clearing_->robot != index_of(r) && neighbourhood_.near(clearing_->robot, index_of(r));
    if (!r.committed && r.next() && !r.held && !held_up) result.push_back(&r);
  }
  std::stable_sort(result.begin(), result.end(), [&](const auto* a, const auto* b) {
    if (goes_before(*a, *b, now)) return true;
    return !goes_before(*b, *a, now) && a->ready_since < b->ready_since;
  });
  return result;
}

void Planner::serve_whoever_can(Instant now, Decisions& out) {
  check_clearing();
  bool one_gives_way = false;
  const auto one_starts = [&] {
    one_gives_way = false;
    for (RobotRecord* r : candidates(now)) {
      if (gives_way(*r, now)) {
        one_gives_way = true;
      } else if (try_commit(*r, now, out)) {
        return true;
      }
    }
    return false;
  };
  // A robot that leaves may open the way for one that could not start, and where no room was found for one nobody gives way to it.
  while (one_starts() || make_room(now, out) || (one_gives_way && one_starts())) {
  }
}

/// The dissertation's order (6.2): one commanded robot at a time, looked for from robot 1 on. While one is deadlocked, and until the
/// escapes and the motion they serve are over, nobody else gets a command, unless nothing but such a command can help.
void Planner::serve_in_turn(Instant now, Decisions& out) {
  while (!escaping_ || all_stand()) {
    escaping_ = false;
    if (deadlocked_ && robots_[*deadlocked_].held) deadlocked_.reset();
    if (!deadlocked_) {
      const auto commanded =
          std::find_if(robots_.begin(), robots_.end(), [](const RobotRecord& r) { return !r.committed && r.next() && !r.held; });
      if (commanded == robots_.end()) return;
      if (try_commit(*commanded, now, out)) continue;
      deadlocked_ = index_of(*commanded);
    }
    RobotRecord& r = robots_[*deadlocked_];
    if (r.next() && !r.committed && !try_commit_when_all_stand(r, now, out)) {
      // When all stand and no escape was found, people are told, and what they can do is to give another robot a command.
      const auto helps = [&](RobotRecord& other) { return &other != &r && other.next() && !other.held && try_commit(other, now, out); };
      if (all_stand()) (void)std::any_of(robots_.begin(), robots_.end(), helps);
      return;
    }
    deadlocked_.reset();
  }
}

bool Planner::try_commit_when_all_stand(RobotRecord& r, Instant now, Decisions& out) {
  if (!all_stand()) return false;
  if (try_commit(r, now, out)) return true;
  escaping_ = make_room_for(r, now, out);
  if (!escaping_ && may_escape()) warn(r);
  return escaping_;
}

Candidate Planner::candidate_of(const RobotRecord& r, const SampledMotionPtr& motion) const {
  return {index_of(r), motion, options_.start_tolerance + model::from_seconds(r.robot->controller.latest_start())};
}

/// Those that `r` can ever meet; nobody else is looked at (6.2.3).
std::vector<Neighbour> Planner::neighbours_of(const RobotRecord& r, Instant now) const {
  std::vector<Neighbour> neighbours;
  for (const model::RobotIndex other : neighbourhood_.of(index_of(r))) robots_[other].add_as_neighbour(other, now, neighbours);
  return neighbours;
}

bool Planner::try_commit(RobotRecord& r, Instant now, Decisions& out) {
  QueuedCommand& head = *r.next();
  if (r.lost() || !r.ready) {
    r.blockers.clear();
    r.in_vain = {};
    head.status.state = CommandState::waiting;
    head.status.reason = Reason::not_ready;
    head.status.text = r.foreign ? fmt::format("{} moves although nobody told it to", r.robot->name.str())
                       : r.heard ? fmt::format("{} is not ready to take a start window", r.robot->name.str())
                                 : fmt::format("{} is not heard from", r.robot->name.str());
    head.status.conflicts.clear();
    head.status.refusals.clear();
    return false;
  }
  AssessedScene scene{head.motion, neighbours_of(r, now)};
  if (scene == r.in_vain) return false;
  const Candidate candidate = candidate_of(r, head.motion);
  Assessment a = strategy_->assess(candidate, scene.neighbours, timing_at(now), maps_);
  if (a.start) {
    commit_next(r, candidate, std::move(a), r.ready_since + options_.lead, out);
    return true;
  }
  const bool same_blockers = r.blockers_told == a.blockers && std::none_of(a.blockers.begin(), a.blockers.end(), [&](model::RobotIndex b) {
                               return robots_[b].committed.has_value();
                             });
  r.blockers = a.blockers;
  r.in_vain = std::move(scene);
  if (head.status.reason == Reason::deadlock && same_blockers) return false;  // what a person was told still holds
  head.status.state = CommandState::waiting;
  head.status.reason = a.reason;
  head.status.text = sentence(r.robot->name, a, 0);
  if (const std::string held = held_in_the_way(a.blockers); !held.empty()) {
    head.status.reason = Reason::held;
    head.status.text = fmt::format("{} waits for {}: {}", r.robot->name.str(), held, head.status.text);
  }
  head.status.conflicts = std::move(a.conflicts);
  head.status.refusals.clear();
  return false;
}

/// Makes the start that `a` chose for the command whose turn it is a fact, after what its robot is committed to already.
/// `could_start`: what its delay is counted from. `text` says it to people; empty: what the assessment says.
void Planner::commit_next(RobotRecord& r, const Candidate& candidate, Assessment a, Instant could_start, Decisions& out, std::string text) {
  auto& from = r.escapes.empty() ? r.queue : r.escapes;
  QueuedCommand command = std::move(from.front());
  from.pop_front();
  CommandStatus& status = command.status;
  const double delay = model::to_seconds(*a.start - could_start);
  if (a.conflicts.empty() && delay > 0) {
    // It goes at once now, but it stood waiting before: what kept it is the evidence of its delay.
    a.conflicts = status.conflicts;
    for (model::Conflict& c : a.conflicts) c.until = std::min(c.until, *a.start);
  }
  if (a.reason == Reason::none && delay > 0 && !a.conflicts.empty()) a.reason = Reason::delayed;
  if (a.reason == Reason::none && delay > 0 && status.reason == Reason::priority) {
    a.reason = Reason::priority;
    if (text.empty()) text = status.text;
  }
  Commitment c;
  c.serial = ++r.last_serial;
  c.start_from = *a.start;
  c.start_until = *a.start + candidate.tolerance;
  for (const model::RobotIndex other : a.departures) {
    const RobotRecord& o = robots_[other];
    c.departures.emplace_back(other, o.last_committed());
    c.on_promise = c.on_promise || c.start_from < (o.following ? *o.following : *o.committed).start_until + options_.confirm;
  }
  status.state = CommandState::scheduled;
  status.reason = a.reason;
  status.start = c.start_from;
  status.end = c.start_from + model::from_seconds(command.motion->motion().duration());
  status.delay = delay;
  status.text = text.empty() ? sentence(r.robot->name, a, delay) : std::move(text);
  status.conflicts = std::move(a.conflicts);
  status.refusals.clear();
  publish(status, out);
  if (clearing_ && command.status.id == clearing_->command) clearing_.reset();
  if (command.origin == QueuedCommand::Origin::client) r.way_back.clear();  // where it goes now is where its queue is judged from
  c.command = std::move(command);
  (r.committed ? r.following : r.committed) = std::move(c);
  r.blockers.clear();
  r.in_vain = {};
  changed(r);
}

Planner::Departures Planner::departure_of(model::RobotIndex robot, std::uint64_t serial, bool on_promise) const {
  const RobotRecord& other = robots_[robot];
  if (other.last_started >= serial || (on_promise && promises(other, serial))) return Departures::met;
  const bool still_to_come =
      (other.committed && other.committed->serial == serial) || (other.following && other.following->serial == serial);
  return still_to_come ? Departures::open : Departures::broken;
}

Planner::Departures Planner::departures_of(const Commitment& c) const {
  Departures result = Departures::met;
  for (const auto& [robot, serial] : c.departures) {
    const Departures departure = departure_of(robot, serial, c.on_promise);
    if (departure == Departures::broken) return departure;
    if (departure == Departures::open) result = departure;
  }
  return result;
}

void Planner::send_due(Instant now, Decisions& out) {
  for (RobotRecord& r : robots_) {
    if (!r.committed) continue;
    Commitment& c = *r.committed;
    if (c.phase == Commitment::Phase::dispatched && !c.accepted && now >= c.sent + options_.answer_timeout && now <= c.start_until) {
      if (r.held && !is_relied_on(r, r.committed)) {  // unanswered: say again that it is taken back
        c.sent = now;
        out.withdrawals.push_back({c.command.status.id, r.robot->name, c.command.attempts});
      } else {
        dispatch(r, now, out);  // unanswered: say it again, the proxy executes it once
      }
      continue;
    }
    if (c.phase != Commitment::Phase::held) continue;
    const Departures departures = departures_of(c);
    const bool too_late = now > c.start_from;
    if (departures == Departures::broken || too_late || r.lost() || !r.ready) {
      put_back(r, Reason::none, {}, out);  // what its window was proven for no longer holds
    } else if (departures == Departures::met && (now >= c.start_from - options_.lead || relying_on(r, c, false) != nullptr)) {
      ++c.command.attempts;
      c.phase = Commitment::Phase::dispatched;
      dispatch(r, now, out);
    }
  }
}

void Planner::dispatch(RobotRecord& r, Instant now, Decisions& out) {
  Commitment& c = *r.committed;
  c.sent = now;
  model::Dispatch d;
  d.id = c.command.status.id;
  d.robot = r.robot->name;
  d.attempt = c.command.attempts;
  d.motion = c.command.request;
  d.from = c.command.motion->motion().from();
  d.holds = cell_->names_of(c.command.tools.before);
  d.earliest = c.start_from;
  d.latest = c.start_until;
  d.duration = c.command.motion->motion().duration();
  out.dispatches.push_back(std::move(d));
}

std::optional<Instant> Planner::next_deadline() const {
  std::optional<Instant> next;
  const auto consider = [&](Instant t) { next = next ? std::min(*next, t) : t; };
  if (!deadlines_.empty()) consider(std::get<Instant>(*deadlines_.begin()) + Duration{1});
  if (ahead_.arrived) consider(Instant{});
  if (ahead_.wake) consider(*ahead_.wake);
  for (const RobotRecord& r : robots_) {
    if (options_.posture_timeout && r.heard) consider(r.last_heard + *options_.posture_timeout + Duration{1});
    if (!r.committed) continue;
    const Commitment& c = *r.committed;
    if (c.phase == Commitment::Phase::held) {
      consider(departures_of(c) == Departures::met ? c.start_from - options_.lead : c.start_from + Duration{1});
    } else if (c.phase == Commitment::Phase::dispatched) {
      if (!c.accepted && c.sent + options_.answer_timeout <= c.start_until) consider(c.sent + options_.answer_timeout);
      if (!r.lost() && r.stood && r.stood->at > c.start_until) consider(c.start_until + kGrace + Duration{1});
    }
  }
  return next;
}

model::PlannerState Planner::state(Instant now) const {
  model::PlannerState s;
  s.cell = cell_->name;
  s.at = now;
  s.strategy = strategy_->name();
  s.accepted = accepted_;
  s.rejected = rejected_;
  s.completed = completed_;
  for (const RobotRecord& r : robots_) {
    model::RobotStatus status;
    status.name = r.robot->name;
    status.holds = cell_->names_of(r.tools);
    status.held = r.held;
    status.queued = static_cast<std::uint32_t>(r.queue.size() + r.escapes.size());
    const QueuedCommand* next = r.next();
    const CommandStatus* current = r.committed ? &r.committed->command.status : next ? &next->status : nullptr;
    if (current) {
      status.current = current->id;
      status.reason = current->reason;
      status.text = current->text;
      status.conflicts = current->conflicts;
      status.refusals = current->refusals;
      status.serves = current->serves;
    }
    status.mode = r.lost()                                                          ? RobotMode::unknown
                  : r.committed && r.committed->phase == Commitment::Phase::started ? RobotMode::moving
                  : current                                                         ? RobotMode::commanded
                                                                                    : RobotMode::standby;
    s.robots.push_back(std::move(status));
  }
  return s;
}

}  // namespace interlace::core
