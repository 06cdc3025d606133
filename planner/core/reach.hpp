#pragma once

#include "planner/core/sampled_motion.hpp"

namespace interlace::core {

/// A ball that no point of a robot leaves, whatever its joints. World frame.
struct ReachableVolume {
  Vector3 centre = Vector3::Zero();  ///< [m]
  double radius = 0;                 ///< [m]

  /// True unless the two are more than `margin` [m] apart.
  [[nodiscard]] bool meets(const ReachableVolume& other, double margin) const {
    return (centre - other.centre).norm() <= radius + other.radius + margin;
  }
  [[nodiscard]] bool operator==(const ReachableVolume& other) const { return centre == other.centre && radius == other.radius; }
};

/// The ball around the point of axis 1 at the shoulder's height that holds all capsules of `robot` in every posture. The arm itself may be
/// stretched in any direction: joint limits are not used, so the ball is also good for a robot that has left them.
/// Proof: capsules of links 0 and 1 turn about axis 1 and keep their distance from the centre; the elbow and the wrist move in a plane at
/// the distance b from the centre, stretched at most to a1 + c2 and a1 + c2 + k; links 4 to 6 turn about the wrist centre.
[[nodiscard]] ReachableVolume reachable_volume(const model::Robot& robot);

/// The same for `robot` of `cell` whatever it holds of the cell's tools, all of them at once included.
[[nodiscard]] ReachableVolume reachable_volume(const model::Cell& cell, model::RobotIndex robot);

/// True unless it is proven that no body of `motion`, standing before and after it included, ever comes into `volume`: where a robot that
/// is not heard from could be.
[[nodiscard]] bool enters_reach(SampledMotion& motion, const ReachableVolume& volume);

}  // namespace interlace::core
