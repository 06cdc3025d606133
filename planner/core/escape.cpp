#include "planner/core/escape.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "planner/core/escape_goal.hpp"

namespace interlace::core {

using model::EscapeWay;
using model::RobotIndex;

namespace {

constexpr double kBeyond = 1e-3;     // [m] an escape goes on after the last place that is in the way
constexpr double kGrid = 1e-4;       // [m]: lengths nearer than this share one shortened motion
constexpr int kWaysPerSearch = 200;  // looked at before a search gives up: bounds the time of a decision
constexpr std::size_t kRefusalsKept = 16;

/// Path length over which the robot brakes at the end of a straight motion [m].
double braking_length(const model::Motion& motion) {
  const model::TcpLimits& tcp = motion.robot().tcp;
  return tcp.velocity * tcp.velocity / (2 * tcp.acceleration);
}

}  // namespace

EscapeSearch::EscapeSearch(const model::Cell& cell, const Neighbourhood& neighbourhood, std::vector<EscapeView> robots,
                           const Strategy& strategy, const Timing& timing, MapStore& maps)
    : cell_(cell),
      neighbourhood_(neighbourhood),
      robots_(std::move(robots)),
      strategy_(strategy),
      timing_(timing),
      maps_(maps),
      rules_(strategy.service().rules) {}

model::Result<EscapePlan, EscapeRefusals> EscapeSearch::make_room(const Candidate& candidate, const model::MotionRequest& request) {
  PlannedMotion served;
  served.robot = candidate.robot;
  served.request = request;
  served.motion = candidate.motion;
  served.tolerance = candidate.tolerance;
  const auto planned = [&] {
    EscapePlan plan;
    plan.served = std::move(plan_.back().assessment);
    plan_.pop_back();
    plan.escapes = std::move(plan_);
    return plan;
  };
  if (plainest([&] { return serve(served, 0, [] { return true; }); })) return planned();
  EscapeRefusals why = std::move(refusals_);
  if (rules_.step_aside && step_aside_and_serve(served)) return planned();
  return model::unexpected(std::move(why));
}

/// Calls `attempt` for plain searches first: no cascades, and the robots' own next commands still possible from where they go. Then for
/// less and less plain ones, until it succeeds.
bool EscapeSearch::plainest(const Attempt& attempt) {
  budget_ = kWaysPerSearch;
  EscapeRefusals first;
  for (deepest_ = 1; deepest_ <= rules_.cascade; ++deepest_) {
    for (keep_next_ = rules_.keep_next;; keep_next_ = false) {
      refusals_.clear();
      if (attempt()) return true;
      if (first.empty()) first = std::move(refusals_);
      if (!keep_next_) break;
    }
  }
  refusals_ = std::move(first);
  return false;
}

/// The commanded robot may itself stand where the others would have to pass. It goes home, or back where it came from, and its command
/// is carried out from there.
bool EscapeSearch::step_aside_and_serve(const PlannedMotion& served) {
  const EscapeView& view = robots_[served.robot];
  std::vector<std::pair<EscapeWay, model::MotionRequest>> places;
  for (const model::MotionRequest& home : view.home) places.emplace_back(EscapeWay::home, home);
  for (const model::MotionRequest& back : view.trail) places.emplace_back(EscapeWay::retreat, back);
  for (const auto& [way, request] : places) {
    auto aside = admit(cell_, served.robot, view.body(), view.motion()->motion().to(), request);
    if (!aside || (*aside)->motion().duration() <= 0) continue;
    auto from_there = admit(cell_, served.robot, served.motion->bodies(), (*aside)->motion().to(), served.request);
    if (!from_there) continue;
    PlannedMotion step = served;
    step.way = way;
    step.request = request;
    step.motion = std::move(*aside);
    PlannedMotion then = served;
    then.motion = std::move(*from_there);
    const auto serve_then = [&] {
      const PlannedMotion& stepped = plan_.back();
      const model::Motion& motion = stepped.motion->motion();
      then.not_before = *stepped.assessment.start + stepped.tolerance + timing_.confirm +
                        model::from_seconds(motion.duration() * (1 + motion.robot().controller.speed_error));
      protected_.pop_back();
      const bool done = serve(then, 0, [] { return true; });
      protected_.push_back(then.motion);
      return done;
    };
    protected_.push_back(then.motion);  // whoever goes out of the way of the step should be out of that of the command too
    const bool done = plainest([&] { return serve(step, 0, serve_then); });
    protected_.pop_back();
    if (done) return true;
  }
  return false;
}

/// From here on the motion is a fact for all others.
void EscapeSearch::commit(PlannedMotion motion) {
  std::vector<Neighbour>& seen = robots_[motion.robot].seen;
  before_.push_back(seen);
  Neighbour n = seen.back();
  n.motion = motion.motion;
  n.committed = true;
  n.start_from = *motion.assessment.start;
  n.start_until = n.start_from + motion.tolerance;
  if (!seen.back().committed) seen.clear();
  seen.push_back(n);
  plan_.push_back(std::move(motion));
}

void EscapeSearch::take_back() {
  robots_[plan_.back().robot].seen = std::move(before_.back());
  before_.pop_back();
  plan_.pop_back();
}

/// Commits `motion` in the plan when it has a start, else clears its blockers out of the way one by one; then goes on with `then`.
/// Whatever was tried in vain is taken back.
bool EscapeSearch::serve(PlannedMotion motion, int depth, const Attempt& then) {
  Timing timing = timing_;
  timing.earliest = std::max(timing.earliest, motion.not_before);
  const auto assess = [&](Evidence evidence) {
    return strategy_.assess({motion.robot, motion.motion, motion.tolerance}, neighbours_of(motion.robot), timing, maps_, evidence);
  };
  motion.assessment = assess(Evidence::no);
  if (motion.assessment.start) {
    motion.assessment = assess(Evidence::yes);
    commit(std::move(motion));
    if (then()) return true;
    take_back();
    return false;
  }
  const auto& blockers = motion.assessment.blockers;
  if (depth >= deepest_) {
    if (!notes_refusal(motion.robot, motion.way)) return false;
    if (const auto why = assess(Evidence::yes).conflicts; !why.empty()) {
      refuse(motion.robot, motion.way,
             fmt::format("{} is in the way there with its {}", why.front().blocker.str(), why.front().blocker_link));
    }
    return false;
  }
  const auto cannot_go = [&](RobotIndex b) {
    return robots_[b].committed() || !robots_[b].immovable.empty() ||
           std::any_of(protected_.begin(), protected_.end(), [&](const auto& p) { return p->robot().name == cell_.robots[b].name; });
  };
  if (blockers.empty() || std::any_of(blockers.begin(), blockers.end(), cannot_go)) {
    for (const RobotIndex b : blockers) {
      if (!robots_[b].immovable.empty()) refuse(b, EscapeWay::plus_x, robots_[b].immovable);
    }
    return false;
  }
  // Nearest to a face of the cuboid goes first (6.3.2); the others follow when this motion is assessed again.
  const Cuboid cuboid = swept_cuboid(motion.motion->motion());
  const auto nearest = *std::min_element(blockers.begin(), blockers.end(), [&](RobotIndex a, RobotIndex b) {
    const auto least = [&](RobotIndex i) { return escape_directions(cuboid, tcp_of(i)).front().distance; };
    return least(a) < least(b);
  });
  return clear_by(nearest, motion, depth, then);
}

/// Where the TCP of a robot that stands is [m].
Vector3 EscapeSearch::tcp_of(RobotIndex robot) const {
  return robots_[robot].motion()->motion().tcp(robots_[robot].motion()->motion().duration()).translation();
}

bool EscapeSearch::clear_by(RobotIndex blocker, const PlannedMotion& motion, int depth, const Attempt& then) {
  protected_.push_back(motion.motion);
  bool cleared = false;
  for (Way& way : ways_of(blocker, motion.motion)) {
    build(blocker, way);
    if (!way.full.motion && way.why.empty()) continue;  // it is there already
    if (--budget_ < 0) break;
    RequestedMotion out = out_of_the_way(blocker, way);
    if (!out.motion) continue;
    PlannedMotion escape;
    escape.robot = blocker;
    escape.way = way.way;
    escape.request = std::move(out.request);
    escape.motion = std::move(out.motion);
    escape.tolerance = robots_[blocker].tolerance;
    const auto served_again = [&] {
      const SampledMotionPtr top = protected_.back();
      protected_.pop_back();
      const bool done = serve(motion, depth, then);
      protected_.push_back(top);
      return done;
    };
    if ((cleared = serve(std::move(escape), depth + 1, served_again))) break;
  }
  protected_.pop_back();
  return cleared;
}

/// The ways out of `robot`, in the order in which they are tried. Most searches need few of them, so they are built one by one.
std::vector<EscapeSearch::Way>& EscapeSearch::ways_of(RobotIndex robot, const SampledMotionPtr& served) {
  auto [entry, fresh] = ways_.try_emplace({robot, served->id()});
  if (!fresh) return entry->second;
  std::vector<Way>& ways = entry->second;
  for (const EscapeDirection& d : escape_directions(swept_cuboid(served->motion()), tcp_of(robot))) {
    Way& way = ways.emplace_back();
    way.way = d.way;
    way.unit = d.unit;
  }
  if (rules_.six_directions_only) return ways;
  const EscapeView& view = robots_[robot];
  const auto add = [&](EscapeWay name, const model::MotionRequest& request) {
    Way& way = ways.emplace_back();
    way.way = name;
    way.request = request;
  };
  for (const model::MotionRequest& back : view.trail) add(EscapeWay::retreat, back);
  for (const model::MotionRequest& home : view.home) add(EscapeWay::home, home);
  return ways;
}

void EscapeSearch::build(RobotIndex robot, Way& way) {
  if (std::exchange(way.built, true)) return;
  const model::Joints& from = robots_[robot].motion()->motion().to();
  if (way.unit) {
    way.full = to_reachable_goal(cell_, robot, robots_[robot].body(), from, *way.unit);
    if (!way.full.motion) way.why = "it cannot go any farther that way";
    return;
  }
  auto motion = admit(cell_, robot, robots_[robot].body(), from, way.request);
  if (!motion) {
    way.why = motion.error().text;
  } else if ((*motion)->motion().duration() > 0) {
    way.full = {way.request, std::move(*motion)};
  }
}

/// The shortest part of a way whose end is clear of everything that room is made for; empty with a refusal when there is none.
RequestedMotion EscapeSearch::out_of_the_way(RobotIndex robot, const Way& way) {
  if (!way.full.motion) {
    refuse(robot, way.way, way.why);
    return {};
  }
  const auto clear = first_clear(way.full.motion);
  if (!clear) {
    refuse(robot, way.way, fmt::format("it stays in the way of {} as far as it can go", protected_.back()->robot().name.str()));
    return {};
  }
  const model::Motion& full = way.full.motion->motion();
  const double whole = full.length(full.duration());
  double length = std::min(whole, full.length(*clear) + kBeyond);
  if (rules_.brake_after_area) {
    const double safe = safe_length(robot, way.full.motion);
    if (safe < length) {
      refuse(robot, way.way, fmt::format("a bystander stands in the way after {:.0f} mm, {:.0f} mm are needed", 1e3 * safe, 1e3 * length));
      return {};
    }
    length = std::min({whole, safe, length + braking_length(full)});
  }
  const RequestedMotion& out = full.is_linear() && length < whole - kBeyond ? cut(robot, way, length) : way.full;
  if (!out.motion) {
    refuse(robot, way.way, "the goal cannot be reached");
    return {};
  }
  const EscapeView& view = robots_[robot];
  if (keep_next_ && view.next && !admit(cell_, robot, view.next_bodies, out.motion->motion().to(), *view.next)) {
    refuse(robot, way.way, "its next command would not be possible from there");
    return {};
  }
  return out;
}

/// The way's first `length` [m] as a motion of its own.
const RequestedMotion& EscapeSearch::cut(RobotIndex robot, const Way& way, double length) {
  auto [entry, fresh] = cut_.try_emplace({way.full.motion.get(), std::lround(length / kGrid)});
  if (fresh) {
    const auto request = shortened(way.full.motion->motion(), length);
    auto motion = admit(cell_, robot, way.full.motion->robot(), way.full.motion->motion().from(), request);
    entry->second = {request, motion ? *motion : nullptr};
  }
  return entry->second;
}

/// Local time on a whole way from which on its robot could stop and be clear of everything that room is made for, the earliest.
std::optional<double> EscapeSearch::first_clear(const SampledMotionPtr& full) {
  TimesInTheWay all;
  for (const SampledMotionPtr& p : protected_) {
    const auto& times = maps_.in_the_way(p, full).times;
    all.times.insert(all.times.end(), times.begin(), times.end());
  }
  const double end = full->motion().duration();
  if (!rules_.brake_after_area) {
    std::sort(all.times.begin(), all.times.end());
    return all.first_clear(end);
  }
  double height = 0;  // the dissertation's: beyond the whole collision area
  for (const auto& [from, until] : all.times) height = std::max(height, until);
  return height > end ? std::nullopt : std::optional{height};
}

/// How far the whole way is clear of all robots that stand [m]: the dissertation's safe reachable goal (6.3.3).
double EscapeSearch::safe_length(RobotIndex robot, const SampledMotionPtr& full) {
  double first = kNever;
  for (const RobotIndex other : neighbourhood_.of(robot)) {
    const Neighbour& n = robots_[other].seen.back();
    if (n.committed || n.lost) continue;
    for (const BlockedCell& c : maps_.get(full, n.motion).map.blocked) first = std::min(first, c.tau0);
  }
  return first == kNever ? full->motion().length(full->motion().duration()) : full->motion().length(first - cell_.planning.resolution);
}

std::vector<Neighbour> EscapeSearch::neighbours_of(RobotIndex robot) const {
  std::vector<Neighbour> neighbours;
  for (const RobotIndex other : neighbourhood_.of(robot)) {
    neighbours.insert(neighbours.end(), robots_[other].seen.begin(), robots_[other].seen.end());
  }
  return neighbours;
}

/// One reason for each way: the first.
bool EscapeSearch::notes_refusal(RobotIndex robot, EscapeWay way) const {
  const model::RobotName& name = cell_.robots[robot].name;
  return refusals_.size() < kRefusalsKept &&
         std::none_of(refusals_.begin(), refusals_.end(), [&](const auto& r) { return r.robot == name && r.way == way; });
}

void EscapeSearch::refuse(RobotIndex robot, EscapeWay way, std::string text) {
  if (notes_refusal(robot, way)) refusals_.push_back({cell_.robots[robot].name, way, std::move(text)});
}

}  // namespace interlace::core
