#pragma once

#include "common/model/joint_sweep.hpp"
#include "common/model/placed_arm.hpp"
#include "common/model/robot_model.hpp"

namespace interlace::model {

/// Displacement bound [m] of every point of each capsule that `arm` asks for, from the sweep of the joints alone, for an arm that is at
/// `arm` at the centre. `out` has room for all capsules. Proof: docs/certificate.md, section 1.
void displacement_by_joints(const RobotModel& model, const PlacedArm& arm, const JointSweep& sweep, double* out);

/// Likewise from what is known of the hand. Proof: docs/certificate.md, sections 2 and 3.
void displacement_by_hand(const RobotModel& model, const Branch& branch, const PlacedArm& arm, const HandSweep& hand, double* out);

}  // namespace interlace::model
