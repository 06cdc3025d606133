#pragma once

#include <array>
#include <vector>

#include "common/model/robot_model.hpp"

namespace interlace::model {

/// Largest change of each joint angle [rad] inside an interval, from its value at the interval's centre. π stands for "any".
using JointSweep = Joints;

/// Where the hand may be inside a piece of a straight line, seen from the piece's centre, in the base frame. Before the centre it is
/// between `tcp[0]`, `turn[0]` and the centre, after it between the centre and `tcp[1]`, `turn[1]`; both change at their own pace.
struct HandSweep {
  std::array<Vector3, 2> tcp{Vector3::Zero(), Vector3::Zero()};  ///< displacement of the TCP at both ends [m]
  Vector3 axis = Vector3::UnitZ();                               ///< unit axis of the rotation
  std::array<double, 2> turn{};                                  ///< angle about it at both ends, ≤ 0 and ≥ 0 [rad]
};

/// Where the wrist centre may be, seen from its place at the piece's centre: within `sag` [m] of the convex hull of `corners` [m], which
/// holds the origin to within `sag`.
struct WristSweep {
  std::array<Vector3, 4> corners;
  double sag = 0;
  [[nodiscard]] double radius() const;  ///< of a ball that holds it all [m]
};

/// Bounds of the joints' sweep for an arm that is at `q` (in `branch`) at the centre and whose wrist centre stays within `wrist` while its
/// flange's orientation stays within `rotation` [rad] of there. Proof: docs/certificate.md, section 2.
[[nodiscard]] JointSweep joint_sweep(const Kinematics& kinematics, const Branch& branch, const Joints& q, const WristSweep& wrist,
                                     double rotation);

/// Displacement bound [m] of every point of each capsule, from the sweep of the joints alone.
/// Proof: docs/certificate.md, section 1.
void displacement_by_joints(const RobotModel& model, const Joints& q, const JointSweep& sweep, std::vector<double>& out);

/// As above, tightened by what is known of the hand.
void displacement_by_hand(const RobotModel& model, const Branch& branch, const Joints& q, const HandSweep& hand, std::vector<double>& out);

}  // namespace interlace::model
