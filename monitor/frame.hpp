#pragma once

#include <cstdint>
#include <memory>
#include <string>

namespace interlace::monitor {

/// What a frame is for a viewer who cannot keep up: poses are replaced by newer ones, everything else must arrive or be made up for by a
/// snapshot.
enum class FrameKind : std::uint8_t { event, pose, snapshot };

/// One message to viewers, JSON (docs/monitor.md). The text is shared by all of them and never changes.
struct Frame {
  FrameKind kind = FrameKind::event;
  std::shared_ptr<const std::string> text;
};

}  // namespace interlace::monitor
