#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/app/config/finding.hpp"
#include "common/model/cell.hpp"
#include "common/model/result.hpp"

namespace interlace::app {

inline constexpr std::size_t kMaxRobots = 128;  ///< of one cell

struct LoadedCell {
  model::Cell cell;
  std::uint64_t fingerprint = 0;  ///< see app::fingerprint
};

/// Names `planning.strategy` may have.
[[nodiscard]] const std::vector<std::string>& strategy_names();

/// The cell described by `text` (format: docs/files.md); `file_name` only appears in messages. Checks everything the type Cell
/// promises, and that homes, like starts, are clear of each other. Pure; any thread.
[[nodiscard]] model::Result<LoadedCell, ConfigError> parse_cell(const std::string& text, const std::string& file_name);

/// Reads and parses the file at `path`.
[[nodiscard]] model::Result<LoadedCell, ConfigError> load_cell(const std::string& path);

}  // namespace interlace::app
