#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/model/cell.hpp"
#include "common/model/messages.hpp"
#include "common/model/placed_arm.hpp"
#include "common/model/result.hpp"
#include "common/model/time_law.hpp"

namespace interlace::model {

/// Time of a rotation on the spot where the cell file gives no angular limits [s].
inline constexpr double kUnlimitedRotation = 0.02;

/// Why a request cannot become a motion, and where on its path.
struct MotionError {
  Reason reason = Reason::none;
  double progress = 0;               ///< 0 … 1 along the path
  Vector3 p_WTcp = Vector3::Zero();  ///< the TCP there [m]
  std::string text;                  ///< one sentence with the value and the rule
};

/// A command with its path and time law fixed: what a controller will do once started. Local time runs from 0 to duration().
/// Immutable; thread-safe. Refers to the `Robot` it was planned for, which must outlive it.
class Motion {
 public:
  /// Standing at `q`: duration 0.
  [[nodiscard]] static Motion rest(const Robot& robot, const Joints& q);

  /// The same motion of `robot`: the same arm on the same base, of which only the capsules may differ. It must outlive the result.
  [[nodiscard]] Motion with_bodies_of(const Robot& robot) const;

  [[nodiscard]] const Robot& robot() const { return *robot_; }
  [[nodiscard]] double duration() const { return duration_; }  ///< [s]
  [[nodiscard]] const Joints& from() const { return knots_.front(); }
  [[nodiscard]] const Joints& to() const { return knots_.back(); }
  [[nodiscard]] bool is_linear() const { return line_.has_value(); }  ///< a straight line of the TCP; false also for a rest

  /// Joints [rad] at local time `t` [s], continuous; the end postures outside [0, duration].
  [[nodiscard]] Joints joints(double t) const;

  /// Frames of the links at local time `t`, in the base frame: what `joints(t)` places, without computing the joints of a linear move.
  void frames(double t, LinkFrames& X) const;

  /// X_WT at local time `t`.
  [[nodiscard]] Pose tcp(double t) const;

  /// Travelling length of the TCP up to `t` [m] (the vertical axis of a collision map). Joint moves: of the chords between knots.
  [[nodiscard]] double length(double t) const;

  /// Upper bound of how far any point of each capsule of the robot is, anywhere in [t0, t1], from where it is at `centre` [m].
  /// Writes one bound per capsule to `out`. Proof: docs/certificate.md.
  void displacement(double t0, double centre, double t1, std::vector<double>& out) const;

  /// The same for an arm whose placement at `centre` is known already and the capsules it asks for, without allocation; `out` has room for
  /// all capsules.
  void displacement(double t0, double centre, double t1, const PlacedArm& at_centre, double* out) const;

 private:
  friend Result<Motion, MotionError> plan_motion(const Robot& robot, const Joints& from, const MotionRequest& request);
  struct Line {
    Branch branch;
    Vector3 p_BT0, p_BT1;  // TCP in the base frame
    Quaternion q_BT0, q_BT1;
    Pose X_TF;
    Pose X_BF1;           // flange at the end
    Vector3 direction;    // unit, of the translation; zero without one
    Vector3 axis;         // unit, of the rotation; any without one
    double angle;         // [rad] of the rotation
    TimeLaw translation;  // [m]
    TimeLaw rotation;     // [rad]
  };
  explicit Motion(const Robot& robot) : robot_(&robot) {}
  [[nodiscard]] Pose tcp_in_base(const Line& line, double t) const;
  [[nodiscard]] Pose flange_in_base(const Line& line, double t) const;
  [[nodiscard]] Joints between_knots(double t) const;
  void line_displacement(const Line& line, double t0, double centre, double t1, const PlacedArm& at_centre, double* out) const;
  void joint_displacement(double t0, double centre, double t1, const PlacedArm& at_centre, double* out) const;

  const Robot* robot_;
  double duration_ = 0;
  std::optional<Line> line_;         // linear moves
  std::vector<TimeLaw> joint_laws_;  // joint moves: of |Δq| of each joint
  std::vector<Joints> knots_;        // joints at equal steps of time, turns unwrapped; one knot for a rest
  std::vector<double> lengths_;      // joint moves: travelled length at the knots [m]
};

/// Path and time law of `request` for `robot` standing at `from`. Walks the path and refuses it with the first place where it leaves the
/// reach, the joint limits or the branch, or where a joint would be faster than its limit.
/// Source: DESIGN sections 4 and 6.
[[nodiscard]] Result<Motion, MotionError> plan_motion(const Robot& robot, const Joints& from, const MotionRequest& request);

}  // namespace interlace::model
