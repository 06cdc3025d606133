#include "common/model/robot_model.hpp"

#include <cmath>
#include <stdexcept>

namespace interlace::model {

namespace {

constexpr double kLimitSlack = 1e-9;  // [rad] rounding of an angle that sits on its limit

/// Section of the arm a link belongs to: 0 base and turret, 1 upper arm, 2 forearm and the wrist's roll, 3 hand.
std::size_t section_of(std::size_t link) {
  if (link <= 1) return 0;
  if (link == 2) return 1;
  if (link <= 4) return 2;
  return 3;
}

/// `q` with each joint turned by whole turns into its limits where that is possible, staying nearest to zero.
Joints turned_into_limits(const JointLimits& limits, Joints q) {
  for (std::size_t i = 0; i < kJoints; ++i) {
    if (q[i] < limits.min[i] - kLimitSlack && q[i] + 2 * kPi <= limits.max[i] + kLimitSlack) q[i] += 2 * kPi;
    if (q[i] > limits.max[i] + kLimitSlack && q[i] - 2 * kPi >= limits.min[i] - kLimitSlack) q[i] -= 2 * kPi;
  }
  return q;
}

}  // namespace

std::vector<LinkCapsule> chain_capsules(const OpwParameters& p, const Pose& X_FT, const std::array<double, 4>& radii) {
  if (p.a1 != 0 || p.a2 != 0 || p.b != 0) throw std::invalid_argument("a chain of capsules needs an arm without offsets (a1 = a2 = b = 0)");
  return {{"base", 0, {0, 0, 0}, {0, 0, p.c1}, radii[0]},
          {"link1", 2, {0, 0, 0}, {0, 0, p.c2}, radii[1]},
          {"link2", 3, {0, 0, 0}, {0, 0, p.c3}, radii[2]},
          {"eef", 6, {0, 0, -p.c4}, X_FT.translation(), radii[3]}};
}

std::vector<std::pair<std::size_t, std::size_t>> default_self_pairs(const std::vector<LinkCapsule>& capsules) {
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t i = 0; i < capsules.size(); ++i) {
    for (std::size_t j = i + 1; j < capsules.size(); ++j) {
      const auto si = section_of(capsules[i].link);
      const auto sj = section_of(capsules[j].link);
      if ((si > sj ? si - sj : sj - si) >= 3) pairs.emplace_back(i, j);
    }
  }
  return pairs;
}

Pose tcp_pose(const RobotModel& model, const Joints& q) {
  return model.kinematics.flange(q) * model.X_FT;
}

void place_capsules(const RobotModel& model, const Pose& X_WB, const Joints& q, std::vector<Capsule>& out) {
  const LinkFrames X = model.kinematics.forward(q);
  out.resize(model.capsules.size());
  for (std::size_t i = 0; i < model.capsules.size(); ++i) {
    const LinkCapsule& c = model.capsules[i];
    const Pose X_WL = X_WB * X[c.link];
    out[i] = {X_WL * c.a, X_WL * c.b, c.radius};
  }
}

std::optional<std::size_t> joint_outside_limits(const JointLimits& limits, const Joints& q) {
  for (std::size_t i = 0; i < kJoints; ++i) {
    if (q[i] < limits.min[i] - kLimitSlack || q[i] > limits.max[i] + kLimitSlack) return i;
  }
  return std::nullopt;
}

std::optional<Joints> preferred_posture(const RobotModel& model, const Pose& X_BT, const std::function<bool(const Branch&)>& admits) {
  const Pose X_BF = X_BT * model.X_FT.inverse();
  const auto& branches = all_branches();
  for (std::size_t i = 0; i < branches.size(); i += 2) {  // pairs that differ in the wrist only
    std::optional<Joints> best;
    for (std::size_t k = i; k < i + 2; ++k) {
      if (admits && !admits(branches[k])) continue;
      const auto found = model.kinematics.inverse(X_BF, branches[k]);
      if (!found) continue;
      const Joints q = turned_into_limits(model.joints, *found);
      if (joint_outside_limits(model.joints, q)) continue;
      if (!best || std::abs(q[3]) + std::abs(q[5]) < std::abs((*best)[3]) + std::abs((*best)[5])) best = q;
    }
    if (best) return best;
  }
  return std::nullopt;
}

}  // namespace interlace::model
