#include "app_client/request.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace interlace::client {

namespace {

using app::Quantity;
using Checked = model::Result<double, std::string>;

/// `value` of the person's units in SI.
Checked si(const std::string& name, double value, const Quantity& quantity) {
  const double result = value / quantity.per_si;
  const bool fine = std::isfinite(value) && result >= quantity.least && result <= quantity.most && !(quantity.positive && result <= 0);
  if (fine) return result;
  return model::unexpected(fmt::format("{}: found {:g}, expected {}", name, value, quantity.description()));
}

model::Result<model::Target, std::string> make_target(const MotionWords& words, const app::Units& units) {
  static const std::array<const char*, 6> kLinear{"X", "Y", "Z", "ROLL", "PITCH", "YAW"};
  static const std::array<const char*, 6> kJoint{"J1", "J2", "J3", "J4", "J5", "J6"};
  const bool linear = words.move == "linear";
  if (!linear && words.move != "joint") {
    return model::unexpected(fmt::format("the kind of move: found \"{}\", expected linear or joint", words.move));
  }
  if (words.values.size() != model::kJoints) {
    return model::unexpected(fmt::format("the target: found {} numbers, expected six", words.values.size()));
  }
  model::Joints v;
  for (std::size_t i = 0; i < model::kJoints; ++i) {
    const auto& names = linear ? kLinear : kJoint;
    const auto value = si(names[i], words.values[i], linear && i < 3 ? app::coordinate(units) : app::angle(units));
    if (!value) return model::unexpected(value.error());
    v[static_cast<Eigen::Index>(i)] = *value;
  }
  if (!linear) return model::Target{model::JointTarget{v}};
  return model::Target{model::LinearTarget{model::make_pose(v.head<3>(), model::rotation_from_rpy(v.tail<3>()))}};
}

model::Result<std::optional<model::ToolChange>, std::string> make_change(const MotionWords& words) {
  if (words.attach.empty() && words.detach.empty()) return std::optional<model::ToolChange>{};
  for (const auto& [option, name] : {std::pair{"--attach", &words.attach}, std::pair{"--detach", &words.detach}}) {
    if (!name->empty() && !model::is_valid_name(*name)) {
      return model::unexpected(fmt::format("{}: found \"{}\", expected 1 to 64 letters, digits, '_', '-', '.' or ':'", option, *name));
    }
  }
  if (words.when != "start" && words.when != "completion") {
    return model::unexpected(fmt::format("--when: found \"{}\", expected start or completion", words.when));
  }
  model::ToolChange change;
  change.attach = model::ToolName{words.attach};
  change.detach = model::ToolName{words.detach};
  change.when = words.when == "start" ? model::ToolTime::start : model::ToolTime::completion;
  return std::optional{change};
}

}  // namespace

app::Units make_units(const std::string& length, const std::string& angle) {
  app::Units units;
  if (length == "m") {
    units.per_metre = 1;
  } else if (length != "mm") {
    throw std::invalid_argument("unit of length: found \"" + length + "\", expected mm or m");
  }
  if (angle == "rad") {
    units.per_radian = 1;
  } else if (angle != "deg") {
    throw std::invalid_argument("unit of angle: found \"" + angle + "\", expected deg or rad");
  }
  units.length = length;
  units.angle = angle;
  return units;
}

model::Result<model::MotionRequest, std::string> make_request(const MotionWords& words, const app::Units& units) {
  const auto target = make_target(words, units);
  if (!target) return model::unexpected(target.error());
  model::MotionRequest request;
  request.target = *target;
  if (words.velocity) {
    const auto value = si("--velocity", *words.velocity, app::speed(units));
    if (!value) return model::unexpected(value.error());
    request.velocity = *value;
  }
  if (words.acceleration) {
    const auto value = si("--acceleration", *words.acceleration, app::acceleration(units));
    if (!value) return model::unexpected(value.error());
    request.acceleration = *value;
  }
  const auto tools = make_change(words);
  if (!tools) return model::unexpected(tools.error());
  request.tools = *tools;
  return request;
}

}  // namespace interlace::client
