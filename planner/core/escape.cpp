#include "planner/core/escape.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

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

/// What of the moving robot's time no cell of `map` holds, first instant from `blocked.front()` on: the first gap.
std::optional<double> first_gap(std::vector<std::pair<double, double>> blocked, double end) {
  std::sort(blocked.begin(), blocked.end());
  double clear = 0;
  for (const auto& [from, until] : blocked) {
    if (from > clear) break;
    clear = std::max(clear, until);
  }
  if (clear > end) return std::nullopt;
  return clear;
}

}  // namespace

EscapeSearch::EscapeSearch(const model::Cell& cell, std::vector<EscapeView> robots, const Strategy& strategy, const Timing& timing,
                           MapStore& maps)
    : cell_(cell), robots_(std::move(robots)), strategy_(strategy), timing_(timing), maps_(maps), rules_(strategy.service().rules) {}

model::Result<EscapePlan, EscapeRefusals> EscapeSearch::make_room(const Candidate& served) {
  PlannedMotion motion;
  motion.robot = served.robot;
  motion.motion = served.motion;
  motion.tolerance = served.tolerance;
  budget_ = kWaysPerSearch;
  // The plainest escapes first: no cascades, and the robots' own next commands still possible from where they go.
  EscapeRefusals plainest;
  for (deepest_ = 1; deepest_ <= rules_.cascade; ++deepest_) {
    for (keep_next_ = rules_.keep_next;; keep_next_ = false) {
      refusals_.clear();
      if (serve(motion, 0, [] { return true; })) {
        EscapePlan plan;
        plan.served = std::move(plan_.back().assessment);
        plan_.pop_back();
        plan.escapes = std::move(plan_);
        return plan;
      }
      if (plainest.empty()) plainest = std::move(refusals_);
      if (!keep_next_) break;
    }
  }
  return model::unexpected(std::move(plainest));
}

/// Commits `motion` in the plan when it has a start, else clears its blockers out of the way one by one; then goes on with `then`.
/// Whatever was tried in vain is taken back.
bool EscapeSearch::serve(PlannedMotion motion, int depth, const Goal& then) {
  motion.assessment = strategy_.assess({motion.robot, motion.motion, motion.tolerance}, neighbours_of(motion.robot), timing_, maps_);
  if (motion.assessment.start) {
    const Neighbour before = robots_[motion.robot].now;
    Neighbour& n = robots_[motion.robot].now;
    n.motion = motion.motion;
    n.committed = true;
    n.start_from = *motion.assessment.start;
    n.start_until = n.start_from + motion.tolerance;
    plan_.push_back(std::move(motion));
    if (then()) return true;
    robots_[plan_.back().robot].now = before;
    plan_.pop_back();
    return false;
  }
  const auto& blockers = motion.assessment.blockers;
  if (depth >= deepest_) {
    if (depth > 0 && !motion.assessment.conflicts.empty()) {
      const auto& c = motion.assessment.conflicts.front();
      refuse(motion.robot, motion.way, fmt::format("{} is in the way there with its {}", c.blocker.str(), c.blocker_link));
    }
    return false;
  }
  for (const RobotIndex b : blockers) {
    if (robots_[b].now.committed || !robots_[b].immovable.empty()) {
      refuse(b, motion.way, robots_[b].immovable.empty() ? std::string{"its own motion ends in the way"} : robots_[b].immovable);
      return false;
    }
  }
  if (blockers.empty()) return false;
  // Nearest to a face of the cuboid goes first (6.3.2); the others follow when this motion is assessed again.
  const Cuboid cuboid = swept_cuboid(motion.motion->motion());
  const auto nearest = *std::min_element(blockers.begin(), blockers.end(), [&](RobotIndex a, RobotIndex b) {
    const auto least = [&](RobotIndex i) {
      return escape_directions(cuboid, robots_[i].now.motion->motion().tcp(0).translation()).front().distance;
    };
    return least(a) < least(b);
  });
  return clear_by(nearest, motion, depth, then);
}

