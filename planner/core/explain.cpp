#include "planner/core/explain.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace interlace::core {

namespace {

/// A finite time inside [from, to], whose ends may be infinite.
double inside(double from, double to) {
  if (std::isinf(from) && std::isinf(to)) return 0;
  if (std::isinf(from)) return to;
  if (std::isinf(to)) return from;
  return (from + to) / 2;
}

Vector3 meeting_place(const Candidate& candidate, const Neighbour& neighbour, const BlockedCell& cell) {
  const auto body_at = [](SampledMotion& motion, double t0, double t1, std::size_t body) {
    const SampledMotion& m = motion.part(t0, t1);
    std::vector<model::Capsule> capsules;
    model::place_capsules(m.robot().model, m.robot().X_WB, motion.motion().joints(inside(t0, t1)), capsules);
    return Body{capsules[body]};
  };
  return meeting_point(body_at(*candidate.motion, cell.tau0, cell.tau1, cell.own_body),
                       body_at(*neighbour.motion, cell.t0, cell.t1, cell.other_body));
}

}  // namespace

std::optional<model::Conflict> explain_conflict(const Candidate& candidate, const Neighbour& neighbour, const TimingMap& map,
                                                const std::vector<ForbiddenStart>& forbidden, const StartInterval& span) {
  const BlockedCell* deepest = nullptr;
  std::vector<StartInterval> intervals;
  for (const ForbiddenStart& f : forbidden) {
    if (f.interval.until < span.from || f.interval.from >= span.until) continue;
    intervals.push_back(f.interval);
    const BlockedCell& cell = map.blocked[f.cell];
    if (!deepest || cell.clearance < deepest->clearance) deepest = &cell;
  }
  if (!deepest) return std::nullopt;
  const auto stretches = united(std::move(intervals));
  model::Conflict c;
  c.blocker = neighbour.motion->robot().name;
  c.own_link = candidate.motion->part(deepest->tau0, deepest->tau1).robot().model.capsules[deepest->own_body].name;
  c.blocker_link = neighbour.motion->part(deepest->t0, deepest->t1).robot().model.capsules[deepest->other_body].name;
  c.from = std::max(stretches.front().from, span.from);
  c.until = stretches.back().until;
  c.clearance = deepest->clearance;
  c.place = meeting_place(candidate, neighbour, *deepest);
  return c;
}

std::optional<model::Conflict> zone_conflict(const Candidate& candidate, const ZoneVisit& visit, const Neighbour& holder,
                                             const std::vector<ForbiddenStart>& forbidden, const StartInterval& span) {
  std::vector<StartInterval> intervals;
  for (const ForbiddenStart& f : forbidden) {
    if (f.interval.until >= span.from && f.interval.from < span.until) intervals.push_back(f.interval);
  }
  if (intervals.empty()) return std::nullopt;
  const auto stretches = united(std::move(intervals));
  const model::Robot& robot = candidate.motion->robot();
  std::vector<model::Capsule> capsules;
  model::place_capsules(robot.model, robot.X_WB, candidate.motion->motion().joints(visit.entered), capsules);
  model::Conflict c;
  c.blocker = holder.motion->robot().name;
  c.own_link = robot.model.capsules[visit.body].name;
  c.from = std::max(stretches.front().from, span.from);
  c.until = stretches.back().until;
  c.place = (capsules[visit.body].a + capsules[visit.body].b) / 2;
  return c;
}

model::Conflict lost_conflict(const Candidate& candidate, const Neighbour& neighbour, Instant from) {
  model::Conflict c;
  c.blocker = neighbour.motion->robot().name;
  c.from = from;
  c.place = candidate.motion->motion().tcp(0).translation();
  return c;
}

std::string sentence(const model::RobotName& robot, const Assessment& a, double delay) {
  if (a.reason == model::Reason::none || a.conflicts.empty()) return {};
  if (a.reason == model::Reason::robot_unknown) {
    return fmt::format("{} waits: {} is not heard from and could be anywhere in its reach", robot.str(), a.conflicts.front().blocker.str());
  }
  std::string text;
  for (const model::Conflict& c : a.conflicts) {
    if (c.own_link.empty()) {  // a robot that could have been anywhere
      text += fmt::format("{}{} was not heard from", text.empty() ? "" : "; ", c.blocker.str());
      continue;
    }
    const std::string what = c.blocker_link.empty() ? fmt::format("be in the zone that {} holds", c.blocker.str())
                                                    : fmt::format("meet {}'s {}", c.blocker.str(), c.blocker_link);
    text += fmt::format("{}{}'s {} would {} near ({:.0f}, {:.0f}, {:.0f}) mm", text.empty() ? "" : "; ", robot.str(), c.own_link, what,
                        1e3 * c.place.x(), 1e3 * c.place.y(), 1e3 * c.place.z());
    text += c.until == model::kForever ? fmt::format(" as long as {} stays there", c.blocker.str())
                                       : fmt::format(" if it started before {:.2f} s", model::to_seconds(c.until));
  }
  constexpr double kAtOnce = 0.005;  // [s]: less is shown as nothing
  if (a.start && delay < kAtOnce) return fmt::format("{} starts as others leave: {}", robot.str(), text);
  if (a.start) return fmt::format("{} starts {:.2f} s later: {}", robot.str(), delay, text);
  return fmt::format("{} cannot start: {}", robot.str(), text);
}

}  // namespace interlace::core
