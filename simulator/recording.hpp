#pragma once

#include <memory>
#include <optional>
#include <string>

#include "common/app/config/cell_file.hpp"
#include "common/model/result.hpp"
#include "simulator/virtual_cell.hpp"

namespace interlace::sim {

/// A run in virtual time being written to a file.
class Recording {
 public:
  Recording() = default;
  virtual ~Recording() = default;
  Recording(const Recording&) = delete;
  Recording& operator=(const Recording&) = delete;

  /// Adds itself to `options`; it must live as long as they are used.
  virtual void listen(VirtualOptions& options) = 0;

  /// Ends the file. A sentence when it could not be written.
  [[nodiscard]] virtual std::optional<std::string> close() = 0;
};

/// Makes the file at `path`; `text` is the cell file's. The error is a sentence. Messages are laid out as on the wire, so that this is in
/// recording/; a build without DDS has no_recording.cpp instead, which says so.
[[nodiscard]] model::Result<std::unique_ptr<Recording>, std::string> start_recording(const std::string& path, const app::LoadedCell& cell,
                                                                                     const std::string& text);

}  // namespace interlace::sim
