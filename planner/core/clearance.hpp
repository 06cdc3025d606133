#pragma once

#include <fcl/geometry/shape/capsule.h>

#include <vector>

#include "common/model/robot_model.hpp"

namespace interlace::core {

using model::Vector3;

/// A capsule in the form FCL measures: the axis as a capsule of radius zero in its pose, and the radius beside it.
struct Body {
  const fcl::Capsuled* axis = nullptr;  ///< lies along z of X_WC, centred; shared by all postures of the robot
  fcl::Transform3d X_WC = fcl::Transform3d::Identity();
  double radius = 0;  ///< [m]
};

/// The FCL axes of a robot's capsules; bodies placed with them refer to it.
class BodyShapes {
 public:
  explicit BodyShapes(const model::RobotModel& model);

  /// Bodies for capsules placed in the world, in the order of the model; `out` is resized.
  void place(const std::vector<model::Capsule>& capsules, std::vector<Body>& out) const;

 private:
  std::vector<fcl::Capsuled> axes_;
};

/// Signed distance [m] between two capsules: axis distance by FCL minus the radii, exact down to −(r_a + r_b). ≤ 0 is a collision.
/// Source: dissertation eq. 3.3; DESIGN section 5 on why the axes are measured and not the capsules.
[[nodiscard]] double clearance(const Body& a, const Body& b);

/// No clearance between the two can be below this [m]; cheap (bounding spheres). Only for skipping pairs.
[[nodiscard]] double clearance_lower_bound(const Body& a, const Body& b);

/// World point half way between the nearest points of the two axes [m].
[[nodiscard]] Vector3 meeting_point(const Body& a, const Body& b);

}  // namespace interlace::core
