#pragma once

#include <string>

namespace interlace::app {

/// Units a file is written in: how many of the file's units make one SI unit, and what people call them.
struct Units {
  double per_metre = 1000;
  double per_radian = 57.295779513082320877;
  std::string length = "mm";
  std::string angle = "deg";
};

/// What a number in a file means and which values it may have. Bounds in SI units.
struct Quantity {
  double per_si = 1;  ///< file units in one SI unit
  std::string unit;   ///< as shown to people; empty for a plain number
  double least = 0;
  double most = 0;
  bool positive = false;  ///< zero is refused too; `least` is then the smallest sensible value

  /// "a number > 0 (mm/s)"
  [[nodiscard]] std::string description() const;
};

// The far bounds keep every later computation finite; no arm comes near them.
[[nodiscard]] Quantity coordinate(const Units& units);            ///< of a point, any sign [m]
[[nodiscard]] Quantity length(const Units& units);                ///< ≥ 0 [m]
[[nodiscard]] Quantity positive_length(const Units& units);       ///< > 0 [m]
[[nodiscard]] Quantity angle(const Units& units);                 ///< any sign [rad]
[[nodiscard]] Quantity speed(const Units& units);                 ///< > 0 [m/s]
[[nodiscard]] Quantity acceleration(const Units& units);          ///< > 0 [m/s²]
[[nodiscard]] Quantity angular_speed(const Units& units);         ///< > 0 [rad/s]
[[nodiscard]] Quantity angular_acceleration(const Units& units);  ///< > 0 [rad/s²]
[[nodiscard]] Quantity seconds(double most);                      ///< ≥ 0 [s]
[[nodiscard]] Quantity ratio(double most);                        ///< ≥ 0

/// `value` (SI) in the file's units with its unit, for messages: "123.4 mm".
[[nodiscard]] std::string show(double value, const Quantity& quantity);

}  // namespace interlace::app
