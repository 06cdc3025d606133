// Starts that rely on a departure which is promised and not reported yet: what counts as a promise, and what is said when one is broken.
#include <fmt/format.h>

#include <algorithm>

#include "planner/core/planner.hpp"

namespace interlace::core {

Timing Planner::timing_ahead(Instant now) const {
  Timing timing = timing_at(now);
  if (cell_->planning.promise > 0) timing.promise = model::from_seconds(cell_->planning.promise);
  return timing;
}

/// Whether `r` may be relied on to start its commitment `serial` in its window: its proxy has accepted that, or it is carrying out the
/// motion before it, as told, and waits for nobody then but those who may be relied on themselves. It is heard from.
bool Planner::promises(const RobotRecord& r, std::uint64_t serial) const {
  if (r.lost() || !r.committed) return false;
  if (r.committed->serial == serial) return r.committed->phase == Commitment::Phase::dispatched && r.committed->accepted;
  if (!r.following || r.following->serial != serial || r.committed->phase != Commitment::Phase::started) return false;
  return departures_of(*r.following) == Departures::met;
}

/// A robot whose start relies on the start of `promised` by `r`, which has not been reported; null when there is none. `under_way`: one
/// that has been told to start, or has.
const RobotRecord* Planner::relying_on(const RobotRecord& r, const Commitment& promised, bool under_way) const {
  if (promised.phase == Commitment::Phase::started) return nullptr;
  for (const RobotRecord& other : robots_) {
    if (!other.committed || !other.committed->on_promise) continue;
    if (under_way == (other.committed->phase == Commitment::Phase::held)) continue;
    for (const auto& [robot, serial] : other.committed->departures) {
      if (robot == index_of(r) && serial == promised.serial) return &other;
    }
  }
  return nullptr;
}

bool Planner::is_relied_on(const RobotRecord& r, const std::optional<Commitment>& c) const {
  return c && relying_on(r, *c, true) != nullptr;
}

/// A start that was sent, or is under way, to where another robot should have left and will not. What has not begun is withdrawn. What has
/// nobody can stop: people are told at once, and the other one is planned again at once.
void Planner::give_up_broken_promises(Decisions& out) {
  for (RobotRecord& r : robots_) {
    if (!r.committed || !r.committed->on_promise || r.committed->phase == Commitment::Phase::held || r.committed->endangered) continue;
    Commitment& c = *r.committed;
    const auto broken = std::find_if(c.departures.begin(), c.departures.end(), [&](const auto& departure) {
      const auto& [robot, serial] = departure;
      const bool left = robots_[robot].last_started >= serial;
      return !left && (robots_[robot].lost() || departure_of(robot, serial, false) == Departures::broken);
    });
    if (broken == c.departures.end()) continue;
    c.endangered = true;
    model::CommandStatus& status = c.command.status;
    if (c.phase == Commitment::Phase::dispatched) {
      const bool said = std::any_of(out.withdrawals.begin(), out.withdrawals.end(), [&](const auto& w) { return w.id == status.id; });
      if (!said) out.withdrawals.push_back({status.id, r.robot->name, c.command.attempts});
      continue;
    }
    const auto& other = robots_[broken->first].robot->name.str();
    status.reason = model::Reason::blocked;
    status.text = fmt::format("{} is under way to where {} was to have left from, and {} does not leave as promised: they may collide",
                              r.robot->name.str(), other, other);
    publish(status, out);
  }
}

}  // namespace interlace::core
