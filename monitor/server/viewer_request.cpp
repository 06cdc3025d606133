#include "monitor/server/viewer_request.hpp"

#include <nlohmann/json.hpp>

namespace interlace::monitor {

namespace {

std::string text_of(const nlohmann::json& json, const char* key) {
  const auto found = json.find(key);
  return found != json.end() && found->is_string() ? found->get<std::string>() : std::string{};
}

constexpr double kLongest = 1e9;  // [s]

/// Empty: it is there and no number; `otherwise` when it is not there. JSON has neither infinities nor NaN.
std::optional<double> number_of(const nlohmann::json& json, const char* key, std::optional<double> otherwise) {
  const auto found = json.find(key);
  if (found == json.end()) return otherwise;
  return found->is_number() ? std::optional{found->get<double>()} : std::nullopt;
}

}  // namespace

std::optional<ViewerRequest> parse_viewer_request(const std::string& text) {
  if (text.size() > kMaxViewerMessage) return std::nullopt;
  const auto json = nlohmann::json::parse(text, nullptr, false);
  if (!json.is_object()) return std::nullopt;
  const std::string type = text_of(json, "type");
  if (type == "snapshot") return SnapshotRequest{};
  if (type == "pause") return PauseRequest{};
  if (type == "play") {
    const auto speed = number_of(json, "speed", 1);
    if (!speed || *speed < kSlowest || *speed > kFastest) return std::nullopt;
    return PlayRequest{*speed};
  }
  if (type == "seek") {
    const auto t = number_of(json, "t", std::nullopt);
    if (!t || *t < 0 || *t > kLongest) return std::nullopt;
    return SeekRequest{*t};
  }
  if (type != "map") return std::nullopt;
  const std::string command = text_of(json, "command");
  if (!model::is_valid_name(command)) return std::nullopt;
  return MapRequest{model::CommandId{command}};
}

}  // namespace interlace::monitor
