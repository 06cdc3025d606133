#include "planner/core/strategy.hpp"

#include <algorithm>

#include "planner/core/eef_map.hpp"
#include "planner/core/explain.hpp"
#include "planner/core/reach.hpp"
#include "planner/core/zone.hpp"

namespace interlace::core {

namespace {

/// Everything starts as soon as its robot is free: the dissertation's "without method".
class Direct final : public Strategy {
 public:
  [[nodiscard]] std::string_view name() const override { return "direct"; }
  [[nodiscard]] Assessment assess(const Candidate&, const std::vector<Neighbour>&, const Timing& timing, MapStore&,
                                  Evidence) const override {
    Assessment a;
    a.windows = {{timing.earliest, model::kForever}};
    a.start = timing.earliest;
    return a;
  }
};

/// The earliest start that is clear of everything committed, for whole bodies and any number of robots.
class Event : public Strategy {
 public:
  [[nodiscard]] std::string_view name() const override { return "event"; }
  [[nodiscard]] Service service() const override {
    Service s;
    s.escapes = true;
    s.maps = true;
    return s;
  }

  [[nodiscard]] Assessment assess(const Candidate& candidate, const std::vector<Neighbour>& neighbours, const Timing& timing,
                                  MapStore& maps, Evidence evidence) const override {
    Assessment a;
    std::vector<StartInterval> all;
    bool lost = false;
    std::vector<std::pair<model::RobotIndex, Instant>> stops;
    for (std::size_t i = 0; i < neighbours.size(); ++i) {
      const Neighbour& n = neighbours[i];
      lost = lost || n.lost;
      bool for_good = false;
      const auto add = [&](const std::vector<StartInterval>& forbidden) {
        for (const StartInterval& f : forbidden) {
          all.push_back(f);
          for_good = for_good || f.until == model::kForever;
        }
      };
      if (timing.promise && i + 1 < neighbours.size() && stops_between(n, neighbours[i + 1])) {
        const Neighbour& next = neighbours[++i];
        const Stop stop{n.start_from, n.start_until, next.start_from, next.start_until};
        const auto first_map = maps.share(candidate.motion, n.motion);
        const auto f = forbidden_by_stop(candidate, *n.motion, stop, *timing.promise, *first_map, maps.get(candidate.motion, next.motion));
        add(f.starts);
        stops.emplace_back(n.robot, f.relies_from);
      } else {
        add(forbidden(candidate, n, timing, maps, a));
      }
      if (for_good) a.blockers.push_back(n.robot);
    }
    a.windows = complement(united(std::move(all)), timing.earliest);
    if (!a.windows.empty()) a.start = a.windows.front().from;
    for (const auto& [robot, relies_from] : stops) {
      if (a.start && *a.start > relies_from) a.departures.push_back(robot);
    }
    if (!a.start) {
      a.reason = lost ? model::Reason::robot_unknown : model::Reason::blocked;
    } else if (*a.start > timing.earliest) {
      a.reason = model::Reason::delayed;
    }
    if (evidence == Evidence::yes) explain(candidate, neighbours, timing, maps, a);
    return a;
  }

 private:
  static bool stops_between(const Neighbour& n, const Neighbour& next) {
    return n.robot == next.robot && n.started && !n.lost && !n.overdue && !next.overdue;
  }

  static std::vector<StartInterval> forbidden(const Candidate& candidate, const Neighbour& n, const Timing& timing, MapStore& maps,
                                              Assessment& a) {
    if (!n.lost) return forbidden_by(candidate, n, timing, maps.get(candidate.motion, n.motion), a.departures);
    if (!enters_reach(*candidate.motion, n.reach)) return {};
    return {{model::kEarliest, model::kForever}};
  }

