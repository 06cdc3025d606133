#include "bench/peers.hpp"

#include <fcl/math/motion/interp_motion.h>
#include <fcl/narrowphase/continuous_collision.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace interlace::bench {

namespace {

/// Calls `each` with the capsules of `motion` at every step.
template <typename Each>
void walk(const model::Motion& motion, double step, const Each& each) {
  const auto steps = static_cast<std::size_t>(std::ceil(motion.duration() / step));
  std::vector<model::Capsule> capsules;
  for (std::size_t i = 0; i <= steps; ++i) {
    model::place_capsules(motion.robot().model, motion.robot().X_WB, motion.joints(step * static_cast<double>(i)), capsules);
    each(capsules);
  }
}

}  // namespace

std::vector<std::vector<PosedCapsule>> posed(const model::Motion& motion, double step) {
  std::vector<std::vector<PosedCapsule>> postures;
  walk(motion, step, [&](const std::vector<model::Capsule>& capsules) {
    auto& posture = postures.emplace_back();
    for (const model::Capsule& c : capsules) {
      fcl::Transform3d X_WC = fcl::Transform3d::Identity();
      X_WC.linear() = Eigen::Quaterniond::FromTwoVectors(model::Vector3::UnitZ(), c.b - c.a).toRotationMatrix();
      X_WC.translation() = (c.a + c.b) / 2;
      posture.push_back({fcl::Capsuled{0.0, (c.b - c.a).norm()}, X_WC, c.radius});
    }
  });
  return postures;
}

std::vector<std::vector<core::Body>> bodies(const model::Motion& motion, double step) {
  std::vector<std::vector<core::Body>> postures;
  walk(motion, step, [&](const std::vector<model::Capsule>& capsules) { postures.emplace_back(capsules.begin(), capsules.end()); });
  return postures;
}

double by_fcl(const std::vector<PosedCapsule>& own, const std::vector<PosedCapsule>& other) {
  double least = std::numeric_limits<double>::infinity();
  for (const PosedCapsule& x : own) {
    for (const PosedCapsule& y : other) {
      const fcl::DistanceRequestd request;
      fcl::DistanceResultd result;
      least = std::min(least, fcl::distance(&x.axis, x.X_WC, &y.axis, y.X_WC, request, result) - x.radius - y.radius);
    }
  }
  return least;
}

double in_closed_form(const std::vector<core::Body>& own, const std::vector<core::Body>& other) {
  double least = std::numeric_limits<double>::infinity();
  for (const core::Body& x : own) {
    for (const core::Body& y : other) least = std::min(least, core::clearance(x, y));
  }
  return least;
}

bool by_continuous_collision(const std::vector<PosedCapsule>& own, const std::vector<PosedCapsule>& own_next,
                             const std::vector<PosedCapsule>& other, const std::vector<PosedCapsule>& other_next) {
  bool touches = false;
  fcl::ContinuousCollisionRequestd request;
  request.ccd_solver_type = fcl::CCDC_CONSERVATIVE_ADVANCEMENT;
  request.ccd_motion_type = fcl::CCDM_LINEAR;
  for (std::size_t i = 0; i < own.size(); ++i) {
    const fcl::Capsuled x{own[i].radius, own[i].axis.lz};
    const fcl::InterpMotion<double> x_moves{own[i].X_WC, own_next[i].X_WC};
    for (std::size_t j = 0; j < other.size(); ++j) {
      const fcl::Capsuled y{other[j].radius, other[j].axis.lz};
      const fcl::InterpMotion<double> y_moves{other[j].X_WC, other_next[j].X_WC};
      fcl::ContinuousCollisionResultd result;
      fcl::continuousCollide(&x, &x_moves, &y, &y_moves, request, result);
      touches = touches || result.is_collide;
    }
  }
  return touches;
}

}  // namespace interlace::bench
