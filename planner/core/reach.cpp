#include "planner/core/reach.hpp"

#include <algorithm>
#include <cmath>

namespace interlace::core {

namespace {

/// Distances here are sums of a few lengths below some metres [m].
constexpr double kReachRounding = 1e-9;

}  // namespace

ReachableVolume reachable_volume(const model::Robot& robot) {
  const auto& p = robot.model.kinematics.parameters();
  const double shoulder = std::abs(p.a1);
  const double elbow = std::hypot(shoulder + std::abs(p.c2), p.b);
  const double wrist = std::hypot(shoulder + std::abs(p.c2) + robot.model.kinematics.forearm_length(), p.b);
  // Of each link: a point fixed to it (in its frame) and how far that point can be from the centre. The capsules turn about that point.
  struct Pivot {
    Vector3 place;
    double distance;
  };
  const Vector3 centre{0, 0, p.c1};
  const std::array<Pivot, 7> pivots{{{centre, 0},
                                     {centre, 0},
                                     {Vector3::Zero(), shoulder},
                                     {Vector3::Zero(), elbow},
                                     {Vector3::Zero(), wrist},
                                     {Vector3::Zero(), wrist},
                                     {{0, 0, -p.c4}, wrist}}};
  const double error = robot.controller.path_error + kReachRounding;
  ReachableVolume volume{robot.X_WB * centre, 0};
  for (const auto& c : robot.model.capsules) {
    const Pivot& pivot = pivots[c.link];
    const double extent = std::max((c.a - pivot.place).norm(), (c.b - pivot.place).norm()) + c.radius;
    volume.radius = std::max(volume.radius, pivot.distance + extent + error);
  }
  return volume;
}

ReachableVolume reachable_volume(const model::Cell& cell, model::RobotIndex robot) {
  return reachable_volume(model::with_tools(cell.robots[robot], cell.tools, cell.all_tools()));
}

bool enters_reach(SampledMotion& motion, const ReachableVolume& volume) {
  for (SampledMotion* standing : {&motion.at_start(), &motion.at_end()}) {
    if (standing != &motion && enters_reach(*standing, volume)) return true;
  }
  const int level = std::min(motion.depth(), 5);
  for (std::size_t index = 0; index < (std::size_t{1} << level); ++index) {
    const auto& piece = motion.piece(level, index);
    for (std::size_t i = 0; i < piece.bodies.size(); ++i) {
      const Body& b = piece.bodies[i];
      const double apart = (b.centre - volume.centre).norm() - b.half_length - b.radius - piece.reach[i];
      if (apart <= volume.radius) return true;
    }
  }
  return false;
}

}  // namespace interlace::core
