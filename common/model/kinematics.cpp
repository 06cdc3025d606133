#include "common/model/kinematics.hpp"

#include <algorithm>
#include <cmath>

namespace interlace::model {

namespace {

constexpr double kWristSingular = 1e-12;

Pose rotated(const Vector3& axis, double angle, const Vector3& p) {
  Pose X = Pose::Identity();
  X.linear() = Eigen::AngleAxisd{angle, axis}.toRotationMatrix();
  X.translation() = p;
  return X;
}

/// Sign of the elbow joint (turned by psi3) in a branch: up is positive in front, negative when laid over backwards.
double elbow_sign(const Branch& branch) {
  const bool front = branch.shoulder == Branch::Shoulder::front;
  const bool up = branch.elbow == Branch::Elbow::up;
  return front == up ? 1.0 : -1.0;
}

}  // namespace

const std::array<Branch, 8>& all_branches() {
  using S = Branch::Shoulder;
  using E = Branch::Elbow;
  using W = Branch::Wrist;
  static const std::array<Branch, 8> branches{{{S::front, E::up, W::positive},
                                               {S::front, E::up, W::negative},
                                               {S::front, E::down, W::positive},
                                               {S::front, E::down, W::negative},
                                               {S::back, E::up, W::positive},
                                               {S::back, E::up, W::negative},
                                               {S::back, E::down, W::positive},
                                               {S::back, E::down, W::negative}}};
  return branches;
}

Kinematics::Kinematics(const OpwParameters& parameters)
    : p_(parameters), k_(std::hypot(parameters.a2, parameters.c3)), psi3_(std::atan2(parameters.a2, parameters.c3)) {}

Joints Kinematics::to_internal(const Joints& q) const {
  Joints r;
  for (std::size_t i = 0; i < kJoints; ++i) r[i] = q[i] * p_.signs[i] - p_.offsets[i];
  return r;
}

Joints Kinematics::to_external(const Joints& q) const {
  Joints r;
  for (std::size_t i = 0; i < kJoints; ++i) r[i] = nearest_turn((q[i] + p_.offsets[i]) * p_.signs[i], 0.0);
  return r;
}

LinkFrames Kinematics::forward(const Joints& q_external) const {
  const Joints q = to_internal(q_external);
  LinkFrames X;
  X[0] = Pose::Identity();
  X[1] = rotated(Vector3::UnitZ(), q[0], Vector3::Zero());
  X[2] = X[1] * rotated(Vector3::UnitY(), q[1], {p_.a1, 0, p_.c1});
  X[3] = X[2] * rotated(Vector3::UnitY(), q[2], {0, p_.b, p_.c2});
  X[4] = X[3] * rotated(Vector3::UnitZ(), q[3], {p_.a2, 0, p_.c3});
  X[5] = X[4] * rotated(Vector3::UnitY(), q[4], Vector3::Zero());
  X[6] = X[5] * rotated(Vector3::UnitZ(), q[5], {0, 0, p_.c4});
  return X;
}

Pose Kinematics::flange(const Joints& q) const {
  return forward(q)[6];
}

std::optional<ArmTriangle> Kinematics::triangle(const Vector3& p_BW, Branch::Shoulder shoulder) const {
  const double squared = p_BW.x() * p_BW.x() + p_BW.y() * p_BW.y() - p_.b * p_.b;
  constexpr double kRounding = 1e-15;  // [m²] of a wrist that is as near to axis 1 as the offset lets it come
  if (squared < -kRounding) return std::nullopt;
  const double radial = std::sqrt(std::max(squared, 0.0));
  ArmTriangle t{};
  t.radial = shoulder == Branch::Shoulder::front ? radial : -radial;
  t.x = t.radial - p_.a1;
  t.z = p_BW.z() - p_.c1;
  t.distance = std::sqrt(t.x * t.x + t.z * t.z);
  return t;
}

std::optional<Joints> Kinematics::inverse(const Pose& X_BF, const Branch& branch) const {
  const Vector3 p_BW = wrist_centre(X_BF);
  const auto arm = triangle(p_BW, branch.shoulder);
  if (!arm) return std::nullopt;

  // Half-angle form of the law of cosines: exact where acos loses half its digits (arm nearly stretched or folded).
  const double stretched = (p_.c2 + k_) * (p_.c2 + k_) - arm->distance * arm->distance;
  const double folded = arm->distance * arm->distance - (p_.c2 - k_) * (p_.c2 - k_);
  constexpr double kRounding = 1e-14;  // [m²] rounding of a stretched arm's own pose; 0.02 µm of reach
  if (stretched < -kRounding || folded < -kRounding) return std::nullopt;
  const double bend = elbow_sign(branch) * 2 * std::atan2(std::sqrt(std::max(stretched, 0.0)), std::sqrt(std::max(folded, 0.0)));
  const double alpha = std::atan2(k_ * std::sin(bend), p_.c2 + k_ * std::cos(bend));

  Joints q;
  q[0] = std::atan2(p_BW.y(), p_BW.x()) - std::atan2(p_.b, arm->radial);
  q[1] = std::atan2(arm->x, arm->z) - alpha;
  q[2] = bend - psi3_;

  const Eigen::Matrix3d R_B3 =
      (Eigen::AngleAxisd{q[0], Vector3::UnitZ()} * Eigen::AngleAxisd{q[1] + q[2], Vector3::UnitY()}).toRotationMatrix();
  const Eigen::Matrix3d R_36 = R_B3.transpose() * X_BF.linear();
  const double s5 = std::hypot(R_36(0, 2), R_36(1, 2));
  const double sign = branch.wrist == Branch::Wrist::positive ? 1.0 : -1.0;
  q[3] = s5 < kWristSingular ? 0.0 : std::atan2(sign * R_36(1, 2), sign * R_36(0, 2));
  // The rest from what is left once joint 4 is turned back: exact in orientation also where joint 4 itself is hardly determined.
  const double c4 = std::cos(q[3]);
  const double s4 = std::sin(q[3]);
  q[4] = std::atan2(c4 * R_36(0, 2) + s4 * R_36(1, 2), R_36(2, 2));
  q[5] = std::atan2(c4 * R_36(1, 0) - s4 * R_36(0, 0), c4 * R_36(1, 1) - s4 * R_36(0, 1));
  return to_external(q);
}

bool Kinematics::frames(const Pose& X_BF, const Branch& branch, LinkFrames& X) const {
  const Vector3 p_BW = wrist_centre(X_BF);
  const auto arm = triangle(p_BW, branch.shoulder);
  if (!arm) return false;

  // Cosine and sine of joint 1: the wrist's azimuth less that of the lateral offset, as a quotient of complex numbers.
  const double across = std::sqrt((p_BW.x() * p_BW.x() + p_BW.y() * p_BW.y()) * (arm->radial * arm->radial + p_.b * p_.b));
  if (across <= 0 || arm->distance <= 0) return false;
  const double c1 = (p_BW.x() * arm->radial + p_BW.y() * p_.b) / across;
  const double s1 = (p_BW.y() * arm->radial - p_BW.x() * p_.b) / across;

  // The elbow's bend from the sides of the triangle, its sine by Heron's formula.
  const double squared = arm->x * arm->x + arm->z * arm->z;
  const double stretched = (p_.c2 + k_) * (p_.c2 + k_) - squared;
  const double folded = squared - (p_.c2 - k_) * (p_.c2 - k_);
  constexpr double kRounding = 1e-14;  // [m²] as in `inverse`
  if (stretched < -kRounding || folded < -kRounding) return false;
  const double twice = 2 * p_.c2 * k_;
  const double cos_bend = std::clamp((squared - p_.c2 * p_.c2 - k_ * k_) / twice, -1.0, 1.0);
  const double sin_bend = elbow_sign(branch) * std::sqrt(std::max(stretched, 0.0) * std::max(folded, 0.0)) / twice;
  const double along = p_.c2 + k_ * cos_bend;  // wrist as the upper arm sees it, along it and square to it
  const double aside = k_ * sin_bend;
  const double reach = std::sqrt(squared * (along * along + aside * aside));
  if (reach <= 0) return false;
  const double c2 = (arm->z * along + arm->x * aside) / reach;
  const double s2 = (arm->x * along - arm->z * aside) / reach;
  const double c_wrist = c2 * cos_bend - s2 * sin_bend;  // of the direction elbow → wrist
  const double s_wrist = s2 * cos_bend + c2 * sin_bend;
  const double c3 = (c_wrist * p_.c3 + s_wrist * p_.a2) / k_;
  const double s3 = (s_wrist * p_.c3 - c_wrist * p_.a2) / k_;

  const Vector3 sideways{-s1, c1, 0};
  const auto place_in_arm_plane = [&](Pose& link, double c, double s, const Vector3& p) {
    link.linear().col(0) = Vector3{c * c1, c * s1, -s};
    link.linear().col(1) = sideways;
    link.linear().col(2) = Vector3{s * c1, s * s1, c};
    link.translation() = p;
    link.makeAffine();
  };
  X[0] = Pose::Identity();
  place_in_arm_plane(X[1], 1, 0, Vector3::Zero());
  place_in_arm_plane(X[2], c2, s2, Vector3{p_.a1 * c1, p_.a1 * s1, p_.c1});
  place_in_arm_plane(X[3], c3, s3, X[2].translation() + p_.b * sideways + p_.c2 * X[2].linear().col(2));
  X[6] = X_BF;

  // The wrist: axis 5 is square to both the forearm's axis and the hand's.
  const Vector3 hand = X_BF.linear().col(2);
  const double x = X[3].linear().col(0).dot(hand);
  const double y = sideways.dot(hand);
  const double s5 = std::sqrt(x * x + y * y);
  const double sign = branch.wrist == Branch::Wrist::positive ? 1.0 : -1.0;
  const double c4 = s5 < kWristSingular ? 1.0 : sign * x / s5;
  const double s4 = s5 < kWristSingular ? 0.0 : sign * y / s5;
  X[4].linear().col(0) = c4 * X[3].linear().col(0) + s4 * sideways;
  X[4].linear().col(1) = c4 * sideways - s4 * X[3].linear().col(0);
  X[4].linear().col(2) = X[3].linear().col(2);
  X[4].translation() = p_BW;
  X[4].makeAffine();
  X[5].linear().col(0) = X[4].linear().col(1).cross(hand);
  X[5].linear().col(1) = X[4].linear().col(1);
  X[5].linear().col(2) = hand;
  X[5].translation() = p_BW;
  X[5].makeAffine();
  return true;
}

Branch Kinematics::branch_of(const Joints& q_external) const {
  const Joints q = to_internal(q_external);
  // Signed distance of the wrist from axis 1 in the arm's plane; its sign is the shoulder branch.
  const double radial = p_.a1 + p_.c2 * std::sin(q[1]) + k_ * std::sin(q[1] + q[2] + psi3_);
  Branch branch;
  branch.shoulder = radial >= 0 ? Branch::Shoulder::front : Branch::Shoulder::back;
  const bool positive = std::sin(q[2] + psi3_) >= 0;
  const bool front = branch.shoulder == Branch::Shoulder::front;
  branch.elbow = positive == front ? Branch::Elbow::up : Branch::Elbow::down;
  branch.wrist = std::sin(q[4]) >= 0 ? Branch::Wrist::positive : Branch::Wrist::negative;
  return branch;
}

}  // namespace interlace::model
