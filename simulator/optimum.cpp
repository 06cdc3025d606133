#include "simulator/optimum.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "common/model/bodies.hpp"
#include "planner/core/admission.hpp"
#include "planner/core/neighbourhood.hpp"
#include "planner/core/timing_map.hpp"
#include "simulator/coordination_space.hpp"

namespace interlace::sim {

namespace {

using core::kNever;
using core::SampledMotion;
using core::SampledMotionPtr;
using model::RobotIndex;

/// All that a robot has to do.
struct Course {
  SampledMotionPtr start;  // standing
  std::vector<SampledMotionPtr> motions;
  Track track;
};

model::Result<std::vector<Course>, std::string> courses_of(const model::Cell& cell, model::Bodies& bodies, const model::Program& program) {
  std::vector<Course> courses(cell.robots.size());
  for (RobotIndex i = 0; i < cell.robots.size(); ++i) {
    const model::Robot& robot = cell.robots[i];
    courses[i].start =
        std::make_shared<SampledMotion>(model::Motion::rest(bodies.of(i, cell.set_of(robot.holds)), robot.start), cell.planning.resolution);
  }
  for (const auto& [name, steps] : program.robots) {
    const RobotIndex i = cell.find(name).value();
    Course& course = courses[i];
    model::Joints from = cell.robots[i].start;
    model::ToolSet held = cell.set_of(cell.robots[i].holds);
    for (std::size_t k = 0; k < steps.size(); ++k) {
      const auto tools = model::tool_steps(cell, name, held, steps[k].motion.tools);
      if (!tools) return model::unexpected(fmt::format("{}, command {}: {}", name.str(), k + 1, tools.error()));
      auto motion = core::admit(cell, i, model::MotionBodies::of(bodies, i, *tools), from, steps[k].motion);
      if (!motion) return model::unexpected(fmt::format("{}, command {}: {}", name.str(), k + 1, motion.error().text));
      from = (*motion)->motion().to();
      held = tools->after;
      course.track.stops.push_back(course.track.stops.back() + (*motion)->motion().duration());
      course.motions.push_back(std::move(*motion));
    }
  }
  return courses;
}

/// Where a motion may not start because of one under way or standing, as one cell of their map has it.
void add_leaving(const core::TimingMap& map, const core::BlockedCell& c, const Course& course_b, std::optional<std::size_t> a,
                 const Course& course_a, std::size_t b, Crossing& crossing) {
  const auto& stops_a = course_a.track.stops;
  const auto& stops_b = course_b.track.stops;
  const bool before_b = c.t0 == -kNever, after_b = c.t1 == kNever;
  if (a && before_b) crossing.a_leaves.push_back({*a, b, {stops_b[b], stops_b[b]}, c.tau1});
  if (a && after_b && b + 1 < stops_b.size()) crossing.a_leaves.push_back({*a, b, {stops_b[b + 1], stops_b[b + 1]}, c.tau1});
  if (a && after_b && !before_b && c.tau1 > c.t0) crossing.a_before.push_back({*a, b, {0, c.tau1 - c.t0}});
  if (c.tau1 == kNever && b < course_b.motions.size() && !before_b && a && c.t1 > c.tau0)
    crossing.b_before.push_back({b, *a, {0, c.t1 - c.tau0}});
  if (before_b) return;
  if (a) {
    const double from = std::max(0.0, c.t0 - c.tau1), until = std::min(map.moving_duration, c.t1 - c.tau0);
    if (until > from) crossing.a_leaves.push_back({*a, b, {stops_b[b] + from, stops_b[b] + until}});
  }
  if (b >= course_b.motions.size()) return;
  const std::size_t end_of_a = a ? *a + 1 : 0;
  if (c.tau1 == kNever) crossing.b_leaves.push_back({b, a.value_or(0), {stops_a[end_of_a], stops_a[end_of_a]}, c.t1});
  if (!a) return;
  const double from = std::max(0.0, c.tau0 - c.t1), until = std::min(map.commanded_duration, c.tau1 - c.t0);
  if (until > from) crossing.b_leaves.push_back({b, *a, {stops_a[*a] + from, stops_a[*a] + until}});
}

/// Adds what the map of two motions says, `a` and `b` their places in their courses; `a` is empty for standing at the start.
void add(const core::TimingMap& map, const Course& course_b, std::optional<std::size_t> a, const Course& course_a, std::size_t b,
         bool confirmed, Crossing& crossing) {
  const std::size_t end_of_a = a ? *a + 1 : 0;
  const bool b_stands_for_good = map.moving_duration <= 0;
  for (const core::BlockedCell& c : map.blocked) {
    const bool a_stands = c.tau1 == kNever;
    const bool before_b = c.t0 == -kNever, after_b = c.t1 == kNever;
    const auto progress_a = [&](double tau) { return course_a.track.stops[*a] + tau; };
    const auto progress_b = [&](double t) { return course_b.track.stops[b] + t; };
    if (confirmed) add_leaving(map, c, course_b, a, course_a, b, crossing);
    if (!before_b && !after_b) {
      if (a_stands) {
        crossing.a_stands.push_back({end_of_a, {progress_b(c.t0), progress_b(c.t1)}});
      } else {
        crossing.moving.push_back({*a, b, {c.tau0 - c.t1, c.tau1 - c.t0}});
      }
      continue;
    }
    const auto standing_b = [&](std::size_t stop) {
      if (a_stands) {
        crossing.a_stands.push_back({end_of_a, {course_b.track.stops[stop], course_b.track.stops[stop]}});
      } else {
        crossing.b_stands.push_back({stop, {progress_a(c.tau0), progress_a(c.tau1)}});
      }
    };
    if (before_b) standing_b(b);
    if (after_b && b + 1 < course_b.track.stops.size()) standing_b(b_stands_for_good && course_b.motions.empty() ? b : b + 1);
  }
}

Crossing crossing_of(const Course& a, const Course& b, double margin, bool confirmed) {
  Crossing crossing;
  const auto against_all = [&](std::optional<std::size_t> i, SampledMotion& own) {
    if (b.motions.empty()) add(core::build_timing_map(own, *b.start, margin), b, i, a, 0, confirmed, crossing);
    for (std::size_t j = 0; j < b.motions.size(); ++j)
      add(core::build_timing_map(own, *b.motions[j], margin), b, i, a, j, confirmed, crossing);
  };
  against_all(std::nullopt, *a.start);
  for (std::size_t i = 0; i < a.motions.size(); ++i) against_all(i, *a.motions[i]);
  return crossing;
}

class Search {
 public:
  Search(const model::Cell& cell, std::vector<Course> courses, const OptimumOptions& options)
      : cell_(cell), options_(options), neighbourhood_(cell), courses_(std::move(courses)) {
    for (RobotIndex i = 0; i < cell.robots.size(); ++i) {
      for (RobotIndex j = i + 1; j < cell.robots.size(); ++j) {
        crossings_[{i, j}] =
            neighbourhood_.meet(i, j) ? crossing_of(courses_[i], courses_[j], cell.planning.margin, options.confirmed) : Crossing{};
      }
    }
  }

