#pragma once

#include <array>

#include "common/model/kinematics.hpp"

namespace interlace::model {

/// Largest change of each joint angle [rad] inside an interval, from its value at the interval's centre. π stands for "any".
using JointSweep = Joints;

/// Where the hand may be inside a piece of a straight line, seen from the piece's centre, in the base frame. Before the centre it is
/// between `way[0]`, `turn[0]` and the centre, after it between the centre and `way[1]`, `turn[1]`; both change at their own pace.
struct HandSweep {
  Vector3 direction = Vector3::Zero();  ///< unit vector of the TCP's translation; zero without one
  std::array<double, 2> way{};          ///< travelled by the TCP at both ends, ≤ 0 and ≥ 0 [m]
  Vector3 axis = Vector3::UnitZ();      ///< unit axis of the rotation
  std::array<double, 2> turn{};         ///< angle about it at both ends, ≤ 0 and ≥ 0 [rad]
};

/// Where the wrist centre may be, seen from its place at the piece's centre: within `sag` [m] of the convex hull of `corners` [m], which
/// holds the origin to within `sag`.
struct WristSweep {
  std::array<Vector3, 4> corners;
  double sag = 0;
};

/// The wrist centre of an arm whose TCP and orientation move as `hand` says; `p_TcpWrist` at the centre, in base axes [m].
[[nodiscard]] WristSweep wrist_sweep(const HandSweep& hand, const Vector3& p_TcpWrist);

/// Bounds of the joints' sweep for an arm that has the frames `X` (in `branch`) at the centre and whose wrist centre stays within `wrist`
/// while its flange's orientation stays within `rotation` [rad] of there. Holds for pieces of any size, next to singularities too.
/// Proof: docs/certificate.md, section 3.
[[nodiscard]] JointSweep joint_sweep(const Kinematics& kinematics, const Branch& branch, const LinkFrames& X, const WristSweep& wrist,
                                     double rotation);

/// Largest azimuth change [rad] of a direction with the polar angle's sine `s` when it tilts by at most `tilt` [rad]; π for any.
[[nodiscard]] double azimuth_sweep(double tilt, double s);

}  // namespace interlace::model
