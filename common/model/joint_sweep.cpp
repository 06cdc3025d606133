#include "common/model/joint_sweep.hpp"

#include <algorithm>
#include <cmath>

namespace interlace::model {

namespace {

/// Largest and smallest of a linear function over a wrist sweep.
struct Range {
  double low, high;
};
Range along(const WristSweep& wrist, const Vector3& direction) {
  Range range{0, 0};
  for (const Vector3& corner : wrist.corners) {
    range.low = std::min(range.low, direction.dot(corner));
    range.high = std::max(range.high, direction.dot(corner));
  }
  return {range.low - wrist.sag, range.high + wrist.sag};
}

/// Distances from the origin to a box, nearest and farthest.
Range distances(const Range& x, const Range& z) {
  const double nearest = std::hypot(std::max({x.low, -x.high, 0.0}), std::max({z.low, -z.high, 0.0}));
  const double farthest = std::hypot(std::max(-x.low, x.high), std::max(-z.low, z.high));
  return {nearest, farthest};
}

/// Largest angle at the origin between the direction of (x, z) and any point of a box around it that does not hold the origin.
double angle_to_box(double x, double z, const Range& box_x, const Range& box_z) {
  double largest = 0;
  for (const double corner_x : {box_x.low, box_x.high}) {
    for (const double corner_z : {box_z.low, box_z.high}) {
      largest = std::max(largest, std::abs(std::atan2(x * corner_z - z * corner_x, x * corner_x + z * corner_z)));
    }
  }
  return largest;
}

}  // namespace

WristSweep wrist_sweep(const HandSweep& hand, const Vector3& p_TcpWrist) {
  std::array<Vector3, 2> turned;
  for (std::size_t i = 0; i < 2; ++i) turned[i] = Eigen::AngleAxisd{hand.turn[i], hand.axis} * p_TcpWrist - p_TcpWrist;
  const std::array<Vector3, 2> way{hand.way[0] * hand.direction, hand.way[1] * hand.direction};
  WristSweep wrist;
  wrist.corners = {way[0] + turned[0], way[0] + turned[1], way[1] + turned[0], way[1] + turned[1]};
  wrist.sag = p_TcpWrist.norm() * (1 - std::cos(std::min(kPi, (hand.turn[1] - hand.turn[0]) / 2)));  // of the arc from its chord
  return wrist;
}

double azimuth_sweep(double tilt, double s) {
  return tilt < kPi / 2 && std::sin(tilt) < s ? std::asin(std::sin(tilt) / s) : kPi;
}

JointSweep joint_sweep(const Kinematics& kinematics, const Branch& branch, const LinkFrames& X, const WristSweep& wrist, double rotation) {
  const OpwParameters& p = kinematics.parameters();
  const double k = kinematics.forearm_length();
  JointSweep sweep = JointSweep::Constant(kPi);
  const Vector3 p_BW = X[4].translation();
  const auto arm = kinematics.triangle(p_BW, branch.shoulder);
  const double r = std::hypot(p_BW.x(), p_BW.y());
  if (!arm || r <= 0) return sweep;

  // Seen from above: how far outwards, inwards and sideways the wrist may go.
  const Vector3 outwards{p_BW.x() / r, p_BW.y() / r, 0};
  const Vector3 sideways{-outwards.y(), outwards.x(), 0};
  const Range out = along(wrist, outwards);
  const Range side = along(wrist, sideways);
  const double r_min = r + out.low;
  if (r_min <= std::abs(p.b)) return sweep;  // the wrist may reach axis 1: any posture is possible
  const double r_max = std::hypot(r + out.high, std::max(-side.low, side.high));

  // Axis 1: azimuth of the wrist, and the angle the lateral offset takes from it.
  const double radial = std::abs(arm->radial);
  const double radial_min = std::sqrt(r_min * r_min - p.b * p.b);
  const double radial_max = std::sqrt(r_max * r_max - p.b * p.b);
  const double lateral = std::atan2(p.b, radial);
  sweep[0] = angle_to_box(r, 0, {r_min, r + out.high}, side) +
             std::max(std::abs(std::atan2(p.b, radial_min) - lateral), std::abs(std::atan2(p.b, radial_max) - lateral));

  // In the arm's plane: the box the wrist stays in, seen from the shoulder; then direction and triangle.
  const bool front = branch.shoulder == Branch::Shoulder::front;
  const Range box_x = front ? Range{radial_min - p.a1, radial_max - p.a1} : Range{-radial_max - p.a1, -radial_min - p.a1};
  const Range rise = along(wrist, Vector3::UnitZ());
  const Range box_z{arm->z + rise.low, arm->z + rise.high};
  const Range d = distances(box_x, box_z);
  const double direction = d.low > 0 ? angle_to_box(arm->x, arm->z, box_x, box_z) : kPi;
  const double d_min = std::clamp(d.low, std::abs(p.c2 - k), p.c2 + k);
  const double d_max = std::clamp(d.high, std::abs(p.c2 - k), p.c2 + k);
  const auto at_shoulder = [&](double reach) {  // angle between upper arm and shoulder → wrist
    return reach > 0 ? std::acos(std::clamp((reach * reach + p.c2 * p.c2 - k * k) / (2 * reach * p.c2), -1.0, 1.0)) : kPi;
  };
  const auto at_elbow = [&](double reach) {  // bend of the elbow
    return std::acos(std::clamp((reach * reach - p.c2 * p.c2 - k * k) / (2 * p.c2 * k), -1.0, 1.0));
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

}  // namespace interlace::model
