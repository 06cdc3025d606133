#include "simulator/reproduce/distance_curves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "common/model/segment_distance.hpp"
#include "simulator/reproduce/axes.hpp"

namespace interlace::reproduce {

namespace {

constexpr std::array<const char*, 2> kCurveColours{kVermilion, kBlue};

/// One small graph.
struct Panel {
  std::string title;
  double limit = 0;                        ///< [mm]
  std::vector<std::vector<Point>> curves;  ///< per run: t [s], distance [mm]
};

std::vector<Point> curve(const std::vector<Frame>& frames, const std::vector<double>& metres) {
  std::vector<Point> points;
  points.reserve(frames.size());
  for (std::size_t i = 0; i < frames.size(); ++i) points.push_back({frames[i].t, 1000 * metres[i]});
  return points;
}

const std::string& link_name(const model::Cell& cell, model::RobotIndex robot, std::size_t link) {
  return cell.robots[robot].model.capsules[link].name;
}

std::vector<Panel> panels_of_links(const model::Cell& cell, const std::vector<CurveRun>& runs) {
  std::vector<Panel> panels;
  for (const CurveRun& run : runs) {
    const auto distances = link_distances(cell, *run.frames, 0, 1);
    panels.resize(distances.size());
    for (std::size_t k = 0; k < distances.size(); ++k) {
      const LinkDistance& d = distances[k];
      panels[k].title = fmt::format("{} {} to {} {}", cell.robots[0].name.str(), link_name(cell, 0, d.link_a), cell.robots[1].name.str(),
                                    link_name(cell, 1, d.link_b));
      panels[k].limit = 1000 * d.prohibited;
      panels[k].curves.push_back(curve(*run.frames, d.distance));
    }
  }
  return panels;
}

std::vector<Panel> panels_of_robots(const model::Cell& cell, const std::vector<CurveRun>& runs) {
  std::vector<Panel> panels;
  for (model::RobotIndex a = 0; a < cell.robots.size(); ++a) {
    for (model::RobotIndex b = a + 1; b < cell.robots.size(); ++b) {
      Panel panel;
      panel.title = fmt::format("{} to {}", cell.robots[a].name.str(), cell.robots[b].name.str());
      for (const CurveRun& run : runs) panel.curves.push_back(curve(*run.frames, least_clearance(link_distances(cell, *run.frames, a, b))));
      panels.push_back(std::move(panel));
    }
  }
  return panels;
}

/// The stretches of `points` at or below `limit`.
std::vector<std::vector<Point>> below(const std::vector<Point>& points, double limit) {
  std::vector<std::vector<Point>> parts;
  bool inside = false;
  for (const Point& p : points) {
    const bool now = p.y <= limit;
    if (now && !inside) parts.emplace_back();
    if (now) parts.back().push_back(p);
    inside = now;
  }
  return parts;
}

void draw_curve(Svg& svg, const Axes& axes, const std::vector<Point>& values, const Style& style) {
  std::vector<Point> pixels;
  pixels.reserve(values.size());
  for (const Point& v : values) pixels.push_back(axes.at(v.x, v.y));
  svg.polyline(simplified(pixels, 0.2), style);
}

void draw_panel(Svg& svg, const Axes& axes, const Panel& panel, bool values_below, bool values_beside) {
  Grid grid;
  grid.x_ticks = 5;
  grid.y_ticks = 4;
  grid.x_values = values_below;
  grid.y_values = values_beside;
  grid.size = 10;
  draw_grid(svg, axes, grid);
  TextStyle title;
  title.size = 11;
  title.bold = true;
  svg.text({axes.left, axes.top - 5}, panel.title, title);
  for (std::size_t k = 0; k < panel.curves.size(); ++k) {
    Style line{"none", kCurveColours[k % kCurveColours.size()]};
    line.width = 1.3;
    line.name = "curve";
    draw_curve(svg, axes, panel.curves[k], line);
    line.width = 3.5;
    line.name = "contact";
    for (const auto& part : below(panel.curves[k], panel.limit)) draw_curve(svg, axes, part, line);
  }
  Style limit{"none", kInk};
  limit.dash = "5 3";
  limit.name = "limit";
  svg.line(axes.at(axes.x0, panel.limit), axes.at(axes.x1, panel.limit), limit);
  draw_frame(svg, axes);
}

void draw_legend(Svg& svg, double left, const std::vector<CurveRun>& runs, const std::string& limit) {
  double x = left;
  const double y = 38;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    Style line{"none", kCurveColours[k % kCurveColours.size()]};
    line.width = 2;
    svg.line({x, y}, {x + 28, y}, line);
    svg.text({x + 34, y + 4}, runs[k].name);
    x += 60 + 6.6 * static_cast<double>(runs[k].name.size());
  }
  Style dashed{"none", kInk};
  dashed.dash = "5 3";
  svg.line({x, y}, {x + 28, y}, dashed);
  svg.text({x + 34, y + 4}, limit + "; thick where robots touch");
}

}  // namespace

