#include "common/model/motion_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "common/model/arm_rates.hpp"

namespace interlace::model {

namespace {

/// Turn of the arm's directions [rad] in a piece from which on rates alone are too coarse, and the joints' sweeps are looked at too.
constexpr double kCoarse = 0.1;

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

/// Displacement of points that are fixed to the hand, which is known exactly.
class HandBound {
 public:
  HandBound(const HandSweep& hand, const Vector3& p_BT)
      : hand_(hand), p_BT_(p_BT), way_(std::max(-hand.way[0], hand.way[1])), turn_(std::max(-hand.turn[0], hand.turn[1])) {}

  [[nodiscard]] double way() const { return way_; }    ///< of the TCP [m]
  [[nodiscard]] double turn() const { return turn_; }  ///< [rad]

  /// What a turn of one radian makes of point `p`.
  [[nodiscard]] Vector3 swing(const Vector3& p) const { return hand_.axis.cross(p - p_BT_); }

  [[nodiscard]] double operator()(const Vector3& p) const {
    if (turn_ <= 0) return way_;
    const Vector3 swing_of_p = swing(p);
    const double radius = swing_of_p.norm();
    double farthest = std::max(way_, turn_ * radius);
    for (std::size_t i = 0; i < 2; ++i) farthest = std::max(farthest, (hand_.way[i] * hand_.direction + hand_.turn[i] * swing_of_p).norm());
    return std::min(farthest + turn_ * turn_ * radius / 2, way_ + std::min(2.0, turn_) * radius);
  }

 private:
  const HandSweep& hand_;
  Vector3 p_BT_;
  double way_, turn_;
};

/// Displacement of points of the whole arm in a piece of a linear motion: the least of the bounds that hold.
class LineBound {
 public:
  LineBound(const RobotModel& model, const Branch& branch, const LinkFrames& X, const HandSweep& hand)
      : model_(model),
        branch_(branch),
        X_(X),
        sweep_of_hand_(hand),
        p_BW_(X[4].translation()),
        p_BT_(X[6] * model.X_FT.translation()),
        hand_(hand, p_BT_) {}

  [[nodiscard]] double operator()(std::size_t link, const Vector3& p) {
    if (link == 0) return 0;
    if (link == 6) return hand_(p);
    if (!arm_known_) look_at_arm();
    double bound = sweep_ ? by_joints(X_, link, p, *sweep_) : kUnbounded;
    if (link == 1) return rates_ ? std::min(bound, rates_->of_turret_point(p)) : bound;
    if (link == 2) return rates_ ? std::min(bound, rates_->of_upper_arm_point(p)) : bound;
    if (link == 5) {  // the hand without its turn about its own axis
      return std::min(bound, hand_(p) + wrist_roll() * distance_to_axis(p, p_BW_, X_[6].linear().col(2)));
    }
    double on_forearm = wrist_ + std::min(2.0, forearm_turn_) * (p - p_BW_).norm();
    if (rates_) on_forearm = std::min(on_forearm, rates_->of_forearm_point(p, wrist_));
    if (link == 4) on_forearm += wrist_roll() * distance_to_axis(p, p_BW_, X_[3].linear().col(2));
    return std::min(bound, on_forearm);
  }

 private:
  static constexpr double kUnbounded = std::numeric_limits<double>::infinity();

  /// What is needed of the arm beyond the hand.
  void look_at_arm() {
    arm_known_ = true;
    wrist_ = hand_(p_BW_);
    const WristPace translation{sweep_of_hand_.direction, 0, hand_.way()};
    WristPace rotation;
    if (hand_.turn() > 0) {
      const Vector3 swing = hand_.swing(p_BW_);
      rotation = {swing, std::min(2.0, hand_.turn()) * swing.norm(), hand_.turn()};
    }
    rates_ = ArmRates::inside(model_.kinematics, X_, {translation, rotation});
    if (rates_ && rates_->coarseness() < kCoarse) {
      forearm_turn_ = rates_->forearm_turn();
      return;
    }
    sweep_ = joint_sweep(model_.kinematics, branch_, X_, wrist_sweep(sweep_of_hand_, p_BW_ - p_BT_), hand_.turn());
    forearm_turn_ = (*sweep_)[0] + (*sweep_)[1] + (*sweep_)[2];
    if (rates_) forearm_turn_ = std::min(forearm_turn_, rates_->forearm_turn());
  }

  /// Chord of joint 4's turn, and of joint 6's, at unit radius.
  [[nodiscard]] double wrist_roll() const {
    const double sine = X_[4].linear().col(2).cross(X_[6].linear().col(2)).norm();  // of joint 5
    return std::min(2.0, azimuth_sweep(std::min(kPi, forearm_turn_ + hand_.turn()), sine));
  }

  const RobotModel& model_;
  const Branch& branch_;
  const LinkFrames& X_;
  const HandSweep& sweep_of_hand_;
  Vector3 p_BW_, p_BT_;
  HandBound hand_;
  bool arm_known_ = false;
  double wrist_ = 0;  // displacement of the wrist centre [m]
  std::optional<ArmRates> rates_;
  std::optional<JointSweep> sweep_;
  double forearm_turn_ = kPi;
};

/// Writes the larger bound of both ends of each capsule that is asked for.
template <typename PointBound>
void bound_wanted(const RobotModel& model, const PlacedArm& arm, double* out, PointBound&& bound) {
  for (std::size_t i = 0; i < model.capsules.size(); ++i) {
    if ((arm.wanted & only_capsule(i)) == 0) continue;
    const std::size_t link = model.capsules[i].link;
    const double at_a = bound(link, arm.ends[2 * i]);
    out[i] = std::max(at_a, bound(link, arm.ends[2 * i + 1]));
  }
}

}  // namespace

void displacement_by_joints(const RobotModel& model, const PlacedArm& arm, const JointSweep& sweep, double* out) {
  bound_wanted(model, arm, out, [&](std::size_t link, const Vector3& p) { return by_joints(arm.X, link, p, sweep); });
}

void displacement_by_hand(const RobotModel& model, const Branch& branch, const PlacedArm& arm, const HandSweep& hand, double* out) {
  LineBound bound{model, branch, arm.X, hand};
  bound_wanted(model, arm, out, bound);
}

}  // namespace interlace::model
