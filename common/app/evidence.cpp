#include "common/app/evidence.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace interlace::app {

std::string describe(const model::EscapeRefusal& refusal) {
  return fmt::format("{} cannot go {}: {}", refusal.robot.str(), model::to_string(refusal.way),
                     refusal.text.empty() ? "no further explanation" : refusal.text);
}

std::string describe(const model::Conflict& c, model::Instant now) {
  const std::string until = c.until == model::kForever ? "no end known"
                            : c.until > now            ? fmt::format("free in {:.2f} s", model::to_seconds(c.until - now))
                                                       : "free now";
  if (c.own_link.empty()) return fmt::format("{} could be anywhere in its reach, {}", c.blocker.str(), until);
  if (c.blocker_link.empty()) return fmt::format("{} holds the zone that {} would be in, {}", c.blocker.str(), c.own_link, until);
  return fmt::format("{}'s {} in the way of {}, {:.1f} mm {}, {}", c.blocker.str(), c.blocker_link, c.own_link, 1e3 * std::abs(c.clearance),
                     c.clearance < 0 ? "deep" : "near", until);
}

nlohmann::json to_json(const std::vector<model::EscapeRefusal>& refusals) {
  nlohmann::json json = nlohmann::json::array();
  for (const auto& r : refusals) {
    json.push_back({{"robot", r.robot.str()}, {"way", model::to_string(r.way)}, {"explanation", r.text}});
  }
  return json;
}

nlohmann::json to_json(const std::vector<model::Conflict>& conflicts) {
  nlohmann::json json = nlohmann::json::array();
  for (const auto& c : conflicts) {
    const bool open_ended = c.until == model::kForever;
    json.push_back({{"blocker", c.blocker.str()},
                    {"link", c.own_link},
                    {"blocker_link", c.blocker_link},
                    {"clearance_m", c.clearance},
                    {"place_m", {c.place.x(), c.place.y(), c.place.z()}},
                    {"open_ended", open_ended},
                    {"until_s", open_ended ? nlohmann::json(nullptr) : nlohmann::json(model::to_seconds(c.until))}});
  }
  return json;
}

nlohmann::json name_or_null(const std::string& name) {
  return name.empty() ? nlohmann::json(nullptr) : nlohmann::json(name);
}

}  // namespace interlace::app
