#pragma once

#include <algorithm>
#include <cstdint>

#include "common/model/kinematics.hpp"

namespace interlace::model {

/// Which capsules of a model are asked for: one bit for each, all from the 64th on share the last.
using CapsuleSet = std::uint64_t;
inline constexpr CapsuleSet kAllCapsules = ~CapsuleSet{0};

[[nodiscard]] inline CapsuleSet only_capsule(std::size_t i) {
  return CapsuleSet{1} << std::min<std::size_t>(i, 63);
}

/// An arm in one posture, as displacement bounds look at it. Refers to what others hold.
struct PlacedArm {
  const LinkFrames& X;  ///< of the links, in the base frame
  const Vector3* ends;  ///< of the capsules' axes in the base frame, two for each in the order of the model [m]
  CapsuleSet wanted = kAllCapsules;
};

}  // namespace interlace::model
