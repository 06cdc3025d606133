// Looking ahead: starts in the order of a plan for all that waits, where that is better than letting whoever can start do so.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "planner/core/outlook_work.hpp"
#include "planner/core/planner.hpp"

namespace interlace::core {

using model::CommandState;
using model::CommandStatus;
using model::Reason;

namespace {

constexpr double kFirstLook = 10;         // budgets for the first decision, when a plan is made
constexpr double kMapShare = 0.1;         // of the budget, that may go into maps that nobody has prepared
constexpr double kGrantsPerSecond = 400;  // a twentieth of the time on the machines of today: they have other things to do
constexpr double kLongest = 10;           // [s] for which it goes on

}  // namespace

void Planner::serve_ahead(Instant now, Decisions& out) {
  check_clearing();
  ahead_.arrived = false;
  ahead_.wake.reset();
  const bool all_free = std::all_of(robots_.begin(), robots_.end(), [](const RobotRecord& r) { return !r.lost() && r.ready && !r.held; });
  if (clearing_ || !all_free || somebody_goes_before(now)) {
    ahead_.plan.reset();
    ahead_.event_ends.reset();
    return serve_whoever_can(now, out);
  }
  if (ahead_.seen != revision_) look_ahead(now);
  bool again = false;  // the plan was made for a moment ago: its times may need another look
  while (ahead_.plan && !ahead_.plan->starts.empty()) {
    auto& starts = ahead_.plan->starts;
    const auto due = std::find_if(starts.begin(), starts.end(), [&](const PlannedStart& s) {
      return s.start <= now + options_.lead && !robots_[s.robot].committed.has_value();
    });
    if (due == starts.end()) {
      for (const PlannedStart& s : starts) {
        if (!robots_[s.robot].committed) ahead_.wake = std::min(ahead_.wake.value_or(model::kForever), s.start - options_.lead);
      }
      let_others_go_first();
      break;
    }
    // What is decided before it and starts later is what it relies on.
    if (start_as_planned(starts.front(), now, out)) {
      starts.erase(starts.begin());
      again = false;
      continue;
    }
    if (somebody_is_about_to_start(now)) break;
    if (!again) look_from(now);
    ahead_.plan = again ? std::nullopt : ahead_.outlook->follow(*ahead_.plan);
    again = true;
    if (!ahead_.plan) ahead_.event_ends.reset();
  }
  if (!ahead_.plan) serve_whoever_can(now, out);
  ahead_.seen = revision_;
}

/// When `r` can start anything after what it is committed to.
Instant Planner::free_at(const RobotRecord& r, Instant now) const {
  if (!r.committed) return now + options_.lead;
  const Commitment& last = r.following ? *r.following : *r.committed;
  const double longest = last.command.motion->motion().duration() * (1 + r.robot->controller.speed_error);
  return std::max(now, last.start_until + model::from_seconds(longest)) + options_.lead;
}

OutlookRobot Planner::outlook_robot(const RobotRecord& r, Instant now) const {
  OutlookRobot o;
  r.add_as_neighbour(index_of(r), now, o.seen);
  o.tolerance = candidate_of(r, nullptr).tolerance;
  o.free = free_at(r, now);
  if (!r.committed && !r.trail.empty()) o.back = r.trail.front();
  for (const auto* queue : {&r.escapes, &r.queue}) {
    for (const QueuedCommand& c : *queue) o.queue.push_back({c.request, c.motion});
  }
  return o;
}

void Planner::look_from(Instant now) {
  std::vector<OutlookRobot> robots;
  for (const RobotRecord& r : robots_) robots.push_back(outlook_robot(r, now));
  ahead_.look = ahead_.outlook->look(std::move(robots), timing_ahead(now), options_.lead, maps_);
}

/// Keeps the plan as far as it still holds, and looks for a better one.
void Planner::look_ahead(Instant now) {
  const bool waiting = std::any_of(robots_.begin(), robots_.end(), [](const RobotRecord& r) { return r.next() != nullptr; });
  if (!waiting) {
    ahead_.plan.reset();
    return;
  }
  look_from(now);
  if (ahead_.plan) ahead_.plan = ahead_.outlook->follow(*ahead_.plan);
  if (!ahead_.plan && !ahead_.event_ends) {
    ahead_.fresh = true;
    const auto event = rehearse(now);
    look_from(now);
    if (event) {
      ahead_.event_ends = event->end;
      ahead_.plan = ahead_.outlook->follow(*event);
      if (ahead_.plan && ahead_.plan->end > event->end) ahead_.plan.reset();
    }
  }
  search_ahead(now);
}

/// Puts one decision's work into a better plan.
void Planner::search_ahead(Instant now) {
  // Before a plan is made all of it is new, and nobody waits for more than the first start.
  const double work = cell_->planning.budget * kWorkPerSecond;
  Outlook::Budget budget;
  budget.work = static_cast<std::size_t>(work * (ahead_.fresh ? kFirstLook : 1));
  budget.maps = static_cast<std::size_t>(work * (ahead_.fresh ? kFirstLook : kMapShare));
  if (ahead_.searched)
    budget.grants = static_cast<std::size_t>(kGrantsPerSecond * std::min(kLongest, model::to_seconds(now - *ahead_.searched)));
  ahead_.searched = now;
  ahead_.fresh = false;
  const auto no_later = ahead_.plan ? std::nullopt : ahead_.event_ends;
  auto better = ahead_.outlook->search(no_later, ahead_.plan ? &*ahead_.plan : nullptr, budget, maps_);
  if (better && (!no_later || better->end < *no_later)) ahead_.plan = std::move(better);
  if (!ahead_.plan) return;
  if (auto slower = ahead_.outlook->slowed_down(*ahead_.plan, static_cast<std::size_t>(work), maps_)) ahead_.plan = std::move(slower);
}

/// Somebody was told to start by now and has not been heard of since, or is to start once another one has left: that comes first.
bool Planner::somebody_is_about_to_start(Instant now) const {
  return std::any_of(robots_.begin(), robots_.end(), [&](const RobotRecord& r) {
    if (!r.committed) return false;
    if (r.committed->phase == Commitment::Phase::held) return departures_of(*r.committed) == Departures::open;
    return r.committed->phase == Commitment::Phase::dispatched && r.committed->start_from <= now + options_.lead;
  });
}

/// Makes a planned start a fact when it is as early as planned. One that others rely on may be that before its time has come.
bool Planner::start_as_planned(const PlannedStart& planned, Instant now, Decisions& out) {
  RobotRecord& r = robots_[planned.robot];
  const bool waits = planned.detour && r.next() && same_way(*r.next()->motion, *planned.detour->motion);  // a way back that was a detour
  const Detour* detour = planned.detour && !waits ? &*planned.detour : nullptr;
  if (r.following || r.lost() || !r.ready || (detour == nullptr && !r.next())) return false;
  if (detour != nullptr && !same_place(detour->motion->motion().from(), r.joints_after_motion())) return false;
  const SampledMotionPtr motion = detour != nullptr ? detour->motion : planned.slower ? planned.slower->motion : r.next()->motion;
  const Candidate candidate = candidate_of(r, motion);
  Timing timing = timing_ahead(now);
  timing.earliest = std::max(timing.earliest, free_at(r, now));
  Assessment a = strategy_->assess(candidate, neighbours_of(r, now), timing, maps_);
  if (!a.start || *a.start > std::max(now + options_.lead, planned.start)) return false;
  // A departure that is not promised yet, and cannot be at once, is none to rely on: the start would be taken back as soon as it is due.
  const bool relies_in_vain = std::any_of(a.departures.begin(), a.departures.end(), [&](model::RobotIndex other) {
    const RobotRecord& o = robots_[other];
    const Commitment& last = o.following ? *o.following : *o.committed;
    if (*a.start >= last.start_until + options_.confirm || promises(o, last.serial)) return false;
    return o.following || departures_of(last) != Departures::met;
  });
  if (relies_in_vain) return false;
  if (detour != nullptr) {
    const RobotRecord& served = robots_[planned.serves];
    if (!served.next()) return false;
    commit_escape({planned.robot, detour->way, detour->request, detour->motion, candidate.tolerance, {}, std::move(a)},
                  served_by(*served.next()), now, out);
    return true;
  }
  std::string text;
  const double delay = model::to_seconds(*a.start - (r.ready_since + options_.lead));
  if (planned.slower) {
    QueuedCommand& command = *r.next();
    const double longer = motion->motion().duration() / command.motion->motion().duration();
    command.full_speed.emplace(command.request, std::exchange(command.motion, motion));
    command.request = planned.slower->request;
    text = fmt::format("{} goes at once and takes {:.2f} times as long, which ends sooner than to wait", r.robot->name.str(), longer);
  } else if (delay > 0 && r.next()->status.state == CommandState::waiting && a.conflicts.empty() && r.next()->status.conflicts.empty()) {
    a.reason = Reason::delayed;
    text = fmt::format("{} starts {:.2f} s later: others went first, which ends sooner", r.robot->name.str(), delay);
  }
  commit_next(r, candidate, std::move(a), r.ready_since + options_.lead, out, std::move(text));
  return true;
}

/// Says to those that stand why they do.
void Planner::let_others_go_first() {
  const PlannedStart& first = ahead_.plan->starts.front();
  for (const PlannedStart& p : ahead_.plan->starts) {
    RobotRecord& r = robots_[p.robot];
    if (r.committed || !r.next() || p.detour) continue;
    CommandStatus& status = r.next()->status;
    if (status.state == CommandState::waiting && status.reason == Reason::delayed) continue;
    status.state = CommandState::waiting;
    status.reason = Reason::delayed;
    status.conflicts.clear();
    status.refusals.clear();
    r.blockers.clear();
    status.text =
        p.robot == first.robot
            ? fmt::format("{} starts at {:.2f} s, when it is clear of the others", r.robot->name.str(), model::to_seconds(p.start))
            : fmt::format("{} lets {} go first, which ends sooner, and starts at {:.2f} s", r.robot->name.str(),
                          robots_[first.robot].robot->name.str(), model::to_seconds(p.start));
  }
}

}  // namespace interlace::core
