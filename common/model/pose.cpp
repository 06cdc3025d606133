#include "common/model/pose.hpp"

#include <cmath>

namespace interlace::model {

Quaternion rotation_from_rpy(const Vector3& rpy) {
  return Quaternion{Eigen::AngleAxisd{rpy.z(), Vector3::UnitZ()} * Eigen::AngleAxisd{rpy.y(), Vector3::UnitY()} *
                    Eigen::AngleAxisd{rpy.x(), Vector3::UnitX()}};
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
