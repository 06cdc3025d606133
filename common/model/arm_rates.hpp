#pragma once

#include <array>
#include <optional>

#include "common/model/kinematics.hpp"

namespace interlace::model {

/// One of the two ways in which a hand carries the wrist centre along: its translation or its turn. Per unit of it ([m] or [rad]):
struct WristPace {
  Vector3 velocity = Vector3::Zero();  ///< of the wrist centre, at the piece's centre, in the base frame
  double drift = 0;                    ///< bound of how much that vector changes inside the piece
  double length = 0;                   ///< bound of how far the pace goes from the centre, [m] or [rad]
};

/// Bounds of how turret, upper arm and forearm move inside a piece of a motion, from the velocity of the wrist centre alone. Tight to first
/// order: what is lost shrinks with the square of the piece. Nothing is claimed next to a singularity of the arm.
/// Proof: docs/certificate.md, section 2.
class ArmRates {
 public:
  /// `X`: the frames at the piece's centre. Empty when the wrist may come too near to axis 1, or the arm be stretched or folded.
  [[nodiscard]] static std::optional<ArmRates> inside(const Kinematics& kinematics, const LinkFrames& X,
                                                      const std::array<WristPace, 2>& paces);

  /// Displacement [m] of point `p` (at the centre, in the base frame) fixed to the turret or the upper arm.
  [[nodiscard]] double of_turret_point(const Vector3& p) const;
  [[nodiscard]] double of_upper_arm_point(const Vector3& p) const;

  /// Likewise for the forearm; `wrist` bounds the displacement of the wrist centre [m].
  [[nodiscard]] double of_forearm_point(const Vector3& p, double wrist) const;

  /// Angle [rad] by which the forearm turns in space.
  [[nodiscard]] double forearm_turn() const { return forearm_turn_; }

  /// How much arm directions turn inside the piece [rad], roughly: the relative error that the bounds have.
  [[nodiscard]] double coarseness() const { return coarseness_; }

 private:
  /// Per unit of one pace, anywhere in the piece [rad].
  struct Rates {
    double turret = 0;   ///< of joint 1
    double upper = 0;    ///< of the upper arm in the arm's plane
    double forearm = 0;  ///< of the forearm in the arm's plane
    double length = 0;   ///< of the pace
  };

  const LinkFrames* X_ = nullptr;
  std::array<Rates, 2> rates_;
  double forearm_length_ = 0;
  double upper_turn_ = 0, forearm_turn_ = 0, coarseness_ = 0;
  double elbow_ = 0;  // displacement of the elbow [m]
};

}  // namespace interlace::model
