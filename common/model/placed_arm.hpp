#pragma once

#include "common/model/kinematics.hpp"

namespace interlace::model {

/// An arm in one posture, as displacement bounds look at it. Refers to what others hold.
struct PlacedArm {
  const LinkFrames& X;  ///< of the links, in the base frame
  const Vector3* ends;  ///< of the capsules' axes in the base frame, two for each in the order of the model [m]
};

}  // namespace interlace::model
