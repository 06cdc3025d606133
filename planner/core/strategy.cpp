#include "planner/core/strategy.hpp"

#include <algorithm>

#include "planner/core/eef_map.hpp"
#include "planner/core/explain.hpp"
#include "planner/core/reach.hpp"
#include "planner/core/zone.hpp"

namespace interlace::core {

const TimingMap& MapStore::get(const SampledMotionPtr& commanded, const SampledMotionPtr& moving) {
  const auto key = std::make_pair(commanded->id(), moving->id());
  if (const auto found = maps_.find(key); found != maps_.end()) return found->second.map;
  if (maps_.size() >= tidy_at_) {
    forget_dead();
    tidy_at_ = std::max(kTidyAt, 2 * maps_.size());
  }
  ++builds_;
  const double before = stopwatch_ ? stopwatch_() : 0;
  TimingMap map = build_timing_map(*commanded, *moving, margin_);
  if (stopwatch_) build_times_.push_back(stopwatch_() - before);
  return maps_.emplace(key, Kept{commanded, moving, std::move(map)}).first->second.map;
}

void MapStore::forget_dead() {
  for (auto it = maps_.begin(); it != maps_.end();) {
    it = it->second.commanded.expired() || it->second.moving.expired() ? maps_.erase(it) : std::next(it);
  }
}

namespace {

/// Everything starts as soon as its robot is free: the dissertation's "without method".
class Direct final : public Strategy {
 public:
  [[nodiscard]] std::string_view name() const override { return "direct"; }
  [[nodiscard]] Assessment assess(const Candidate&, const std::vector<Neighbour>&, const Timing& timing, MapStore&) const override {
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
    return s;
  }

  [[nodiscard]] Assessment assess(const Candidate& candidate, const std::vector<Neighbour>& neighbours, const Timing& timing,
                                  MapStore& maps) const override {
    Assessment a;
    std::vector<StartInterval> all;
    std::vector<std::vector<ForbiddenStart>> by_neighbour;
    for (const Neighbour& n : neighbours) {
      by_neighbour.push_back(forbidden_by(candidate, n, timing, maps, a));
      bool for_good = false;
      for (const ForbiddenStart& f : by_neighbour.back()) {
        all.push_back(f.interval);
        for_good = for_good || f.interval.until == model::kForever;
      }
      if (for_good) a.blockers.push_back(n.robot);
    }
    a.windows = complement(united(std::move(all)), timing.earliest);
    if (!a.windows.empty()) a.start = a.windows.front().from;
    const Instant horizon = a.start.value_or(model::kForever);
    for (std::size_t i = 0; i < neighbours.size(); ++i) {
      if (neighbours[i].lost) {
        if (!by_neighbour[i].empty()) a.conflicts.push_back(lost_conflict(candidate, neighbours[i], timing.earliest));
        continue;
      }
      if (auto conflict = explain_conflict(candidate, neighbours[i], maps.get(candidate.motion, neighbours[i].motion), by_neighbour[i],
                                           {timing.earliest, horizon})) {
        a.conflicts.push_back(std::move(*conflict));
      }
    }
    const bool lost = std::any_of(neighbours.begin(), neighbours.end(), [](const Neighbour& n) { return n.lost; });
    if (!a.start) {
      a.reason = lost && !a.conflicts.empty() ? model::Reason::robot_unknown : model::Reason::blocked;
    } else if (*a.start > timing.earliest) {
      a.reason = model::Reason::delayed;
    }
    return a;
  }

 private:
  static std::vector<ForbiddenStart> forbidden_by(const Candidate& candidate, const Neighbour& n, const Timing& timing, MapStore& maps,
                                                  Assessment& a) {
    if (n.lost) {
      if (!enters_reach(*candidate.motion, n.motion->robot())) return {};
      return {{{model::kEarliest, model::kForever}, 0}};
    }
    return forbidden_by_map(candidate, n, timing, maps.get(candidate.motion, n.motion), a.departures);
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
    s.rules.six_directions_only = true;
    s.rules.brake_after_area = true;
    s.rules.cascade = 1;
    s.rules.step_aside = false;
    s.rules.keep_next = false;
    return s;
  }
};

}  // namespace

std::vector<ForbiddenStart> forbidden_by_map(const Candidate& candidate, const Neighbour& n, const Timing& timing, const TimingMap& map,
                                             std::vector<model::RobotIndex>& departures) {
  StartUncertainty u;
  u.moving_from = n.start_from;
  u.moving_until = n.start_until;
  u.moving_stretch = n.motion->robot().controller.speed_error;
  u.commanded_stretch = candidate.motion->robot().controller.speed_error;
  u.commanded_tolerance = candidate.tolerance;
  auto forbidden = forbidden_starts(map, u);
  if (n.committed && !n.started) {
    // The neighbour may yet fail to start. Where that would leave it in the way, its departure must be known before we leave.
    const auto in_the_way = std::find_if(map.blocked.begin(), map.blocked.end(), [](const BlockedCell& c) { return c.t0 == -kNever; });
    if (in_the_way != map.blocked.end()) {
      departures.push_back(n.robot);
      const Instant until = n.overdue ? model::kForever : n.start_until + timing.confirm;
      forbidden.push_back({{model::kEarliest, until}, static_cast<std::size_t>(in_the_way - map.blocked.begin())});
    }
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
