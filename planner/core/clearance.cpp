#include "planner/core/clearance.hpp"

#include <fcl/narrowphase/detail/primitive_shape_algorithm/capsule_capsule.h>

#include <cmath>

namespace interlace::core {

namespace {

struct Nearest {
  double squared_distance;
  Vector3 on_a, on_b;
};

Nearest nearest(const Body& a, const Body& b) {
  Nearest n;
  double s = 0;
  double t = 0;
  n.squared_distance = fcl::detail::closestPtSegmentSegment(a.a, a.b, b.a, b.b, &s, &t, &n.on_a, &n.on_b);
  return n;
}

}  // namespace

double clearance(const Body& a, const Body& b) {
  return std::sqrt(nearest(a, b).squared_distance) - a.radius - b.radius;
}

double clearance_lower_bound(const Body& a, const Body& b) {
  return (a.centre - b.centre).norm() - a.half_length - b.half_length - a.radius - b.radius;
}

Vector3 meeting_point(const Body& a, const Body& b) {
  const Nearest n = nearest(a, b);
  return (n.on_a + n.on_b) / 2;
}

}  // namespace interlace::core