  Optimum run() {
    Optimum worst;
    worst.step = cell_.robots.size() > 2 ? options_.triple_step : options_.pair_step;
    worst.makespan = 0;
    const auto consider = [&](Optimum found) {
      if (!worst.makespan || (found.makespan && *found.makespan <= *worst.makespan)) return;
      worst = std::move(found);
    };
    const auto n = static_cast<RobotIndex>(cell_.robots.size());
    for (RobotIndex i = 0; i < n; ++i) {
      Optimum alone;
      alone.makespan = courses_[i].track.stops.back();
      alone.robots = {cell_.robots[i].name};
      consider(std::move(alone));
      for (RobotIndex j = i + 1; j < n; ++j) {
        if (n == 2) consider(of_two(i, j));
        for (RobotIndex k = j + 1; k < n; ++k) {
          if (n == 3 || worth_it(i, j, k)) consider(of_three(i, j, k));
        }
      }
    }
    worst.exact = worst.exact && n <= 3;
    return worst;
  }

 private:
  /// Robots that two others can meet make a group; the others say nothing together that they do not say alone.
  [[nodiscard]] bool worth_it(RobotIndex i, RobotIndex j, RobotIndex k) const {
    return neighbourhood_.meet(i, j) || neighbourhood_.meet(i, k) || neighbourhood_.meet(j, k);
  }

