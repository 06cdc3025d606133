#pragma once

#include <cstddef>

#include "planner/core/sampled_motion.hpp"

namespace interlace::core {

// What a look ahead counts as its work: 1 is a look at the intervals of one pair of motions, with which the rest is compared. A map counts
// the same whether it is there already or not, so that a plan does not depend on who built it and when.
inline constexpr double kWorkPerSecond = 64e6;
inline constexpr std::size_t kMapWork = 1000;
inline constexpr std::size_t kEvaluationWork = 3;  // of one distance in a map
inline constexpr std::size_t kAdmitWork = 2500;
inline constexpr std::size_t kReachWork = 5000;
inline constexpr std::size_t kGrantWork = 40;
inline constexpr std::size_t kStopWork = 10;
inline constexpr std::size_t kNodeWork = 10;

[[nodiscard]] inline bool same_place(const model::Joints& a, const model::Joints& b) {
  constexpr double kSamePlace = 1e-9;  // [rad]
  return (a - b).cwiseAbs().maxCoeff() <= kSamePlace;
}

[[nodiscard]] inline bool same_way(const SampledMotion& a, const SampledMotion& b) {
  return same_place(a.motion().from(), b.motion().from()) && same_place(a.motion().to(), b.motion().to());
}

[[nodiscard]] inline model::Duration duration_of(const SampledMotionPtr& motion) {
  return model::from_seconds(motion->motion().duration());
}

}  // namespace interlace::core
