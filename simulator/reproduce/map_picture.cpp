#include "simulator/reproduce/map_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "simulator/reproduce/axes.hpp"

namespace interlace::reproduce {

namespace {

constexpr double kShortestDelay = 0.05;  // [s]
constexpr const char* kArea = "#f0a58f";

/// Whether a start at `start` would meet a blocked cell of `map`.
bool forbidden(const core::TimingMap& map, double start) {
  return std::any_of(map.blocked.begin(), map.blocked.end(),
                     [&](const core::BlockedCell& c) { return start > c.t0 - c.tau1 && start < c.t1 - c.tau0; });
}

core::TimingMap timing_map(const MapSubject& subject, const model::PlanningOptions& planning) {
  core::SampledMotion commanded{subject.commanded_motion, planning.resolution};
  core::SampledMotion moving{subject.moving_motion, planning.resolution};
  return core::build_timing_map(commanded, moving, planning.margin);
}

/// The motion of `row` as its robot stood when it began; empty for escapes and for what never started.
std::optional<model::Motion> motion_of(const Case& input, const StrategyRun& run, const app::CommandRow& row, const NamedCommands& named) {
  const auto command = named.find(row.id);
  if (command == named.end() || !row.start || !row.end) return std::nullopt;
  const model::RobotIndex robot = command->second.robot;
  auto motion = model::plan_motion(input.cell->robots[robot], frame_at(run.frames, *row.start).joints[robot], command->second.request);
  return motion ? std::optional{std::move(*motion)} : std::nullopt;
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
    if (!row.escape && row.start && row.delay > kShortestDelay) delayed.push_back(&row);
  }
  std::stable_sort(delayed.begin(), delayed.end(), [](const auto* a, const auto* b) { return *a->start < *b->start; });
  for (const app::CommandRow* row : delayed) {
    const auto commanded = motion_of(input, run, *row, named);
    if (!commanded || commanded->length(commanded->duration()) <= 0) continue;
    const double ready = *row->start - row->delay;
    for (const app::CommandRow& other : run.report.commands) {
      if (other.robot == row->robot || !other.start || !other.end || *other.start >= *row->start || *other.end <= ready) continue;
      const auto moving = motion_of(input, run, other, named);
      if (!moving) continue;
      MapSubject subject{named.at(row->id).label, named.at(other.id).label,  *commanded, *moving,
                         ready - *other.start,    *row->start - *other.start};
      if (forbidden(timing_map(subject, input.cell->planning), subject.ready)) return subject;
    }
  }
  return std::nullopt;
}

std::vector<core::CollisionArea> collision_areas(const MapSubject& subject, const model::PlanningOptions& planning) {
  return core::collision_map(timing_map(subject, planning), subject.commanded_motion);
}

std::string map_picture(const std::string& title, const MapSubject& subject, const std::vector<core::CollisionArea>& areas) {
  const model::Motion& commanded = subject.commanded_motion;
  const double whole = 1000 * commanded.length(commanded.duration());
  const double standing = 0.05 * whole;  // of the strip above the whole length: the robot at its goal
  Axes axes;
  axes.left = 66;
  axes.top = 62;
  axes.width = 640;
  axes.height = 360;
  axes.x0 = std::min(0.0, subject.ready);
  axes.x1 = std::max(subject.moving_motion.duration(), subject.start + commanded.duration()) + 0.3;
  axes.y1 = whole + standing;
  Svg svg{730, 476, title};
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
  for (const double t : {0.0, subject.moving_motion.duration()})
    svg.line({axes.x(t), axes.top}, {axes.x(t), axes.top + axes.height}, arrival);
  svg.line(axes.at(axes.x0, whole), axes.at(axes.x1, whole), arrival);
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
  svg.text({550, y + 4}, fmt::format("start, end of {}; goal", subject.moving));
  TextStyle unit;
  unit.anchor = Anchor::middle;
  svg.text({axes.left + axes.width / 2, axes.top + axes.height + 40},
           fmt::format("servo time of the moving robot since the start of {} [s]", subject.moving), unit);
  unit.upwards = true;
  svg.text({18, axes.top + axes.height / 2}, fmt::format("travelling length of the TCP in {} [mm]", subject.commanded), unit);
  return svg.str();
}

}  // namespace interlace::reproduce
