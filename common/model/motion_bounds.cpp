#include "common/model/motion_bounds.hpp"

#include <algorithm>
#include <cmath>

namespace interlace::model {

namespace {

/// Distance of point `p` from the line through `origin` along the unit vector `axis`.
double distance_to_axis(const Vector3& p, const Vector3& origin, const Vector3& axis) {
  return axis.cross(p - origin).norm();
}

/// Axis of joint `j` (0 … 5) in the base frame for the link frames `X`: its point and direction.
std::pair<Vector3, Vector3> joint_axis(const LinkFrames& X, std::size_t j) {
  // Joint j moves link j+1; joints 1, 2 and 4 turn about their link's y axis, the others about z.
  const Pose& link = X[j + 1];
  const bool about_y = j == 1 || j == 2 || j == 4;
  return {link.translation(), link.linear().col(about_y ? 1 : 2)};
}

/// Sum over the joints of sweep × distance to the joint's axis, for point `p` fixed to link `link`.
double by_joints(const LinkFrames& X, std::size_t link, const Vector3& p, const JointSweep& sweep) {
  double sum = 0;
  for (std::size_t j = 0; j < link; ++j) {
    const auto [origin, axis] = joint_axis(X, j);
    sum += sweep[j] * distance_to_axis(p, origin, axis);
  }
  return sum;
}

/// Largest azimuth change of a direction with polar angle sine `s`, tilted by at most `tilt`.
double azimuth_sweep(double tilt, double s) {
  return tilt < kPi / 2 && std::sin(tilt) < s ? std::asin(std::sin(tilt) / s) : kPi;
}

}  // namespace

JointSweep joint_sweep(const Kinematics& kinematics, const Branch& branch, const Joints& q, double wrist, double rotation) {
  const OpwParameters& p = kinematics.parameters();
  const double k = kinematics.forearm_length();
  JointSweep sweep = JointSweep::Constant(kPi);
  const LinkFrames X = kinematics.forward(q);
  const Vector3 p_BW = X[4].translation();
  const auto arm = kinematics.triangle(p_BW, branch.shoulder);
  const double r = std::hypot(p_BW.x(), p_BW.y());
  if (!arm || r - wrist <= std::abs(p.b)) return sweep;  // the wrist may reach axis 1: any posture is possible

  // Axis 1: azimuth of the wrist, and the angle the lateral offset takes from it.
  const double radial_min = std::sqrt((r - wrist) * (r - wrist) - p.b * p.b);
  const double radial_max = std::sqrt((r + wrist) * (r + wrist) - p.b * p.b);
  const double radial = std::abs(arm->radial);
  const double lateral = std::atan2(p.b, radial);
  sweep[0] = std::asin(std::min(1.0, wrist / r)) +
             std::max(std::abs(std::atan2(p.b, radial_min) - lateral), std::abs(std::atan2(p.b, radial_max) - lateral));

  // In the arm's plane: how far the wrist moves there, then direction and triangle.
  const double planar = p.b == 0 ? wrist : std::hypot(std::max(radial_max - radial, radial - radial_min), wrist);
  const double direction = planar < arm->distance ? std::asin(planar / arm->distance) : kPi;
  const double d_min = std::clamp(arm->distance - planar, std::abs(p.c2 - k), p.c2 + k);
  const double d_max = std::clamp(arm->distance + planar, std::abs(p.c2 - k), p.c2 + k);
  const auto at_shoulder = [&](double d) {  // angle between upper arm and shoulder → wrist
    return d > 0 ? std::acos(std::clamp((d * d + p.c2 * p.c2 - k * k) / (2 * d * p.c2), -1.0, 1.0)) : kPi;
  };
  const auto at_elbow = [&](double d) {  // bend of the elbow
    return std::acos(std::clamp((d * d - p.c2 * p.c2 - k * k) / (2 * p.c2 * k), -1.0, 1.0));
  };
  const double shoulder = at_shoulder(arm->distance);
  double triangle = std::max(std::abs(at_shoulder(d_min) - shoulder), std::abs(at_shoulder(d_max) - shoulder));
  if (p.c2 > k) {  // the shoulder's angle is largest in between, where the forearm is square to shoulder → wrist
    const double extreme = std::sqrt(p.c2 * p.c2 - k * k);
    if (d_min < extreme && extreme < d_max) triangle = std::max(triangle, std::abs(at_shoulder(extreme) - shoulder));
  }
  const double elbow = at_elbow(arm->distance);
  constexpr double kAcosRounding = 1e-7;  // [rad] of acos next to ±1
  sweep[1] = std::min(kPi, direction + triangle + kAcosRounding);
  sweep[2] = std::max(std::abs(at_elbow(d_min) - elbow), std::abs(at_elbow(d_max) - elbow)) + kAcosRounding;

  // Wrist: the hand's axis as the forearm sees it tilts by no more than both orientations change.
  const double tilt = std::min(kPi, sweep[0] + sweep[1] + sweep[2] + rotation);
  const double s5 = std::abs(X[4].linear().col(2).cross(X[6].linear().col(2)).norm());
  sweep[3] = azimuth_sweep(tilt, s5);
  sweep[4] = tilt;
  sweep[5] = sweep[3];  // the same seen from the hand: its own turn is the azimuth of the forearm's axis
  return sweep;
}

void displacement_by_joints(const RobotModel& model, const Joints& q, const JointSweep& sweep, std::vector<double>& out) {
  const LinkFrames X = model.kinematics.forward(q);
  out.resize(model.capsules.size());
  for (std::size_t i = 0; i < model.capsules.size(); ++i) {
    const LinkCapsule& c = model.capsules[i];
    out[i] = std::max(by_joints(X, c.link, X[c.link] * c.a, sweep), by_joints(X, c.link, X[c.link] * c.b, sweep));
  }
}

void displacement_by_hand(const RobotModel& model, const Branch& branch, const Joints& q, const HandSweep& hand, std::vector<double>& out) {
  const LinkFrames X = model.kinematics.forward(q);
  const Vector3 p_BW = X[4].translation();
  const Vector3 p_BT = X[6] * model.X_FT.translation();
  const double turn = std::min(2.0, hand.rotation);  // chord of the rotation at unit radius
  const double wrist = hand.tcp + turn * (p_BW - p_BT).norm();
  const JointSweep sweep = joint_sweep(model.kinematics, branch, q, wrist, hand.rotation);
  const double forearm_turn = std::min(2.0, sweep[0] + sweep[1] + sweep[2]);

  const auto bound = [&](std::size_t link, const Vector3& p) {
    const double from_base = by_joints(X, link, p, sweep);
    if (link < 3) return from_base;
    const double from_wrist_centre = (p - p_BW).norm();
    if (link == 3) return std::min(from_base, wrist + forearm_turn * from_wrist_centre);
    if (link == 4) {
      const double roll = std::min(2.0, sweep[3]) * distance_to_axis(p, p_BW, X[3].linear().col(2));
      return std::min(from_base, wrist + forearm_turn * from_wrist_centre + roll);
    }
    const double rigid = hand.tcp + turn * (p - p_BT).norm();
    const double on_flange = from_wrist_centre < 1e-12 ? wrist : std::min(rigid, wrist + turn * from_wrist_centre);
    if (link == 6) return on_flange;
    return on_flange + std::min(2.0, sweep[5]) * distance_to_axis(p, p_BW, X[6].linear().col(2));  // link 5: the flange without its turn
  };
  out.resize(model.capsules.size());
  for (std::size_t i = 0; i < model.capsules.size(); ++i) {
    const LinkCapsule& c = model.capsules[i];
    out[i] = std::max(bound(c.link, X[c.link] * c.a), bound(c.link, X[c.link] * c.b));
  }
}

}  // namespace interlace::model
