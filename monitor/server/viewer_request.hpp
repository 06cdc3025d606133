#pragma once

#include <optional>
#include <string>
#include <variant>

#include "common/model/ids.hpp"

namespace interlace::monitor {

inline constexpr std::size_t kMaxViewerMessage = 1024;  ///< [bytes]

/// Everything again, from the start.
struct SnapshotRequest {};
/// The collision map of a command.
struct MapRequest {
  model::CommandId command;
};
/// Only a player of recordings heeds these.
struct PlayRequest {
  double speed = 1;  ///< kSlowest to kFastest times as fast as it was
};
struct PauseRequest {};
struct SeekRequest {
  double t = 0;  ///< [s] from the begin of the recording
};
using ViewerRequest = std::variant<SnapshotRequest, MapRequest, PlayRequest, PauseRequest, SeekRequest>;

inline constexpr double kSlowest = 0.05, kFastest = 50;

/// What a viewer sent (docs/monitor.md); empty: nothing that a viewer may say. Pure, whatever the text.
[[nodiscard]] std::optional<ViewerRequest> parse_viewer_request(const std::string& text);

}  // namespace interlace::monitor
