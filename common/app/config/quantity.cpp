#include "common/app/config/quantity.hpp"

#include <fmt/format.h>

#include "common/model/pose.hpp"

namespace interlace::app {

namespace {
constexpr double kFarthest = 1000;               // [m]
constexpr double kMostTurns = 200 * model::kPi;  // [rad]
constexpr double kSlowest = 1e-5;                // [m/s], [rad/s] and per second: slower motions would last longer than a shift
constexpr double kFastest = 1000;
}  // namespace

std::string Quantity::description() const {
  std::string text = positive || least == 0 ? "a number" : "a finite number";
  if (positive) text += " > 0";
  if (!positive && least == 0) text += " >= 0";
  if (!unit.empty()) text += " (" + unit + ")";
  return text;
}

Quantity coordinate(const Units& units) {
  return {units.per_metre, units.length, -kFarthest, kFarthest, false};
}
Quantity length(const Units& units) {
  return {units.per_metre, units.length, 0, kFarthest, false};
}
Quantity positive_length(const Units& units) {
  return {units.per_metre, units.length, 1e-6, kFarthest, true};
}
Quantity angle(const Units& units) {
  return {units.per_radian, units.angle, -kMostTurns, kMostTurns, false};
}
Quantity speed(const Units& units) {
  return {units.per_metre, units.length + "/s", kSlowest, kFastest, true};
}
Quantity acceleration(const Units& units) {
  return {units.per_metre, units.length + "/s^2", kSlowest, kFastest, true};
}
Quantity angular_speed(const Units& units) {
  return {units.per_radian, units.angle + "/s", kSlowest, kFastest, true};
}
Quantity angular_acceleration(const Units& units) {
  return {units.per_radian, units.angle + "/s^2", kSlowest, kFastest, true};
}
Quantity seconds(double most) {
  return {1, "s", 0, most, false};
}
Quantity ratio(double most) {
  return {1, "", 0, most, false};
}

std::string show(double value, const Quantity& quantity) {
  return fmt::format("{:.6g}{}{}", value * quantity.per_si, quantity.unit.empty() ? "" : " ", quantity.unit);
}

}  // namespace interlace::app