  static void explain(const Candidate& candidate, const std::vector<Neighbour>& neighbours, const Timing& timing, MapStore& maps,
                      Assessment& a) {
    const StartInterval span{timing.earliest, a.start.value_or(model::kForever)};
    for (const Neighbour& n : neighbours) {
      if (n.lost) {
        if (enters_reach(*candidate.motion, n.reach)) a.conflicts.push_back(lost_conflict(candidate, n, timing.earliest));
        continue;
      }
      const TimingMap& map = maps.get(candidate.motion, n.motion).map;
      if (map.blocked.empty()) continue;
      std::vector<model::RobotIndex> known;  // as departures already
      const auto by_cell = forbidden_by_map(candidate, n, timing, map, known);
      if (auto conflict = explain_conflict(candidate, n, map, by_cell, span)) a.conflicts.push_back(std::move(*conflict));
    }
  }
};

/// Starts like `event`, in the order of a plan for all that waits.
class Lookahead final : public Event {
 public:
  [[nodiscard]] std::string_view name() const override { return "lookahead"; }
  [[nodiscard]] Service service() const override {
    Service s = Event::service();
    s.ahead = true;
    return s;
  }
};

/// The dissertation as written: one commanded robot at a time in the order of the cell, escapes in six directions, and only when all stand.
class Acm final : public Event {
 public:
  [[nodiscard]] std::string_view name() const override { return "acm"; }
  [[nodiscard]] Service service() const override {
    Service s;
    s.in_turn = true;
    s.escapes = true;
    s.maps = true;
    s.rules.six_directions_only = true;
    s.rules.brake_after_area = true;
    s.rules.cascade = 1;
    s.rules.step_aside = false;
    s.rules.keep_next = false;
    return s;
  }
};

StartUncertainty uncertainty_of(const Candidate& candidate, const Neighbour& n) {
  StartUncertainty u;
  u.moving_from = n.start_from;
  u.moving_until = n.start_until;
  u.moving_stretch = n.motion->robot().controller.speed_error;
  u.commanded_stretch = candidate.motion->robot().controller.speed_error;
  u.commanded_tolerance = candidate.tolerance;
  return u;
}

/// The neighbour may yet fail to start. Where that would leave it in the way, its departure must be known before we leave.
bool may_stay(const Neighbour& n) {
  return n.committed && !n.started;
}

StartInterval until_it_has_left(const Neighbour& n, const Timing& timing) {
  if (n.overdue) return {model::kEarliest, model::kForever};
  return {model::kEarliest, timing.promise ? n.start_until - *timing.promise : n.start_until + timing.confirm};
}

}  // namespace

std::vector<StartInterval> forbidden_by(const Candidate& candidate, const Neighbour& n, const Timing& timing, const KeptMap& kept,
                                        std::vector<model::RobotIndex>& departures) {
  const StartUncertainty u = uncertainty_of(candidate, n);
  std::vector<StartInterval> forbidden;
  forbidden.reserve(kept.forbidden.size() + 1);
  for (const ForbiddenShift& shift : kept.forbidden) forbidden.push_back(forbidden_start(shift, u));
  if (may_stay(n) && kept.blocked_before_start) {
    departures.push_back(n.robot);
    forbidden.push_back(until_it_has_left(n, timing));
  }
  return forbidden;
}

ForbiddenByStop forbidden_by_stop(const Candidate& commanded, const SampledMotion& first, const Stop& stop, Duration promise,
                                  const KeptMap& first_map, const KeptMap& next_map) {
  ForbiddenByStop result;
  StartUncertainty u;
  u.commanded_tolerance = commanded.tolerance;
  u.moving_from = stop.moving_from;
  u.moving_until = stop.moving_until;
  for (const ForbiddenShift& shift : first_map.passing) result.starts.push_back(forbidden_start(shift, u));
  const double arrival = first.motion().duration() * (1 - first.robot().controller.speed_error);
  for (const ForbiddenShift& there : first_map.at_end) {
    const Instant from = forbidden_start({arrival - there.last, 0}, u).from;
    result.starts.push_back({from, stop.leaves_until - model::from_seconds(there.first) + Duration{1}});
    result.relies_from = std::min(result.relies_from, from);
  }
  if (result.relies_from < stop.leaves_until - promise) result.starts.push_back({result.relies_from, stop.leaves_until - promise});
  u.moving_from = stop.leaves_from;
  u.moving_until = stop.leaves_until;
  for (const ForbiddenShift& shift : next_map.passing) result.starts.push_back(forbidden_start(shift, u));
  const double next_arrival = next_map.map.moving_duration * (1 - first.robot().controller.speed_error);
  for (const ForbiddenShift& there : next_map.at_end)
    result.starts.push_back({forbidden_start({next_arrival - there.last, 0}, u).from, model::kForever});
  return result;
}

std::vector<ForbiddenStart> forbidden_by_map(const Candidate& candidate, const Neighbour& n, const Timing& timing, const TimingMap& map,
                                             std::vector<model::RobotIndex>& departures) {
  auto forbidden = forbidden_starts(map, uncertainty_of(candidate, n));
  if (!may_stay(n)) return forbidden;
  const auto in_the_way = std::find_if(map.blocked.begin(), map.blocked.end(), [](const BlockedCell& c) { return c.t0 == -kNever; });
  if (in_the_way != map.blocked.end()) {
    departures.push_back(n.robot);
    forbidden.push_back({until_it_has_left(n, timing), static_cast<std::size_t>(in_the_way - map.blocked.begin())});
  }
  return forbidden;
}

const std::vector<std::string_view>& strategy_names() {
  static const std::vector<std::string_view> names{"direct", "zone", "eef-map", "acm", "event", "lookahead"};
  return names;
}

bool is_strategy(std::string_view name) {
  const auto& names = strategy_names();
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::unique_ptr<Strategy> make_strategy(std::string_view name, const model::Cell& cell) {
  if (name == "direct") return std::make_unique<Direct>();
  if (name == "acm") return std::make_unique<Acm>();
  if (name == "event") return std::make_unique<Event>();
  if (name == "lookahead") return std::make_unique<Lookahead>();
  if (name == "zone") return std::make_unique<Zone>(cell);
  if (name == "eef-map") return std::make_unique<EefMap>(cell);
  return nullptr;
}

}  // namespace interlace::core