  Optimum of_two(RobotIndex i, RobotIndex j) const {
    Optimum o;
    o.step = options_.pair_step;
    o.robots = {cell_.robots[i].name, cell_.robots[j].name};
    const PairSpace space{courses_[i].track, courses_[j].track, crossings_.at({i, j}), o.step, options_.promise};
    if (space.to_go(0, 0) != PairSpace::kNever) o.makespan = space.to_go(0, 0) * o.step;
    return o;
  }

  Optimum of_three(RobotIndex i, RobotIndex j, RobotIndex k) const {
    Optimum o;
    o.step = options_.triple_step;
    o.robots = {cell_.robots[i].name, cell_.robots[j].name, cell_.robots[k].name};
    const std::vector<Track> tracks{courses_[i].track, courses_[j].track, courses_[k].track};
    std::vector<PairSpace> pairs;
    pairs.emplace_back(tracks[0], tracks[1], crossings_.at({i, j}), o.step, options_.promise);
    pairs.emplace_back(tracks[0], tracks[2], crossings_.at({i, k}), o.step, options_.promise);
    pairs.emplace_back(tracks[1], tracks[2], crossings_.at({j, k}), o.step, options_.promise);
    const TripleResult found = least_steps(tracks, pairs, o.step, options_.most_states);
    o.exact = found.complete;
    if (found.steps) o.makespan = *found.steps * o.step;
    return o;
  }

  const model::Cell& cell_;
  const OptimumOptions& options_;
  core::Neighbourhood neighbourhood_;
  std::vector<Course> courses_;
  std::map<std::pair<RobotIndex, RobotIndex>, Crossing> crossings_;
};

/// No robot is done sooner than its releases allow.
void keep_releases(const model::Cell& cell, const model::Program& program, const std::vector<Course>& courses, Optimum& o) {
  for (const auto& [name, steps] : program.robots) {
    const Course& course = courses[cell.find(name).value()];
    double done = 0;
    for (std::size_t k = 0; k < steps.size(); ++k) {
      o.exact = o.exact && steps[k].at <= 0;
      done = std::max(done, steps[k].at) + course.motions[k]->motion().duration();
    }
    if (o.makespan && done > *o.makespan) {
      o.makespan = done;
      o.robots = {name};
    }
  }
}

}  // namespace

model::Result<Optimum, std::string> least_makespan(const model::Cell& cell, const model::Program& program, const OptimumOptions& options) {
  model::Bodies bodies{cell};
  auto courses = courses_of(cell, bodies, program);
  if (!courses) return model::unexpected(courses.error());
  Optimum o = Search{cell, *courses, options}.run();
  keep_releases(cell, program, *courses, o);
  return o;
}

std::string summary(const Optimum& o) {
  if (!o.makespan) return "none, waiting alone never gets everything done: somebody has to go out of the way";
  std::string who;
  for (const auto& name : o.robots) who += (who.empty() ? "" : ", ") + name.str();
  return fmt::format("{} {:.2f} s with waiting alone, to {} s, for {}", o.exact ? "exactly" : "at least", *o.makespan, o.step, who);
}

}  // namespace interlace::sim
