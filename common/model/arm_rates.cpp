#include "common/model/arm_rates.hpp"

#include <algorithm>
#include <cmath>

namespace interlace::model {

std::optional<ArmRates> ArmRates::inside(const Kinematics& kinematics, const LinkFrames& X, const std::array<WristPace, 2>& paces) {
  const OpwParameters& p = kinematics.parameters();
  const double k = kinematics.forearm_length();
  const double b = std::abs(p.b);
  const Vector3& wrist = X[4].translation();
  const Vector3 sideways = X[1].linear().col(1);

  // First roughly: the wrist's way, and what any velocity of it can do to the arm's directions anywhere on it.
  double way = 0;
  for (const WristPace& pace : paces) {
    if (pace.length > 0) way += pace.length * (pace.velocity.norm() + pace.drift);
  }
  const double nearest = std::sqrt(wrist.x() * wrist.x() + wrist.y() * wrist.y()) - way;
  if (nearest <= b) return std::nullopt;
  const double radial = std::sqrt(nearest * nearest - b * b);
  const double turret_turn = way / radial;
  const double way_in_plane = way + b * turret_turn;
  const Vector3 forearm = (wrist - X[3].translation()) / k;
  const Vector3 upper_arm = X[2].linear().col(2);
  const Vector3 shoulder_to_wrist = wrist - X[2].translation() - p.b * sideways;
  const double distance = shoulder_to_wrist.norm();
  const auto squared_sine = [&](double d) {  // of the elbow's bend, by Heron's formula
    const double stretched = (p.c2 + k) * (p.c2 + k) - d * d;
    const double folded = d * d - (p.c2 - k) * (p.c2 - k);
    return d > 0 ? stretched * folded / (4 * p.c2 * p.c2 * k * k) : 0.0;
  };
  const double least = std::min(squared_sine(distance - way_in_plane), squared_sine(distance + way_in_plane));
  if (!(least > 0)) return std::nullopt;
  const double sine = std::sqrt(least);
  const double upper_turn = way_in_plane / (p.c2 * sine);
  const double forearm_turn = way_in_plane / (k * sine);

  // Then precisely: the velocities at the centre, and what the rough bounds allow them to change.
  ArmRates arm;
  arm.X_ = &X;
  arm.forearm_length_ = k;
  arm.coarseness_ = turret_turn + std::max(upper_turn, forearm_turn);
  for (std::size_t i = 0; i < paces.size(); ++i) {
    if (paces[i].length <= 0) continue;
    const Vector3& v = paces[i].velocity;
    const double speed = v.norm();
    Rates& r = arm.rates_[i];
    r.length = paces[i].length;
    r.turret = (std::abs(sideways.dot(v)) + speed * turret_turn + paces[i].drift) / radial;
    const double offset = paces[i].drift + b * r.turret;
    r.upper = (std::abs(forearm.dot(v)) + speed * (turret_turn + forearm_turn) + offset) / (p.c2 * sine);
    r.forearm = (std::abs(upper_arm.dot(v)) + speed * (turret_turn + upper_turn) + offset) / (k * sine);
    arm.upper_turn_ += r.length * r.upper;
    arm.forearm_turn_ += r.length * std::sqrt(r.turret * r.turret + r.forearm * r.forearm);
  }
  arm.elbow_ = arm.of_upper_arm_point(X[3].translation());
  return arm;
}

double ArmRates::of_turret_point(const Vector3& p) const {
  return std::sqrt(p.x() * p.x() + p.y() * p.y()) * (rates_[0].turret * rates_[0].length + rates_[1].turret * rates_[1].length);
}

double ArmRates::of_upper_arm_point(const Vector3& p) const {
  const Pose& turret = (*X_)[1];
  const Vector3 from_shoulder = p - (*X_)[2].translation();
  const double lateral = std::abs(turret.linear().col(1).dot(p));
  const double outwards = turret.linear().col(0).dot(from_shoulder);
  const double radius = std::sqrt(outwards * outwards + from_shoulder.z() * from_shoulder.z());  // about axis 2
  const double farthest = std::abs(turret.linear().col(0).dot(p)) + radius * upper_turn_;        // from axis 1, in the arm's plane
  double sum = 0;
  for (const Rates& r : rates_) {
    if (r.length <= 0) continue;
    const double in_plane = radius * r.upper + lateral * r.turret;
    const double across = farthest * r.turret;
    sum += r.length * std::sqrt(in_plane * in_plane + across * across);
  }
  return sum;
}

double ArmRates::of_forearm_point(const Vector3& p, double wrist) const {
  const Vector3& elbow = (*X_)[3].translation();
  const Vector3 along = ((*X_)[4].translation() - elbow) / forearm_length_;
  const Vector3 from_elbow = p - elbow;
  const double share = along.dot(from_elbow) / forearm_length_;
  const double off = (from_elbow - share * forearm_length_ * along).norm();
  return std::abs(1 - share) * elbow_ + std::abs(share) * wrist + off * forearm_turn_;
}

}  // namespace interlace::model