std::vector<LinkDistance> link_distances(const model::Cell& cell, const std::vector<Frame>& frames, model::RobotIndex a,
                                         model::RobotIndex b) {
  const model::Robot& robot_a = cell.robots[a];
  const model::Robot& robot_b = cell.robots[b];
  std::vector<LinkDistance> all;
  for (std::size_t i = 0; i < robot_a.model.capsules.size(); ++i) {
    for (std::size_t j = 0; j < robot_b.model.capsules.size(); ++j)
      all.push_back({i, j, robot_a.model.capsules[i].radius + robot_b.model.capsules[j].radius, {}});
  }
  std::vector<model::Capsule> bodies_a, bodies_b;
  for (const Frame& frame : frames) {
    model::place_capsules(robot_a.model, robot_a.X_WB, frame.joints[a], bodies_a);
    model::place_capsules(robot_b.model, robot_b.X_WB, frame.joints[b], bodies_b);
    for (LinkDistance& d : all) {
      const model::Capsule& x = bodies_a[d.link_a];
      const model::Capsule& y = bodies_b[d.link_b];
      d.distance.push_back(model::segment_distance(x.a, x.b, y.a, y.b));
    }
  }
  return all;
}

std::vector<double> least_clearance(const std::vector<LinkDistance>& distances) {
  std::vector<double> least;
  if (distances.empty()) return least;
  least.assign(distances.front().distance.size(), std::numeric_limits<double>::infinity());
  for (const LinkDistance& d : distances) {
    for (std::size_t i = 0; i < least.size(); ++i) least[i] = std::min(least[i], d.distance[i] - d.prohibited);
  }
  return least;
}

std::string distance_picture(const std::string& title, const model::Cell& cell, const std::vector<CurveRun>& runs) {
  const bool links = cell.robots.size() == 2;
  const auto panels = links ? panels_of_links(cell, runs) : panels_of_robots(cell, runs);
  const std::size_t columns = links ? cell.robots[1].model.capsules.size() : std::min<std::size_t>(3, panels.size());
  const std::size_t rows = (panels.size() + columns - 1) / std::max<std::size_t>(columns, 1);
  double longest = 1, low = 0, high = 1;
  for (const Panel& panel : panels) {
    high = std::max(high, panel.limit);
    for (const auto& points : panel.curves) {
      for (const Point& p : points) {
        longest = std::max(longest, p.x);
        low = std::min(low, p.y);
        high = std::max(high, p.y);
      }
    }
  }
  const double left = 62, top = 74, gap = 16;
  const double width = (1060 - left - 16 + gap) / static_cast<double>(columns) - gap;
  const double height = links ? 110 : 150, pitch = height + 30;
  Svg svg{1060, top + pitch * static_cast<double>(rows) + 22, title};
  TextStyle heading;
  heading.size = 14;
  heading.bold = true;
  svg.text({left, 20}, title, heading);
  draw_legend(svg, left, runs, links ? "prohibited distance (sum of the radii)" : "contact");
  for (std::size_t k = 0; k < panels.size(); ++k) {
    const std::size_t row = k / columns;
    Axes axes;
    axes.left = left + (width + gap) * static_cast<double>(k % columns);
    axes.top = top + pitch * static_cast<double>(row);
    axes.width = width;
    axes.height = height;
    axes.x1 = longest;
    axes.y0 = std::floor(low / 100) * 100;
    axes.y1 = std::ceil(high / 100) * 100;
    draw_panel(svg, axes, panels[k], k + columns >= panels.size(), k % columns == 0);
  }
  TextStyle unit;
  unit.anchor = Anchor::middle;
  svg.text({left + (1060 - left) / 2, top + pitch * static_cast<double>(rows) + 12}, "time after the start of the program [s]", unit);
  unit.upwards = true;
  svg.text({16, top + pitch * static_cast<double>(rows) / 2}, links ? "distance between the links' axes [mm]" : "least clearance [mm]",
           unit);
  return svg.str();
}

}  // namespace interlace::reproduce
