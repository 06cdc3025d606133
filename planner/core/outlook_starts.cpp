// When a robot may start, with everybody else doing what is planned so far.
#include "planner/core/outlook.hpp"

#include <algorithm>

#include "planner/core/outlook_work.hpp"

namespace interlace::core {

using model::RobotIndex;

namespace {

constexpr int kCoarser = 2;  // where a detour could end: a few millimetres more cost less than to find out that they are not needed

}  // namespace

/// Counts the same whether it is there already or not.
const KeptMap& Outlook::map_of(const SampledMotionPtr& motion, const SampledMotionPtr& moving) {
  const KeptMap& map = maps_->get(motion, moving);
  map_work_ += kMapWork + kEvaluationWork * map.map.evaluations;
  return map;
}

/// Local time from which on a robot on its way could stop and be clear of all that `served` sweeps, the earliest.
std::optional<double> Outlook::first_clear(const SampledMotionPtr& served, const SampledMotionPtr& way) {
  const TimesInTheWay found = times_in_the_way(*served, *way, cell_.planning.margin, kCoarser);
  map_work_ += kMapWork + kEvaluationWork * found.evaluations;
  return found.first_clear(way->motion().duration());
}

Outlook::Forbidden Outlook::compute(RobotIndex robot, const SampledMotionPtr& motion, const Neighbour& other) {
  const Candidate candidate{robot, motion, robots_[robot].tolerance};
  std::vector<RobotIndex> departures;
  return united(forbidden_by(candidate, other, timing_, map_of(motion, other.motion), departures));
}

Outlook::Row& Outlook::row_of(const SampledMotionPtr& motion) {
  if (last_row_ != nullptr && last_row_id_ == motion->id()) return *last_row_;  // mostly one motion is held against one after the other
  last_row_id_ = motion->id();
  last_row_ = &forbidden_[motion->id()];
  if (last_row_->with.empty()) last_row_->motion = motion;
  return *last_row_;
}

/// `motion` and what the other does, after the start of `moving`.
const Outlook::Pair& Outlook::pair(RobotIndex robot, const SampledMotionPtr& motion, RobotIndex other, const SampledMotionPtr& moving) {
  ++work_;
  Row& row = row_of(motion);
  if (const auto known = row.with.find(moving->id()); known != row.with.end()) return known->second;
  if (may_find_out()) return row.with.emplace(moving->id(), make_pair(robot, motion, other, moving)).first->second;
  static const Pair unknown{{{model::kEarliest, model::kForever}}, {}, true};
  if (wished_.insert({motion->id(), moving.get()}).second) wish(PairWish{robot, other, motion, moving, std::nullopt});
  return unknown;
}

Outlook::Pair Outlook::make_pair(RobotIndex robot, const SampledMotionPtr& motion, RobotIndex other, const SampledMotionPtr& moving) {
  Neighbour n;
  n.robot = other;
  n.motion = moving;
  n.committed = true;
  n.start_until = n.start_from + robots_[other].tolerance;
  Pair pair;
  pair.forbidden = compute(robot, motion, n);
  const KeptMap& map = maps_->get(motion, moving);
  pair.map.map.moving_duration = map.map.moving_duration;
  pair.map.passing = map.passing;
  pair.map.at_end = map.at_end;
  return pair;
}

const Outlook::Forbidden& Outlook::forbidden_now(RobotIndex robot, const SampledMotionPtr& motion, RobotIndex other) {
  ++work_;
  auto& known = forbidden_now_[other];
  auto entry = known.find(motion->id());
  if (entry != known.end()) return entry->second;
  const auto& seen = robots_[other].seen;
  if (timing_.promise && seen.size() == 2 && seen[0].started && !seen[0].lost) {
    const Pair& first = pair(robot, motion, other, seen[0].motion);
    const Pair& next = pair(robot, motion, other, seen[1].motion);
    if (first.unknown) return first.forbidden;
    if (next.unknown) return next.forbidden;
    entry = known.try_emplace(motion->id()).first;
    const Stop stop{seen[0].start_from, seen[0].start_until, seen[1].start_from, seen[1].start_until};
    work_ += kStopWork;
    const Candidate candidate{robot, motion, robots_[robot].tolerance};
    entry->second = united(forbidden_by_stop(candidate, *seen[0].motion, stop, *timing_.promise, first.map, next.map).starts);
    return entry->second;
  }
  entry = known.try_emplace(motion->id()).first;
  for (const Neighbour& n : seen) {
    for (const StartInterval& i : compute(robot, motion, n)) entry->second.push_back(i);
  }
  entry->second = united(std::move(entry->second));
  return entry->second;
}

namespace {

Instant shifted(Instant t, Instant start) {
  return t == model::kEarliest || t == model::kForever ? t : t + start.time_since_epoch();
}

}  // namespace

/// When `robot` may make `motion` at `node`: not before any start that is planned already, but where it relies on one of them.
std::optional<Instant> Outlook::start_of(std::size_t node, RobotIndex robot, const SampledMotionPtr& motion) {
  if (timing_.promise && state(node, robot).free < nodes_[node].last) {
    if (const auto start = relying(node, robot, motion)) return start;
  }
  return earliest(node, robot, motion, std::max(nodes_[node].last, state(node, robot).free));
}

/// Where a robot stands between its last start and the one before.
std::optional<Stop> Outlook::stop_of(RobotIndex robot, const RobotState& s) const {
  const Instant leaves_until = s.start + robots_[robot].tolerance;
  if (s.before != nullptr) return Stop{s.before_start, s.before_start + robots_[robot].tolerance, s.start, leaves_until};
  const Neighbour& n = robots_[robot].seen.back();
  if (!n.committed || n.lost || n.overdue) return std::nullopt;  // it stands: what its motion says of the time before it is enough
  return Stop{n.start_from, n.start_until, s.start, leaves_until};
}

/// Earliest start before the last one that is planned, if it relies on a departure that is.
std::optional<Instant> Outlook::relying(std::size_t node, RobotIndex robot, const SampledMotionPtr& motion) {
  const Instant last = nodes_[node].last;
  Instant start = std::max(state(node, robot).free, last - *timing_.promise);
  std::vector<StartInterval> all;
  Instant relies_from = model::kForever;
  for (const RobotIndex other : neighbourhood_.of(robot)) {
    const RobotState& s = state(node, other);
    if (s.moving == nullptr) {
      const Forbidden& intervals = forbidden_now(robot, motion, other);
      all.insert(all.end(), intervals.begin(), intervals.end());
      continue;
    }
    const auto stop = s.start <= start ? std::nullopt : stop_of(other, s);
    const Pair& next = pair(robot, motion, other, *s.moving);
    if (next.unknown) return std::nullopt;
    if (!stop) {
      for (const StartInterval& i : next.forbidden) all.push_back({shifted(i.from, s.start), shifted(i.until, s.start)});
      const bool stands = s.start > start && !next.forbidden.empty() && next.forbidden.front().from == model::kEarliest;
      if (stands) relies_from = model::kEarliest;
      continue;
    }
    start = std::max(start, stop->moving_until);
    const SampledMotionPtr& first = s.before != nullptr ? *s.before : robots_[other].seen.back().motion;
    const Pair& before = pair(robot, motion, other, first);
    if (before.unknown) return std::nullopt;
    work_ += kStopWork;
    auto f = forbidden_by_stop({robot, motion, robots_[robot].tolerance}, *first, *stop, *timing_.promise, before.map, next.map);
    all.insert(all.end(), f.starts.begin(), f.starts.end());
    relies_from = std::min(relies_from, f.relies_from);
  }
  if (relies_from >= last) return std::nullopt;
  for (const StartInterval& i : united(std::move(all))) {
    if (i.from > start) break;
    if (i.until <= start) continue;
    if (i.until == model::kForever) return std::nullopt;
    start = i.until;
  }
  if (start >= last || start <= relies_from) return std::nullopt;
  return start;
}

/// Earliest start of `motion` not before `from`, with everybody else as at `node`.
std::optional<Instant> Outlook::earliest(std::size_t node, RobotIndex robot, const SampledMotionPtr& motion, Instant from) {
  Instant start = from;
  for (bool moved = true; moved;) {
    moved = false;
    for (const RobotIndex other : neighbourhood_.of(robot)) {
      const RobotState& s = state(node, other);
      const Forbidden& intervals = s.moving ? forbidden(robot, motion, other, *s.moving) : forbidden_now(robot, motion, other);
      const Instant origin = s.moving ? s.start : Instant{};
      for (const StartInterval& i : intervals) {
        if (shifted(i.from, origin) > start) break;
        if (shifted(i.until, origin) <= start) continue;
        if (i.until == model::kForever) return std::nullopt;
        start = shifted(i.until, origin);
        moved = true;
      }
    }
  }
  return start;
}

bool Outlook::blocks_for_good(std::size_t node, RobotIndex blocker, RobotIndex robot, const SampledMotionPtr& motion) {
  const RobotState& s = state(node, blocker);
  if (s.moving && pair(robot, motion, blocker, *s.moving).unknown) return false;  // who knows
  const Forbidden& intervals = s.moving ? forbidden(robot, motion, blocker, *s.moving) : forbidden_now(robot, motion, blocker);
  return !intervals.empty() && intervals.back().until == model::kForever;
}

}  // namespace interlace::core
