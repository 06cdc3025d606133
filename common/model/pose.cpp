#include "common/model/pose.hpp"

#include <cmath>

namespace interlace::model {

Quaternion rotation_from_rpy(const Vector3& rpy) {
  return Quaternion{Eigen::AngleAxisd{rpy.z(), Vector3::UnitZ()} * Eigen::AngleAxisd{rpy.y(), Vector3::UnitY()} *
                    Eigen::AngleAxisd{rpy.x(), Vector3::UnitX()}};
}

Vector3 rpy_of(const Eigen::Matrix3d& R) {
  constexpr double kUpright = 1e-9;  // cosine of the pitch below which roll and yaw turn about the same axis
  const double cosine = std::hypot(R(0, 0), R(1, 0));
  const double pitch = std::atan2(-R(2, 0), cosine);
  if (cosine < kUpright) return {0, pitch, std::atan2(-R(0, 1), R(1, 1))};
  return {std::atan2(R(2, 1), R(2, 2)), pitch, std::atan2(R(1, 0), R(0, 0))};
}

Pose make_pose(const Vector3& p, const Quaternion& q) {
  Pose X = Pose::Identity();
  X.linear() = q.normalized().toRotationMatrix();
  X.translation() = p;
  return X;
}

double nearest_turn(double angle, double reference) {
  return angle + 2 * kPi * std::round((reference - angle) / (2 * kPi));
}

double angle_between(const Quaternion& a, const Quaternion& b) {
  const Quaternion d = a.conjugate() * b;
  return 2 * std::atan2(d.vec().norm(), std::abs(d.w()));
}

}  // namespace interlace::model
