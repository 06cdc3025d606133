#pragma once

namespace interlace::model {

/// Trapezoidal speed profile from rest to rest over a distance, stretched in time when something else takes longer.
/// Triangular when the distance is below v²/a. Units of distance are the caller's: [m] or [rad].
/// Source: DESIGN section 4.
class TimeLaw {
 public:
  /// Stays where it is, duration 0.
  TimeLaw() = default;

  /// `distance` ≥ 0 at most at `velocity` and `acceleration`, both > 0; throws std::invalid_argument otherwise.
  TimeLaw(double distance, double velocity, double acceleration);

  /// The same distance in `duration` seconds; never faster than built, so a shorter `duration` throws std::invalid_argument.
  [[nodiscard]] TimeLaw stretched_to(double duration) const;

  [[nodiscard]] double distance() const { return distance_; }
  [[nodiscard]] double duration() const { return duration_; }  ///< [s]

  /// Distance covered at `t` [s]; 0 before the start, the whole distance after the end. Monotone.
  [[nodiscard]] double at(double t) const;

  /// Speed at `t`, per second.
  [[nodiscard]] double speed(double t) const;

 private:
  double distance_ = 0;
  double acceleration_ = 0;
  double ramp_ = 0;      // time of acceleration and of deceleration [s]
  double duration_ = 0;  // [s]
};

}  // namespace interlace::model
