// What would come of it if whoever can start did: a copy of the planner among robots that do exactly what they are told.
#include <algorithm>

#include "planner/core/planner.hpp"

namespace interlace::core {

namespace {

constexpr int kStepsPerCommand = 40;  // more of them lead nowhere

/// What a robot in the rehearsal does, as its proxy would tell.
struct Doing {
  model::ExecutionReported report;
  Instant start{}, end{};
  bool told = false;  // that it has started
};

}  // namespace

/// All starts that are not decided yet, until all commands are done; empty when they would not all be, or when it takes too long to tell.
std::optional<OutlookPlan> Planner::rehearse(Instant now) {
  MapStore maps = std::move(maps_);
  auto known = std::exchange(known_, {});
  auto finished = std::exchange(finished_, {});
  Planner copy = *this;
  known_ = std::move(known);
  finished_ = std::move(finished);
  copy.maps_ = std::move(maps);
  copy.ahead_ = {};
  copy.options_.posture_timeout.reset();
  std::vector<std::optional<Doing>> doing(robots_.size());
  std::size_t commands = robots_.size();
  const auto take_up = [&](model::RobotIndex i, Instant start) {
    Commitment& c = *copy.robots_[i].committed;
    c.accepted = true;
    Doing d;
    d.report.id = c.command.status.id;
    d.report.robot = copy.robots_[i].robot->name;
    d.report.attempt = c.command.attempts;
    d.report.joints = c.command.motion->motion().to();
    d.start = start;
    d.end = start + model::from_seconds(c.command.motion->motion().duration());
    d.told = c.phase == Commitment::Phase::started;
    doing[i] = std::move(d);
  };
  for (model::RobotIndex i = 0; i < robots_.size(); ++i) {
    const RobotRecord& r = robots_[i];
    commands += r.queue.size() + r.escapes.size();
    if (r.committed && r.committed->phase != Commitment::Phase::held) take_up(i, r.committed->start_from);
  }
  bool as_told = true;
  OutlookPlan plan;
  const auto note = [&](model::RobotIndex i) {
    const Commitment& c = *copy.robots_[i].committed;
    if (c.serial <= robots_[i].last_serial || c.command.attempts > 1) return;
    PlannedStart s;
    s.robot = i;
    s.start = c.start_from;
    s.serves = i;
    if (c.command.origin != QueuedCommand::Origin::client) {
      s.detour = Detour{c.command.way, c.command.request, c.command.motion};
      const auto is_served = [&](const RobotRecord& r) {
        return std::any_of(r.queue.begin(), r.queue.end(), [&](const auto& q) { return q.status.id == c.command.status.serves; });
      };
      const auto served = std::find_if(robots_.begin(), robots_.end(), is_served);
      if (served != robots_.end()) s.serves = index_of(*served);
    }
    plan.starts.push_back(std::move(s));
  };
  const auto obey = [&](const Decisions& decided) {
    for (const model::Dispatch& d : decided.dispatches) {
      const model::RobotIndex i = cell_->find(d.robot).value();
      take_up(i, d.earliest);
      note(i);
    }
    as_told = as_told && decided.withdrawals.empty();
  };
  const auto report = [&](Doing& d, model::ExecutionState state, Instant at) {
    d.report.state = state;
    d.report.at = at;
    obey(copy.on(model::ExecutionReported{d.report}, at));
  };
  plan.end = now;
  obey(copy.advance(now));
  std::size_t steps = kStepsPerCommand * commands;
  for (Instant t = now; as_told && steps > 0; --steps) {
    std::optional<Instant> next = copy.next_deadline();
    const auto consider = [&](Instant x) { next = next ? std::min(*next, x) : x; };
    for (const auto& d : doing) {
      if (d) consider(d->told ? d->end : d->start);
    }
    if (!next) break;
    t = std::max(t, *next);
    for (auto& d : doing) {
      if (!d || !d->told || d->end > t) continue;
      Doing over = *std::exchange(d, std::nullopt);
      plan.end = std::max(plan.end, t);
      report(over, model::ExecutionState::completed, t);
    }
    for (auto& d : doing) {
      if (!d || d->told || d->start > t) continue;
      d->told = true;
      Doing begun = *d;
      report(begun, model::ExecutionState::started, t);
    }
    obey(copy.advance(t));
  }
  const bool all_done =
      std::none_of(copy.robots_.begin(), copy.robots_.end(), [](const RobotRecord& r) { return r.committed || r.next(); });
  maps_ = std::move(copy.maps_);
  if (!as_told || !all_done) return std::nullopt;
  std::stable_sort(plan.starts.begin(), plan.starts.end(), [](const auto& a, const auto& b) { return a.start < b.start; });
  return plan;
}

}  // namespace interlace::core
