#pragma once

#include <array>
#include <optional>

#include "common/model/pose.hpp"

namespace interlace::model {

/// Geometry of a 6R arm with a spherical wrist, OPW convention: at zero the arm stands upright, flange z up.
/// Lengths [m], offsets [rad]; a joint's angle in the formulas is sign · q − offset.
/// Source: Brandstötter, Angerer, Hofbaur, "An analytical solution of the inverse kinematics problem of industrial serial
/// manipulators with an ortho-parallel basis and a spherical wrist", 2014.
struct OpwParameters {
  double a1 = 0, a2 = 0, b = 0;
  double c1 = 0, c2 = 0, c3 = 0, c4 = 0;
  std::array<double, kJoints> offsets{};
  std::array<int, kJoints> signs{1, 1, 1, 1, 1, 1};
};

/// One of the eight postures that reach a pose. A path keeps the branch it starts in.
struct Branch {
  enum class Shoulder { front, back };      ///< wrist in front of axis 1, or behind it (arm laid over backwards)
  enum class Elbow { up, down };            ///< elbow above or below the line shoulder → wrist
  enum class Wrist { positive, negative };  ///< sign of joint 5
  Shoulder shoulder = Shoulder::front;
  Elbow elbow = Elbow::up;
  Wrist wrist = Wrist::positive;

  friend bool operator==(const Branch& x, const Branch& y) { return x.shoulder == y.shoulder && x.elbow == y.elbow && x.wrist == y.wrist; }
};

/// The eight branches, front before back, up before down, positive before negative.
[[nodiscard]] const std::array<Branch, 8>& all_branches();

/// Frames of the links in the base frame B: 0 base, 1 turret, 2 upper arm (origin at the shoulder, z along the arm), 3 forearm (origin
/// at the elbow, z along the arm), 4 and 5 wrist (origin at the wrist centre), 6 flange (z forward).
using LinkFrames = std::array<Pose, 7>;

/// Where the wrist centre lies as axis 1 sees it; the intermediate of the inverse kinematics that the displacement bounds reuse.
struct ArmTriangle {
  double radial;    ///< signed distance of the wrist from axis 1, lateral offset b taken out [m]
  double x, z;      ///< wrist seen from the shoulder, in the plane of the arm [m]
  double distance;  ///< shoulder → wrist [m]
};

class Kinematics {
 public:
  explicit Kinematics(const OpwParameters& parameters);

  [[nodiscard]] const OpwParameters& parameters() const { return p_; }

  /// Frames of all links for joints `q` [rad], in the base frame.
  [[nodiscard]] LinkFrames forward(const Joints& q) const;

  /// X_BF: the flange for joints `q`.
  [[nodiscard]] Pose flange(const Joints& q) const;

  /// Joints [rad] of the posture of `branch` that brings the flange to `X_BF`, each within a turn of zero; empty when out of reach.
  /// At wrist singularities (|sin q5| < 1e-12) joint 4 is set to zero and joint 6 carries the sum.
  [[nodiscard]] std::optional<Joints> inverse(const Pose& X_BF, const Branch& branch) const;

  /// Frames of all links in the posture that `inverse` finds, straight from the geometry: no angle is ever computed, so it takes a fraction
  /// of the time of `inverse` and `forward`. False, and `X` is useless, when out of reach or where the direction of the arm is not
  /// determined.
  [[nodiscard]] bool frames(const Pose& X_BF, const Branch& branch, LinkFrames& X) const;

  /// The branch `q` is in.
  [[nodiscard]] Branch branch_of(const Joints& q) const;

  /// Triangle shoulder–elbow–wrist for the wrist centre `p_BW` [m]; empty when the wrist is nearer to axis 1 than the offset b.
  [[nodiscard]] std::optional<ArmTriangle> triangle(const Vector3& p_BW, Branch::Shoulder shoulder) const;

  /// Wrist centre for a flange pose [m].
  [[nodiscard]] Vector3 wrist_centre(const Pose& X_BF) const { return X_BF * Vector3{0, 0, -p_.c4}; }

  /// Length of elbow → wrist, k = √(a2² + c3²) [m].
  [[nodiscard]] double forearm_length() const { return k_; }

 private:
  [[nodiscard]] Joints to_internal(const Joints& q) const;
  [[nodiscard]] Joints to_external(const Joints& q) const;

  OpwParameters p_;
  double k_;     // elbow → wrist
  double psi3_;  // angle between the forearm's z axis and elbow → wrist
};

}  // namespace interlace::model
