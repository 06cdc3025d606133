#include "monitor/server/viewer_request.hpp"

#include <nlohmann/json.hpp>

namespace interlace::monitor {

namespace {

std::string text_of(const nlohmann::json& json, const char* key) {
  const auto found = json.find(key);
  return found != json.end() && found->is_string() ? found->get<std::string>() : std::string{};
}

}  // namespace

std::optional<ViewerRequest> parse_viewer_request(const std::string& text) {
  if (text.size() > kMaxViewerMessage) return std::nullopt;
  const auto json = nlohmann::json::parse(text, nullptr, false);
  if (!json.is_object()) return std::nullopt;
  const std::string type = text_of(json, "type");
  if (type == "snapshot") return SnapshotRequest{};
  if (type != "map") return std::nullopt;
  const std::string command = text_of(json, "command");
  if (!model::is_valid_name(command)) return std::nullopt;
  return MapRequest{model::CommandId{command}};
}

}  // namespace interlace::monitor
