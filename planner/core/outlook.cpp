#include "planner/core/outlook.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "planner/core/admission.hpp"
#include "planner/core/escape_goal.hpp"

namespace interlace::core {

using model::EscapeWay;
using model::RobotIndex;

namespace {

constexpr double kSamePlace = 1e-9;         // [rad]
constexpr double kBeyond = 1e-3;            // [m] a detour goes on after the last place that is in the way
constexpr double kSameTime = 1e-6;          // [s]
constexpr std::size_t kDetours = 3;         // of one robot for one command
constexpr std::size_t kSameKept = 8;        // nodes of a beam in which all robots are at the same places
constexpr std::size_t kMotionsKept = 2048;  // of whose pairs the intervals are kept

// Work: 1 is a look at the intervals of one pair, about 30 ns on a machine of 2020.
constexpr std::size_t kMapWork = 6000;
constexpr std::size_t kAdmitWork = 6000;
constexpr std::size_t kReachWork = 50'000;
constexpr std::size_t kStopWork = 10;

bool same_place(const model::Joints& a, const model::Joints& b) {
  return (a - b).cwiseAbs().maxCoeff() <= kSamePlace;
}

Duration duration_of(const SampledMotionPtr& motion) {
  return model::from_seconds(motion->motion().duration());
}

/// Local time from which on a robot that carries out the moving motion of `map` could stop and be clear, the earliest.
std::optional<double> first_clear(const TimingMap& map) {
  std::vector<std::pair<double, double>> blocked;
  for (const BlockedCell& c : map.blocked) blocked.emplace_back(c.t0, c.t1);
  std::sort(blocked.begin(), blocked.end());
  double clear = 0;
  for (const auto& [from, until] : blocked) {
    if (from > clear) break;
    clear = std::max(clear, until);
  }
  return clear > map.moving_duration ? std::nullopt : std::optional{clear};
}

}  // namespace

Outlook::Outlook(const model::Cell& cell, Neighbourhood neighbourhood)
    : cell_(cell), neighbourhood_(std::move(neighbourhood)), postures_(cell.robots.size()) {}

std::uint64_t Outlook::look(std::vector<OutlookRobot> robots, const Timing& timing, Duration lead, MapStore& maps) {
  robots_ = std::move(robots);
  timing_ = timing;
  lead_ = lead;
  maps_ = &maps;
  if (forbidden_.size() > kMotionsKept) forbidden_.clear();
  for (auto& of_robot : postures_) {
    if (of_robot.size() > kMotionsKept) of_robot.clear();
  }
  forbidden_now_.assign(robots_.size(), {});
  places_.clear();
  roots_.clear();
  next_beam_ = 0;
  settled_.reset();
  for (RobotIndex i = 0; i < robots_.size(); ++i) {
    const OutlookRobot& r = robots_[i];
    const model::MotionRequest* back = r.back ? &*r.back : nullptr;
    const SampledMotion& last = *r.seen.back().motion;
    roots_.push_back(place_at(i, last.motion().to(), *last.bodies().after, 0, back, false));
    if (r.seen.back().committed && roots_.back()) roots_.back()->back = undoing(r.seen.back().motion->motion());
  }
  return ++looks_;
}

SampledMotionPtr Outlook::admitted(RobotIndex robot, const model::MotionBodies& bodies, const model::Joints& from,
                                   const model::MotionRequest& request) {
  work_ += kAdmitWork;
  auto motion = admit(cell_, robot, bodies, from, request);
  return motion ? *motion : nullptr;
}

Outlook::Posture* Outlook::posture_at(RobotIndex robot, const model::Joints& q, const model::Robot& body) {
  auto& known = postures_[robot];
  const auto found = std::find_if(known.begin(), known.end(), [&](const Posture& p) { return p.body == &body && same_place(p.q, q); });
  if (found != known.end()) return &*found;
  Posture& fresh = known.emplace_back();
  fresh.q = q;
  fresh.body = &body;
  return &fresh;
}

/// Where `robot` stands at `q` with `done` of its commands done; null when its next one is not possible from there.
Outlook::Place* Outlook::place_at(RobotIndex robot, const model::Joints& q, const model::Robot& body, std::size_t done,
                                  const model::MotionRequest* back, bool aside) {
  const auto& queue = robots_[robot].queue;
  Place place;
  place.posture = posture_at(robot, q, body);
  place.aside = aside;
  place.done = done;
  if (back != nullptr) place.back = *back;
  if (done < queue.size()) {
    const WaitingMotion& command = queue[done];
    if (same_place(command.motion->motion().from(), q)) {
      place.next = command.motion;
    } else {
      auto [entry, fresh] = place.posture->from_here.try_emplace(command.motion->id());
      if (fresh) {
        entry->second = admitted(robot, command.motion->bodies(), q, command.request);
        if (entry->second && !same_place(entry->second->motion().to(), command.motion->motion().to())) entry->second = nullptr;
      }
      if (!entry->second) return nullptr;
      place.next = entry->second;
    }
    place.rest = duration_of(place.next);
    for (std::size_t k = done + 1; k < queue.size(); ++k) place.rest += duration_of(queue[k].motion);
  }
  places_.push_back(std::move(place));
  return &places_.back();
}

Outlook::Place* Outlook::after_command(RobotIndex robot, Place& place) {
  if (!place.after) {
    const model::MotionRequest back = undoing(place.next->motion());
    place.after = place_at(robot, place.next->motion().to(), *place.next->bodies().after, place.done + 1, &back, false);
  }
  return place.after;
}

Outlook::Place* Outlook::after_detour(RobotIndex robot, Place& place, const Detour& detour) {
  auto [entry, fresh] = place.detours.try_emplace(detour.motion.get());
  if (fresh) entry->second = place_at(robot, detour.motion->motion().to(), *place.posture->body, place.done, nullptr, true);
  return entry->second;
}

Outlook::Forbidden Outlook::compute(RobotIndex robot, const SampledMotionPtr& motion, const Neighbour& other) {
  const Candidate candidate{robot, motion, robots_[robot].tolerance};
  std::vector<RobotIndex> departures;
  work_ += kMapWork;
  return united(forbidden_by(candidate, other, timing_, maps_->get(motion, other.motion), departures));
}

/// `motion` and what the other does, after the start of `moving`.
const Outlook::Pair& Outlook::pair(RobotIndex robot, const SampledMotionPtr& motion, RobotIndex other, const SampledMotionPtr& moving) {
  ++work_;
  auto [entry, fresh] = forbidden_[motion->id()].try_emplace(moving->id());
  if (fresh) {
    Neighbour n;
    n.robot = other;
    n.motion = moving;
    n.committed = true;
    n.start_until = n.start_from + robots_[other].tolerance;
    entry->second.forbidden = compute(robot, motion, n);
    const KeptMap& map = maps_->get(motion, moving);
    entry->second.map.map.moving_duration = map.map.moving_duration;
    entry->second.map.passing = map.passing;
    entry->second.map.at_end = map.at_end;
  }
  return entry->second;
}

const Outlook::Forbidden& Outlook::forbidden_now(RobotIndex robot, const SampledMotionPtr& motion, RobotIndex other) {
  ++work_;
  auto [entry, fresh] = forbidden_now_[other].try_emplace(motion->id());
  if (!fresh) return entry->second;
  const auto& seen = robots_[other].seen;
  if (timing_.promise && seen.size() == 2 && seen[0].started && !seen[0].lost) {
    const Pair& first = pair(robot, motion, other, seen[0].motion);
    const Pair& next = pair(robot, motion, other, seen[1].motion);
    const Stop stop{seen[0].start_from, seen[0].start_until, seen[1].start_from, seen[1].start_until};
    work_ += kStopWork;
    const Candidate candidate{robot, motion, robots_[robot].tolerance};
    entry->second = united(forbidden_by_stop(candidate, *seen[0].motion, stop, *timing_.promise, first.map, next.map).starts);
    return entry->second;
  }
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
    if (!stop) {
      for (const StartInterval& i : next.forbidden) all.push_back({shifted(i.from, s.start), shifted(i.until, s.start)});
      const bool stands = s.start > start && !next.forbidden.empty() && next.forbidden.front().from == model::kEarliest;
      if (stands) relies_from = model::kEarliest;
      continue;
    }
    start = std::max(start, stop->moving_until);
    const SampledMotionPtr& first = s.before != nullptr ? *s.before : robots_[other].seen.back().motion;
    const Pair& before = pair(robot, motion, other, first);
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
  const Forbidden& intervals = s.moving ? forbidden(robot, motion, blocker, *s.moving) : forbidden_now(robot, motion, blocker);
  return !intervals.empty() && intervals.back().until == model::kForever;
}

const std::vector<Outlook::Way>& Outlook::ways_of(RobotIndex robot, Place& place) {
  auto& ways = place.posture->ways;
  if (ways) return *ways;
  ways.emplace();
  const model::Joints& q = place.posture->q;
  const model::Robot& body = *place.posture->body;
  const auto unchanged = model::MotionBodies::unchanged(body);
  const auto add = [&](EscapeWay way, const model::MotionRequest& request) {
    auto motion = admitted(robot, unchanged, q, request);
    if (motion && motion->motion().duration() > 0) ways->push_back({way, request, std::move(motion)});
  };
  const model::Robot& r = cell_.robots[robot];
  if (place.back) add(EscapeWay::retreat, *place.back);
  model::MotionRequest home;
  home.target = model::LinearTarget{r.X_WB * model::tcp_pose(r.model, r.home)};
  add(EscapeWay::home, home);
  if (r.model.joints.velocity && r.model.joints.acceleration) {
    home.target = model::JointTarget{r.home};
    add(EscapeWay::home, home);
  }
  const std::array<std::pair<EscapeWay, Vector3>, 6> directions{{{EscapeWay::plus_x, Vector3::UnitX()},
                                                                 {EscapeWay::minus_x, -Vector3::UnitX()},
                                                                 {EscapeWay::plus_y, Vector3::UnitY()},
                                                                 {EscapeWay::minus_y, -Vector3::UnitY()},
                                                                 {EscapeWay::plus_z, Vector3::UnitZ()},
                                                                 {EscapeWay::minus_z, -Vector3::UnitZ()}}};
  for (const auto& [way, unit] : directions) {
    work_ += kReachWork;
    auto full = to_reachable_goal(cell_, robot, body, q, unit);
    if (full.motion) ways->push_back({way, full.request, std::move(full.motion)});
  }
  return *ways;
}

/// Ways for `robot` from where it stands to the first place clear of all that `served` sweeps, the shortest first.
const std::vector<Detour>& Outlook::detours_of(RobotIndex robot, Place& place, const SampledMotionPtr& served) {
  auto [entry, fresh] = place.posture->detours.try_emplace(served->id());
  if (!fresh) return entry->second;
  std::vector<Detour>& detours = entry->second;
  for (const Way& way : ways_of(robot, place)) {
    work_ += kMapWork;
    const auto clear = first_clear(maps_->get(served, way.full).map);
    if (!clear) continue;
    const model::Motion& full = way.full->motion();
    const double whole = full.length(full.duration());
    const double length = full.length(*clear) + kBeyond;
    Detour d{way.way, way.request, way.full};
    if (full.is_linear() && length < whole - kBeyond) {
      d.request = shortened(full, length);
      d.motion = admitted(robot, model::MotionBodies::unchanged(*place.posture->body), place.posture->q, d.request);
    }
    if (d.motion) detours.push_back(std::move(d));
  }
  std::stable_sort(detours.begin(), detours.end(),
                   [](const Detour& a, const Detour& b) { return duration_of(a.motion) < duration_of(b.motion); });
  if (detours.size() > kDetours) detours.resize(kDetours);
  return detours;
}

bool Outlook::complete(std::size_t node) const {
  for (RobotIndex i = 0; i < robots_.size(); ++i) {
    if (state(node, i).place->next) return false;
  }
  return true;
}

/// `motion` must stay where it is.
std::size_t Outlook::add(std::size_t parent, Action action, const SampledMotionPtr& motion, Place* to) {
  const std::size_t n = robots_.size();
  const std::size_t index = nodes_.size();
  Node node;
  node.parent = parent;
  node.last = std::max(nodes_[parent].last, action.start);
  const Instant end = action.start + robots_[action.robot].tolerance + duration_of(motion);
  node.end = std::max(nodes_[parent].end, end);
  node.flow = nodes_[parent].flow;
  node.detours = nodes_[parent].detours;
  if (action.detour.motion) {
    ++node.detours;
  } else {
    node.flow += end - timing_.earliest;
  }
  states_.resize((index + 1) * n);
  std::copy_n(states_.begin() + static_cast<std::ptrdiff_t>(parent * n), n, states_.begin() + static_cast<std::ptrdiff_t>(index * n));
  RobotState& s = states_[index * n + action.robot];
  s.before = s.moving;
  s.before_start = s.start;
  s.moving = &motion;
  s.start = action.start;
  s.free = end + lead_;
  s.place = to;
  node.action = std::move(action);
  nodes_.push_back(std::move(node));
  return index;
}

/// Everything that can start next: commands, and where somebody is stuck, detours of those in his way.
void Outlook::expand(std::size_t parent, std::size_t most_detours, std::vector<std::size_t>& commands, std::vector<std::size_t>& detours) {
  const auto n = static_cast<RobotIndex>(robots_.size());
  enum class Will : std::uint8_t { idle, go, wait };
  std::vector<Will> will(n, Will::idle);
  for (RobotIndex i = 0; i < n; ++i) {
    const RobotState s = state(parent, i);
    if (!s.place->next) continue;
    const auto start = start_of(parent, i, s.place->next);
    will[i] = start ? Will::go : Will::wait;
    if (!start) continue;
    if (Place* to = after_command(i, *s.place)) commands.push_back(add(parent, {i, {}, i, *start}, s.place->next, to));
  }
  if (nodes_[parent].detours >= most_detours) return;
  // Who waits for those that will go is not stuck.
  const auto blocked_by = [&](RobotIndex i, RobotIndex j) { return blocks_for_good(parent, j, i, state(parent, i).place->next); };
  for (bool changed = true; changed;) {
    changed = false;
    for (RobotIndex i = 0; i < n; ++i) {
      if (will[i] != Will::wait) continue;
      const auto& around = neighbourhood_.of(i);
      const bool served = std::all_of(around.begin(), around.end(), [&](RobotIndex j) { return will[j] == Will::go || !blocked_by(i, j); });
      if (!served) continue;
      will[i] = Will::go;
      changed = true;
    }
  }
  for (RobotIndex i = 0; i < n; ++i) {
    if (will[i] != Will::wait) continue;
    const SampledMotionPtr& waiting = state(parent, i).place->next;
    for (const RobotIndex j : neighbourhood_.of(i)) {
      if (will[j] == Will::go || !blocked_by(i, j)) continue;
      const RobotState s = state(parent, j);
      if (s.place->aside || robots_[j].seen.back().lost) continue;
      for (const Detour& d : detours_of(j, *s.place, waiting)) {
        if (work_ > budget_) return;
        const auto start = earliest(parent, j, d.motion, std::max(nodes_[parent].last, s.free));
        if (!start) continue;
        const Forbidden& after = forbidden(i, waiting, j, d.motion);
        if (!after.empty() && after.back().until == model::kForever) continue;
        if (Place* to = after_detour(j, *s.place, d)) detours.push_back(add(parent, {j, d, i, *start}, d.motion, to));
      }
    }
  }
}

OutlookPlan Outlook::plan_to(std::size_t node) const {
  OutlookPlan plan;
  plan.end = nodes_[node].end;
  plan.flow = nodes_[node].flow;
  for (std::size_t k = node; k != 0; k = nodes_[k].parent) {
    const Action& a = nodes_[k].action;
    PlannedStart s;
    s.robot = a.robot;
    s.serves = a.serves;
    s.start = a.start;
    if (a.detour.motion) s.detour = a.detour;
    plan.starts.push_back(std::move(s));
  }
  std::reverse(plan.starts.begin(), plan.starts.end());
  return plan;
}

Outlook::Beam Outlook::beam(std::size_t index) {
  static constexpr std::array<Beam, kBeams> kAll{{{8, 0.3, 0},
                                                  {64, 0.3, 0},
                                                  {64, 1.0, 0},
                                                  {512, 0.3, 0},
                                                  {64, 0.3, 1},
                                                  {512, 1.0, 0},
                                                  {64, 0.3, 3},
                                                  {4096, 0.3, 0},
                                                  {512, 0.3, 1},
                                                  {512, 0.3, 4},
                                                  {4096, 0.3, 1},
                                                  {4096, 0.3, 4}}};
  return kAll.at(index);
}

/// The present as the first node; false when there is no saying from where a robot goes on.
bool Outlook::begin() {
  nodes_.assign(1, {});
  nodes_[0].last = timing_.earliest;
  nodes_[0].end = timing_.earliest;
  states_.assign(robots_.size(), {});
  for (RobotIndex i = 0; i < robots_.size(); ++i) {
    if (!roots_[i]) return false;
    states_[i].place = roots_[i];
    states_[i].free = robots_[i].free;
    if (robots_[i].seen.back().committed) nodes_[0].end = std::max(nodes_[0].end, robots_[i].free - lead_);
  }
  return true;
}

std::optional<OutlookPlan> Outlook::follow(const OutlookPlan& plan) {
  if (!begin()) return std::nullopt;
  budget_ = std::numeric_limits<std::size_t>::max();
  std::size_t node = 0;
  for (const PlannedStart& p : plan.starts) {
    const RobotState s = state(node, p.robot);
    const SampledMotionPtr* motion = p.detour ? kept(*s.place->posture, *p.detour) : &s.place->next;
    if (motion == nullptr || !*motion) return std::nullopt;
    const auto start = start_of(node, p.robot, *motion);
    Place* to = p.detour ? after_detour(p.robot, *s.place, *p.detour) : after_command(p.robot, *s.place);
    if (!start || !to) return std::nullopt;
    node = add(node, {p.robot, p.detour.value_or(Detour{}), p.serves, *start}, *motion, to);
  }
  std::vector<std::size_t> commands, detours;
  while (!complete(node)) {  // what has come since goes as early as it can
    commands.clear();
    detours.clear();
    expand(node, 1, commands, detours);
    if (commands.empty()) commands.swap(detours);
    if (commands.empty()) return std::nullopt;
    node = *std::min_element(commands.begin(), commands.end(), [&](auto a, auto b) { return nodes_[a].last < nodes_[b].last; });
  }
  return plan_to(node);
}

/// The motion of a detour where it stays, to be pointed at; null when it does not start here.
const SampledMotionPtr* Outlook::kept(Posture& posture, const Detour& detour) {
  if (!same_place(posture.q, detour.motion->motion().from())) return nullptr;
  const auto found = std::find(posture.followed.begin(), posture.followed.end(), detour.motion);
  if (found != posture.followed.end()) return &*found;
  posture.followed.push_back(detour.motion);
  return &posture.followed.back();
}

std::optional<OutlookPlan> Outlook::search(const std::optional<Instant>& no_later, const OutlookPlan* best, std::size_t budget,
                                           MapStore& maps) {
  maps_ = &maps;
  work_ = 0;
  budget_ = budget;
  std::optional<OutlookPlan> found;
  for (; !exhausted(); ++next_beam_) {
    const Beam next = beam(next_beam_);
    if (settled_ && next.detours <= *settled_) continue;
    auto plan = run(next, no_later, found ? &*found : best);
    if (work_ > budget_) break;
    if (plan) found = std::move(plan);
  }
  return found;
}

std::optional<OutlookPlan> Outlook::run(const Beam& beam, std::optional<Instant> no_later, const OutlookPlan* best) {
  const std::size_t n = robots_.size();
  if (!begin()) return std::nullopt;
  if (best != nullptr) no_later = no_later ? std::min(*no_later, best->end) : best->end;
  std::vector<std::size_t> layer{0}, next, commands, detours;
  std::optional<std::size_t> best_node;
  bool cut = false;
  while (!layer.empty() && !best_node) {
    next.clear();
    for (std::size_t k = 0; k < layer.size(); ++k) {
      if (work_ > budget_) return std::nullopt;
      commands.clear();
      detours.clear();
      expand(layer[k], beam.detours, commands, detours);
      next.insert(next.end(), commands.begin(), commands.end());
      layer.insert(layer.end(), detours.begin(), detours.end());
    }
    const auto judge = [&](std::size_t k) {
      double most = 0, sum = 0;
      for (RobotIndex i = 0; i < n; ++i) {
        const RobotState& s = state(k, i);
        const double end = model::to_seconds(s.free - lead_ + s.place->rest);
        most = std::max(most, end);
        sum += end;
      }
      Node& node = nodes_[k];
      node.score = most + beam.mean * sum / static_cast<double>(n);
      return !no_later || most <= model::to_seconds(*no_later) + kSameTime;
    };
    next.erase(std::remove_if(next.begin(), next.end(), [&](std::size_t k) { return !judge(k); }), next.end());
    std::stable_sort(next.begin(), next.end(), [&](std::size_t a, std::size_t b) { return nodes_[a].score < nodes_[b].score; });
    layer.clear();
    std::map<std::vector<const Place*>, std::size_t> same;
    std::vector<const Place*> places(n);
    for (const std::size_t k : next) {
      if (complete(k)) {
        const bool better = !best_node || nodes_[k].end < nodes_[*best_node].end ||
                            (nodes_[k].end == nodes_[*best_node].end && nodes_[k].flow < nodes_[*best_node].flow);
        if (better) best_node = k;
        continue;
      }
      if (layer.size() >= beam.width) {
        cut = true;
        continue;
      }
      for (RobotIndex i = 0; i < n; ++i) places[i] = state(k, i).place;
      if (++same[places] <= kSameKept) {
        layer.push_back(k);
      } else {
        cut = true;
      }
    }
  }
  if (!cut) settled_ = beam.detours;
  if (!best_node) return std::nullopt;
  OutlookPlan plan = plan_to(*best_node);
  if (best != nullptr && !plan.better_than(*best)) return std::nullopt;
  return plan;
}

}  // namespace interlace::core
