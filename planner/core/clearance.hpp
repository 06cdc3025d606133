#pragma once

#include "common/model/robot_model.hpp"

namespace interlace::core {

using model::Vector3;

/// A capsule in the form the maps measure: the ends of its axis, what its bounding sphere needs, and the radius beside it.
struct Body {
  Vector3 a = Vector3::Zero(), b = Vector3::Zero();  ///< ends of the axis in the world [m]
  Vector3 centre = Vector3::Zero();                  ///< half way between them [m]
  double half_length = 0;                            ///< of the axis [m]
  double radius = 0;                                 ///< [m]

  Body() = default;
  explicit Body(const model::Capsule& c) : Body(c.a, c.b, (c.b - c.a).norm() / 2, c.radius) {}
  Body(const Vector3& end_a, const Vector3& end_b, double half, double r)
      : a(end_a), b(end_b), centre((end_a + end_b) / 2), half_length(half), radius(r) {}
};

/// Signed distance [m] between two capsules: axis distance by FCL minus the radii, exact down to −(r_a + r_b). ≤ 0 is a collision.
/// FCL's capsule distance is its distance of two segments whose ends it takes from shapes and poses; our bodies have the ends, so they go
/// there directly. tests/property/clearance_test.cpp holds both against each other.
/// Source: dissertation eq. 3.3; DESIGN section 5 on why the axes are measured and not the capsules.
[[nodiscard]] double clearance(const Body& a, const Body& b);

/// No clearance between the two can be below this [m]; cheap (bounding spheres). Only for skipping pairs.
[[nodiscard]] double clearance_lower_bound(const Body& a, const Body& b);

/// Whether that lower bound is above `least` [m], without a root. Only for skipping pairs.
[[nodiscard]] inline bool surely_farther(const Body& a, const Body& b, double least) {
  const double apart = least + a.half_length + b.half_length + a.radius + b.radius;
  return apart < 0 || (a.centre - b.centre).squaredNorm() > apart * apart;
}

/// World point half way between the nearest points of the two axes [m].
[[nodiscard]] Vector3 meeting_point(const Body& a, const Body& b);

}  // namespace interlace::core
