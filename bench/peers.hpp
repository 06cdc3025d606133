#pragma once

#include <fcl/narrowphase/distance.h>

#include <cstddef>
#include <vector>

#include "common/model/motion.hpp"
#include "planner/core/clearance.hpp"

namespace interlace::bench {

/// A capsule as FCL takes it: its axis, a capsule of radius zero, in its pose, and the radius beside it.
struct PosedCapsule {
  fcl::Capsuled axis;
  fcl::Transform3d X_WC;
  double radius;
};

/// Postures of a motion every `step` [s], its end included; one for a rest.
[[nodiscard]] std::vector<std::vector<PosedCapsule>> posed(const model::Motion& motion, double step);
[[nodiscard]] std::vector<std::vector<core::Body>> bodies(const model::Motion& motion, double step);

/// A pair of motions on the grid of the plane (τ, t), as the dissertation samples it (equation 3.10), for every pair of their capsules.
/// Each function computes all distances of one point of the grid and returns the least clearance [m].
[[nodiscard]] double by_fcl(const std::vector<PosedCapsule>& own, const std::vector<PosedCapsule>& other);
[[nodiscard]] double in_closed_form(const std::vector<core::Body>& own, const std::vector<core::Body>& other);

/// FCL's continuous collision of every pair of capsules while both robots go on to their next postures: one step of the diagonal of the
/// plane that belongs to one shift of the start. True when some pair touches.
[[nodiscard]] bool by_continuous_collision(const std::vector<PosedCapsule>& own, const std::vector<PosedCapsule>& own_next,
                                           const std::vector<PosedCapsule>& other, const std::vector<PosedCapsule>& other_next);

}  // namespace interlace::bench
