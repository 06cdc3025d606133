#pragma once

#include "common/ros2/messages.hpp"
#include "monitor/cell_picture.hpp"

/// Shapes to draw, in the world frame. Pure.
namespace interlace::monitor {

/// A marker lives this long without being told again, so that nobody looks at arms that nothing is known of any more [s].
inline constexpr int kMarkerLifetime = 1;

/// The capsules of every robot that was heard, with what it holds, each as a cylinder with a sphere at each end. `ns` is the robot. Blue
/// where nothing is near, orange within 50 mm of another body, red at contact; grey and half transparent while its robot is silent.
[[nodiscard]] ros2::MarkerArray capsule_markers(const CellPicture& picture, ros2::Time stamp);

/// The fixtures; `ns` is the name. Of a plane a square of 4 m around its point nearest to the origin of its frame.
[[nodiscard]] ros2::MarkerArray fixture_markers(const model::Cell& cell, ros2::Time stamp);

}  // namespace interlace::monitor
