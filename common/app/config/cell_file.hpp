#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/app/config/finding.hpp"
#include "common/app/config/fixture_section.hpp"
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

/// The cell described by `text` (format: docs/files.md); `file_name` appears in messages, and meshes are looked for in its folder. Checks
/// everything the type Cell promises, and that homes, like starts, are clear of each other and of the fixtures. As pure as `meshes`; any
/// thread. Without `meshes` a cell with meshes is refused.
[[nodiscard]] model::Result<LoadedCell, ConfigError> parse_cell(const std::string& text, const std::string& file_name,
                                                                const MeshReader& meshes = nullptr);

/// Reads and parses the file at `path`, and the meshes that it names.
[[nodiscard]] model::Result<LoadedCell, ConfigError> load_cell(const std::string& path);

}  // namespace interlace::app
