#include "planner/core/zone.hpp"

#include <algorithm>

#include "planner/core/explain.hpp"
#include "planner/core/reach.hpp"

namespace interlace::core {

namespace {

/// Two visits to the zone must not overlap: as a map with one blocked cell, so that tolerances, late starts and departures are treated as
/// those of collisions are.
TimingMap token_map(const ZoneVisit& own, const ZoneVisit& other) {
  TimingMap map;
  if (!own.enters || !other.enters) return map;
  BlockedCell both;
  both.tau0 = 0;  // the token is taken before the motion starts
  both.tau1 = own.to_end ? kNever : own.left;
  both.t0 = other.from_start ? -kNever : 0;
  both.t1 = other.to_end ? kNever : other.left;
  both.own_body = static_cast<std::uint16_t>(own.body);
  both.other_body = static_cast<std::uint16_t>(other.body);
  map.blocked.push_back(both);
  return map;
}

/// What one neighbour forbids, and why.
struct Objection {
  std::vector<ForbiddenStart> lost, token, bodies;

  void add_to(std::vector<StartInterval>& all) const {
    for (const auto* list : {&lost, &token, &bodies}) {
      for (const ForbiddenStart& f : *list) all.push_back(f.interval);
    }
  }
};

}  // namespace

Assessment Zone::assess(const Candidate& candidate, const std::vector<Neighbour>& neighbours, const Timing& timing, MapStore& maps,
                        Evidence evidence) const {
  Assessment a;
  const ZoneVisit own = zone_.visit(candidate.robot, *candidate.motion);
  std::vector<Objection> objections;
  std::vector<StartInterval> all;
  for (const Neighbour& n : neighbours) {
    Objection o;
    if (n.lost) {
      const bool may_hold_the_token = own.enters && zone_.within_reach_of(n.robot);
      if (may_hold_the_token || enters_reach(*candidate.motion, n.reach)) o.lost.push_back({{model::kEarliest, model::kForever}, 0});
    } else {
      if (own.enters) {
        const TimingMap token = token_map(own, zone_.visit(n.robot, *n.motion));
        o.token = forbidden_by_map(candidate, n, timing, token, a.departures);
      }
      o.bodies = forbidden_by_map(candidate, n, timing, maps.get(candidate.motion, n.motion).map, a.departures);
    }
    o.add_to(all);
    objections.push_back(std::move(o));
  }
  std::sort(a.departures.begin(), a.departures.end());
  a.departures.erase(std::unique(a.departures.begin(), a.departures.end()), a.departures.end());
  a.windows = complement(united(std::move(all)), timing.earliest);
  if (!a.windows.empty()) a.start = a.windows.front().from;

  const bool unknown = std::any_of(objections.begin(), objections.end(), [](const Objection& o) { return !o.lost.empty(); });
  if (!a.start) {
    a.reason = unknown ? model::Reason::robot_unknown : model::Reason::blocked;
  } else if (*a.start > timing.earliest) {
    a.reason = model::Reason::delayed;
  }
  if (evidence == Evidence::no) return a;

  const StartInterval span{timing.earliest, a.start.value_or(model::kForever)};
  for (std::size_t i = 0; i < neighbours.size(); ++i) {
    const Neighbour& n = neighbours[i];
    const Objection& o = objections[i];
    if (!o.lost.empty()) {
      a.conflicts.push_back(lost_conflict(candidate, n, timing.earliest));
      continue;
    }
    auto conflict = zone_conflict(candidate, own, n, o.token, span);
    auto bodies = explain_conflict(candidate, n, maps.get(candidate.motion, n.motion).map, o.bodies, span);
    if (!conflict || (bodies && bodies->until > conflict->until)) conflict = std::move(bodies);
    if (conflict) a.conflicts.push_back(std::move(*conflict));
  }
  return a;
}

}  // namespace interlace::core
