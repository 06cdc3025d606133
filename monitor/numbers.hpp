#pragma once

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "common/model/pose.hpp"

/// Numbers as frames carry them: no finer than anybody can see, so that a frame stays short. Values JSON has no word for become null.
namespace interlace::monitor {

/// `value` rounded to `places` decimal places.
[[nodiscard]] inline nlohmann::json rounded(double value, int places) {
  if (!std::isfinite(value)) return nullptr;
  const double scale = std::pow(10.0, places);
  return std::round(value * scale) / scale + 0.0;  // no negative zero
}

[[nodiscard]] inline nlohmann::json seconds(double t) {
  return rounded(t, 3);
}
[[nodiscard]] inline nlohmann::json seconds(const std::optional<double>& t) {
  return t ? seconds(*t) : nlohmann::json(nullptr);
}
/// To a tenth of a millimetre.
[[nodiscard]] inline nlohmann::json metres(double length) {
  return rounded(length, 4);
}
[[nodiscard]] inline nlohmann::json metres(const model::Vector3& p) {
  return {metres(p.x()), metres(p.y()), metres(p.z())};
}

}  // namespace interlace::monitor
