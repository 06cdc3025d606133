#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/app/config/quantity.hpp"
#include "common/model/messages.hpp"
#include "common/model/result.hpp"

namespace interlace::client {

/// A motion as a person writes it on the command line.
struct MotionWords {
  std::string move;            ///< linear | joint
  std::vector<double> values;  ///< linear: x y z roll pitch yaw of the TCP in the world frame; joint: six angles, base to flange
  std::optional<double> velocity, acceleration;  ///< of the TCP, per second and per second²
  std::string attach = {}, detach = {};          ///< names of tools to take and to leave; empty: none
  std::string when = "completion";               ///< start | completion
};

/// `mm` or `m`, and `deg` or `rad`; throws std::invalid_argument for others.
[[nodiscard]] app::Units make_units(const std::string& length, const std::string& angle);

/// The request in SI units, or one sentence with the value that is wrong and the rule it breaks. Pure.
[[nodiscard]] model::Result<model::MotionRequest, std::string> make_request(const MotionWords& words, const app::Units& units);

}  // namespace interlace::client
