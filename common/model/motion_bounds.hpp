#pragma once

#include <vector>

#include "common/model/robot_model.hpp"

namespace interlace::model {

/// Largest change of each joint angle [rad] inside an interval, from its value at the interval's centre. π stands for "any".
using JointSweep = Joints;

/// How far the hand may be from where it is at the centre of an interval: the exact bounds a straight line's time laws give.
struct HandSweep {
  double tcp = 0;       ///< of the TCP [m]
  double rotation = 0;  ///< of the orientation [rad]
};

/// Bounds of the joints' sweep for an arm that is at `q` (in `branch`) at the centre and whose wrist centre stays within `wrist` [m] of
/// there while its flange's orientation stays within `rotation` [rad]. Proof: docs/certificate.md, section 2.
[[nodiscard]] JointSweep joint_sweep(const Kinematics& kinematics, const Branch& branch, const Joints& q, double wrist, double rotation);

/// Displacement bound [m] of every point of each capsule, from the sweep of the joints alone.
/// Proof: docs/certificate.md, section 1.
void displacement_by_joints(const RobotModel& model, const Joints& q, const JointSweep& sweep, std::vector<double>& out);

/// As above, tightened by what is known of the hand.
void displacement_by_hand(const RobotModel& model, const Branch& branch, const Joints& q, const HandSweep& hand, std::vector<double>& out);

}  // namespace interlace::model
