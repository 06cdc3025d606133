#include "monitor/proximity.hpp"

#include <algorithm>
#include <limits>

#include "common/model/fixture_distance.hpp"
#include "common/model/segment_distance.hpp"

namespace interlace::monitor {

namespace {

constexpr double kNothing = std::numeric_limits<double>::infinity();

double distance(const model::Capsule& x, const model::Capsule& y) {
  const double apart = ((x.a + x.b - y.a - y.b).norm() - (x.b - x.a).norm() - (y.b - y.a).norm()) / 2 - x.radius - y.radius;
  return apart > kFar ? apart : model::segment_distance(x.a, x.b, y.a, y.b) - x.radius - y.radius;
}

double distance(const model::Capsule& body, const model::Fixture& fixture) {
  const double apart = model::clearance_lower_bound(body, fixture);
  return apart > kFar ? apart : model::clearance(body, fixture);
}

}  // namespace

Proximity measure(const model::Cell& cell, const std::vector<std::pair<model::RobotIndex, model::RobotIndex>>& pairs,
                  const std::vector<PlacedRobot>& robots) {
  Proximity near;
  for (const PlacedRobot& robot : robots) near.capsules.emplace_back(robot.bodies.size(), kNothing);
  for (const auto& [a, b] : pairs) {
    auto& least = near.pairs.emplace_back();
    if (!robots[a].known() || !robots[b].known()) continue;
    least = kNothing;
    for (std::size_t i = 0; i < robots[a].bodies.size(); ++i) {
      for (std::size_t j = 0; j < robots[b].bodies.size(); ++j) {
        const double d = distance(robots[a].bodies[i], robots[b].bodies[j]);
        near.capsules[a][i] = std::min(near.capsules[a][i], d);
        near.capsules[b][j] = std::min(near.capsules[b][j], d);
        least = std::min(*least, d);
      }
    }
  }
  for (model::RobotIndex r = 0; r < robots.size(); ++r) {
    auto& least = near.fixtures.emplace_back();
    if (!robots[r].known()) continue;
    for (const model::Fixture& fixture : cell.fixtures) {
      for (std::size_t i = 0; i < robots[r].bodies.size(); ++i) {
        if (robots[r].robot->model.capsules[i].link == 0) continue;
        const double d = distance(robots[r].bodies[i], fixture);
        near.capsules[r][i] = std::min(near.capsules[r][i], d);
        least = std::min(least.value_or(kNothing), d);
      }
    }
  }
  return near;
}

}  // namespace interlace::monitor
