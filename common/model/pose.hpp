#pragma once

#include <Eigen/Geometry>
#include <array>

namespace interlace::model {

using Vector3 = Eigen::Vector3d;  ///< [m] unless said otherwise
using Quaternion = Eigen::Quaterniond;
using Pose = Eigen::Isometry3d;  ///< X_AB: pose of frame B in frame A; translation [m]

inline constexpr std::size_t kJoints = 6;
using Joints = Eigen::Matrix<double, kJoints, 1>;  ///< joint angles [rad], base to flange

inline constexpr double kPi = 3.14159265358979323846;

/// Rotation of URDF rpy angles [rad]: R = Rz(yaw) · Ry(pitch) · Rx(roll).
[[nodiscard]] Quaternion rotation_from_rpy(const Vector3& rpy);

/// The angles [rad] that rotation_from_rpy makes `R` of; pitch within ±π/2, roll 0 where pitch is there and only their sum counts.
[[nodiscard]] Vector3 rpy_of(const Eigen::Matrix3d& R);

/// Pose from a translation [m] and a rotation.
[[nodiscard]] Pose make_pose(const Vector3& p, const Quaternion& q);

/// `angle` [rad] plus the multiple of 2π that brings it nearest to `reference`.
[[nodiscard]] double nearest_turn(double angle, double reference);

/// Angle [rad], 0 … π, of the rotation that takes `a` to `b`.
[[nodiscard]] double angle_between(const Quaternion& a, const Quaternion& b);

}  // namespace interlace::model
