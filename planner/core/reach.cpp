#include "planner/core/reach.hpp"

#include <algorithm>
#include <cmath>

namespace interlace::core {

namespace {

/// Radius [m] around the shoulder's height on axis 1 that no point of the robot leaves, whatever its joints.
double reach_radius(const model::RobotModel& m) {
  const auto& p = m.kinematics.parameters();
  const double forearm = m.kinematics.forearm_length();
  // Farthest an origin of each link's frame can be from the point at height c1 on axis 1, plus the capsule's own extent.
  const double shoulder = std::abs(p.a1);
  const double elbow = shoulder + std::hypot(p.b, p.c2);
  const double wrist = elbow + forearm;
  const double flange = wrist + std::abs(p.c4);
  const std::array<double, 7> origin{p.c1, p.c1, shoulder, elbow, wrist, wrist, flange};
  double radius = 0;
  for (const auto& c : m.capsules) radius = std::max(radius, origin[c.link] + std::max(c.a.norm(), c.b.norm()) + c.radius);
  return radius;
}

}  // namespace

bool enters_reach(SampledMotion& motion, const model::Robot& other) {
  const Vector3 centre = other.X_WB * Vector3{0, 0, other.model.kinematics.parameters().c1};
  const double radius = reach_radius(other.model);
  const int level = std::min(motion.depth(), 5);
  for (std::size_t index = 0; index < (std::size_t{1} << level); ++index) {
    const auto& piece = motion.piece(level, index);
    for (std::size_t i = 0; i < piece.bodies.size(); ++i) {
      const Body& b = piece.bodies[i];
      const double apart = (b.centre - centre).norm() - b.half_length - b.radius - piece.reach[i];
      if (apart <= radius) return true;
    }
  }
  return false;
}

}  // namespace interlace::core