bool EscapeSearch::clear_by(RobotIndex blocker, const PlannedMotion& motion, int depth, const Goal& then) {
  protected_.push_back(motion.motion);
  bool cleared = false;
  for (const Way& way : ways_of(blocker, motion.motion)) {
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

const std::vector<EscapeSearch::Way>& EscapeSearch::ways_of(RobotIndex robot, const SampledMotionPtr& served) {
  auto [entry, fresh] = ways_.try_emplace({robot, served->id()});
  if (!fresh) return entry->second;
  std::vector<Way>& ways = entry->second;
  const EscapeView& view = robots_[robot];
  const model::Joints& from = view.now.motion->motion().to();
  const Cuboid cuboid = swept_cuboid(served->motion());
  for (const EscapeDirection& d : escape_directions(cuboid, view.now.motion->motion().tcp(0).translation())) {
    ways.push_back({d.way, to_reachable_goal(cell_, robot, from, d.unit), "it cannot go any farther that way"});
  }
  if (rules_.six_directions_only) return ways;
  const auto add = [&](EscapeWay way, const model::MotionRequest& request) {
    auto motion = admit(cell_, robot, from, request);
    if (!motion) {
      ways.push_back({way, {}, motion.error().text});
    } else if ((*motion)->motion().duration() > 0) {
      ways.push_back({way, {request, std::move(*motion)}, {}});
    }
  };
  for (const model::MotionRequest& back : view.trail) add(EscapeWay::retreat, back);
  add(EscapeWay::home, view.home);
  return ways;
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
  if (keep_next_ && robots_[robot].next && !admit(cell_, robot, out.motion->motion().to(), *robots_[robot].next)) {
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
    auto motion = admit(cell_, robot, way.full.motion->motion().from(), request);
    entry->second = {request, motion ? *motion : nullptr};
  }
  return entry->second;
}

/// Local time on a whole way from which on its robot could stop and be clear of everything that room is made for, the earliest.
std::optional<double> EscapeSearch::first_clear(const SampledMotionPtr& full) {
  std::vector<std::pair<double, double>> blocked;
  for (const SampledMotionPtr& p : protected_) {
    for (const BlockedCell& c : maps_.get(p, full).blocked) blocked.emplace_back(c.t0, c.t1);
  }
  const double end = full->motion().duration();
  if (!rules_.brake_after_area) return first_gap(std::move(blocked), end);
  double height = 0;  // the dissertation's: beyond the whole collision area
  for (const auto& b : blocked) height = std::max(height, b.second);
  return height > end ? std::nullopt : std::optional{height};
}

/// How far the whole way is clear of all robots that stand [m]: the dissertation's safe reachable goal (6.3.3).
double EscapeSearch::safe_length(RobotIndex robot, const SampledMotionPtr& full) {
  double first = kNever;
  for (RobotIndex other = 0; other < robots_.size(); ++other) {
    const Neighbour& n = robots_[other].now;
    if (other == robot || n.committed || n.lost) continue;
    for (const BlockedCell& c : maps_.get(full, n.motion).blocked) first = std::min(first, c.tau0);
  }
  return first == kNever ? full->motion().length(full->motion().duration()) : full->motion().length(first - cell_.planning.resolution);
}

std::vector<Neighbour> EscapeSearch::neighbours_of(RobotIndex robot) const {
  std::vector<Neighbour> neighbours;
  for (const EscapeView& view : robots_) {
    if (view.now.robot != robot) neighbours.push_back(view.now);
  }
  return neighbours;
}

void EscapeSearch::refuse(RobotIndex robot, EscapeWay way, std::string text) {
  if (refusals_.size() < kRefusalsKept) refusals_.push_back({cell_.robots[robot].name, way, std::move(text)});
}

}  // namespace interlace::core
