#include "simulator/reproduce/map_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "simulator/reproduce/axes.hpp"

namespace interlace::reproduce {

namespace {

constexpr double kShortestDelay = 0.05;  // [s]
constexpr double kAfterArrival = 0.02;   // a robot surely stands this long after the end of its motion [s]
constexpr double kSameDuration = 0.05;   // [s]
constexpr double kSpare = 0.3;           // shown after the command's end [s]
constexpr const char* kArea = "#f0a58f";

/// Whether a start at `start` would meet a blocked cell of `map`.
bool forbidden(const core::TimingMap& map, double start) {
  return std::any_of(map.blocked.begin(), map.blocked.end(),
                     [&](const core::BlockedCell& c) { return start > c.t0 - c.tau1 && start < c.t1 - c.tau0; });
}

core::TimingMap timing_map(const model::Motion& commanded, const model::Motion& moving, const model::PlanningOptions& planning) {
  core::SampledMotion own{commanded, planning.resolution};
  core::SampledMotion other{moving, planning.resolution};
  return core::build_timing_map(own, other, planning.margin);
}

/// The motion of `row` as its robot stood when it began. An escape's request is not in the program: it is the straight or joint move to
/// where the robot then stood that takes as long. Empty when there is none, and for what never started.
std::optional<model::Motion> motion_of(const Case& input, const StrategyRun& run, const app::CommandRow& row, const NamedCommands& named) {
  const auto robot = input.cell->find(row.robot);
  if (!robot || !row.start || !row.end) return std::nullopt;
  const model::Robot& arm = input.cell->robots[*robot];
  const model::Joints& from = frame_at(run.frames, *row.start).joints[*robot];
  std::vector<model::MotionRequest> requests;
  if (const auto command = named.find(row.id); command != named.end()) {
    requests.push_back(command->second.request);
  } else {
    const model::Joints& to = frame_at(run.frames, *row.end + kAfterArrival).joints[*robot];
    requests.resize(2);
    requests[0].target = model::LinearTarget{arm.X_WB * model::tcp_pose(arm.model, to)};
    requests[1].target = model::JointTarget{to};
  }
  for (const auto& request : requests) {
    auto motion = model::plan_motion(arm, from, request);
    if (motion && std::abs(motion->duration() - (*row.end - *row.start)) < kSameDuration) return std::optional{std::move(*motion)};
  }
  return std::nullopt;
}

/// What `first`'s robot did from then until `until` (of the run [s]); sets how far that is known.
std::vector<MovingPart> doings(const Case& input, const StrategyRun& run, const app::CommandRow& first, double until,
                               const NamedCommands& named, double& known_until) {
  std::vector<const app::CommandRow*> rows;
  for (const app::CommandRow& r : run.report.commands) {
    if (r.robot == first.robot && r.start && *r.start >= *first.start && *r.start < until) rows.push_back(&r);
  }
  std::stable_sort(rows.begin(), rows.end(), [](const auto* a, const auto* b) { return *a->start < *b->start; });
  std::vector<MovingPart> parts;
  known_until = until - *first.start;
  for (const app::CommandRow* r : rows) {
    auto motion = motion_of(input, run, *r, named);
    if (!motion) {
      known_until = *r->start - *first.start;
      break;
    }
    const auto command = named.find(r->id);
    parts.push_back({command == named.end() ? "escape" : command->second.label, std::move(*motion), *r->start - *first.start});
  }
  return parts;
}

/// The travelling length over time of a motion that starts at `start`.
std::vector<Point> trajectory(const Axes& axes, const model::Motion& motion, double start) {
  std::vector<Point> points;
  points.push_back(axes.at(start, 0));
  constexpr int kSteps = 200;
  for (int i = 0; i <= kSteps; ++i) {
    const double t = motion.duration() * i / kSteps;
    points.push_back(axes.at(start + t, 1000 * motion.length(t)));
  }
  points.push_back(axes.at(axes.x1, 1000 * motion.length(motion.duration())));
  return simplified(points, 0.1);
}

/// Areas that lie side by side as one, so that the picture stays small.
std::vector<core::CollisionArea> joined(std::vector<core::CollisionArea> areas) {
  std::sort(areas.begin(), areas.end(), [](const auto& a, const auto& b) {
    return std::tie(a.length0, a.length1, a.t0, a.t1) < std::tie(b.length0, b.length1, b.t0, b.t1);
  });
  std::vector<core::CollisionArea> result;
  for (const auto& a : areas) {
    if (!result.empty() && result.back().length0 == a.length0 && result.back().length1 == a.length1 && a.t0 <= result.back().t1) {
      result.back().t1 = std::max(result.back().t1, a.t1);
    } else {
      result.push_back(a);
    }
  }
  return result;
}

}  // namespace

std::optional<MapSubject> first_delayed(const Case& input, const StrategyRun& run, const NamedCommands& named) {
  std::vector<const app::CommandRow*> delayed;
  for (const app::CommandRow& row : run.report.commands) {
    if (!row.escape && row.start && row.end && row.delay > kShortestDelay) delayed.push_back(&row);
  }
  std::stable_sort(delayed.begin(), delayed.end(), [](const auto* a, const auto* b) { return *a->start < *b->start; });
  for (const app::CommandRow* row : delayed) {
    const auto commanded = motion_of(input, run, *row, named);
    if (!commanded || commanded->length(commanded->duration()) <= 0) continue;
    const double ready = *row->start - row->delay;
    for (const app::CommandRow& other : run.report.commands) {
      if (other.robot == row->robot || !other.start || !other.end || *other.start >= *row->start || *other.end <= ready) continue;
      const auto moving = motion_of(input, run, other, named);
      if (!moving || !forbidden(timing_map(*commanded, *moving, input.cell->planning), ready - *other.start)) continue;
      MapSubject subject{named.at(row->id).label, *commanded, ready - *other.start, *row->start - *other.start, {}, 0};
      subject.moving = doings(input, run, other, *row->end + kSpare, named, subject.known_until);
      return subject;
    }
  }
  return std::nullopt;
}

std::vector<core::CollisionArea> collision_areas(const MapSubject& subject, const model::PlanningOptions& planning) {
  std::vector<core::CollisionArea> areas;
  for (std::size_t k = 0; k < subject.moving.size(); ++k) {
    const MovingPart& part = subject.moving[k];
    const double from = k == 0 ? -core::kNever : part.start;
    const double until = k + 1 < subject.moving.size() ? subject.moving[k + 1].start : subject.known_until;
    for (core::CollisionArea a : core::collision_map(timing_map(subject.motion, part.motion, planning), subject.motion)) {
      a.t0 = std::max(a.t0 + part.start, from);
      a.t1 = std::min(a.t1 + part.start, until);
      if (a.t0 < a.t1) areas.push_back(a);
    }
  }
  return areas;
}

std::string map_picture(const std::string& title, const MapSubject& subject, const std::vector<core::CollisionArea>& areas) {
  const model::Motion& commanded = subject.motion;
  const std::string& mover = subject.moving.front().motion.robot().name.str();
  const double whole = 1000 * commanded.length(commanded.duration());
  const double standing = 0.05 * whole;  // of the strip above the whole length: the robot at its goal
  Axes axes;
  axes.left = 66;
  axes.top = 72;
  axes.width = 640;
  axes.height = 360;
  axes.x0 = std::min(0.0, subject.ready);
  axes.x1 = std::max({subject.moving.front().motion.duration(), subject.start + commanded.duration() + kSpare, subject.known_until});
  axes.y1 = whole + standing;
  Svg svg{750, 486, title};
  TextStyle heading;
  heading.size = 14;
  heading.bold = true;
  svg.text({16, 20}, title, heading);
  draw_grid(svg, axes, {});

  svg.begin_clip(axes.left, axes.top, axes.width, axes.height);
  std::string path;
  for (const core::CollisionArea& a : joined(areas)) {
    const double t0 = std::max(a.t0, axes.x0), t1 = std::min(a.t1, axes.x1);
    const double low = 1000 * a.length0;
    const double high = 1000 * a.length1 >= whole && 1000 * a.length0 >= whole ? axes.y1 : 1000 * a.length1;
    if (t1 <= t0) continue;
    fmt::format_to(std::back_inserter(path), "M{} {}H{}V{}H{}Z", number(axes.x(t0)), number(axes.y(low)), number(axes.x(t1)),
                   number(axes.y(high)), number(axes.x(t0)));
  }
  Style area{kArea, kArea};
  area.width = 0.6;
  area.name = "area";
  svg.path(path, area);
  Style line{"none", kVermilion};
  line.width = 2;
  line.dash = "7 4";
  line.name = "original";
  svg.polyline(trajectory(axes, commanded, subject.ready), line);
  line = Style{"none", kBlue};
  line.width = 2.5;
  line.name = "chosen";
  svg.polyline(trajectory(axes, commanded, subject.start), line);
  svg.end_clip();

  Style arrival{"none", "#777777"};
  arrival.dash = "2 3";
  TextStyle doing;
  doing.size = 11;
  doing.anchor = Anchor::middle;
  for (const MovingPart& part : subject.moving) {
    const double end = std::min(part.start + part.motion.duration(), axes.x1);
    for (const double t : {part.start, end}) svg.line({axes.x(t), axes.top}, {axes.x(t), axes.top + axes.height}, arrival);
    if (axes.x(end) - axes.x(part.start) > 40) svg.text({axes.x((part.start + end) / 2), axes.top - 5}, part.label, doing);
  }
  svg.line(axes.at(axes.x0, whole), axes.at(axes.x1, whole), arrival);
  TextStyle small;
  small.size = 11;
  svg.text({axes.left + axes.width + 5, axes.y(whole) + 4}, "goal", small);
  draw_frame(svg, axes);

  const double y = 38;
  svg.rect(66, y - 7, 28, 14, area);
  svg.text({100, y + 4}, "collision");
  line = Style{"none", kVermilion};
  line.width = 2;
  line.dash = "7 4";
  svg.line({176, y}, {204, y}, line);
  svg.text({210, y + 4}, "started at once");
  line = Style{"none", kBlue};
  line.width = 2.5;
  svg.line({322, y}, {350, y}, line);
  svg.text({356, y + 4}, fmt::format("as chosen, {:.2f} s later", subject.start - subject.ready));
  svg.line({516, y}, {544, y}, arrival);
  svg.text({550, y + 4}, "motions of " + mover);
  TextStyle unit;
  unit.anchor = Anchor::middle;
  svg.text({axes.left + axes.width / 2, axes.top + axes.height + 40},
           fmt::format("servo time of {} since the start of {} [s]", mover, subject.moving.front().label), unit);
  unit.upwards = true;
  svg.text({18, axes.top + axes.height / 2}, fmt::format("travelling length of the TCP in {} [mm]", subject.label), unit);
  return svg.str();
}

}  // namespace interlace::reproduce
