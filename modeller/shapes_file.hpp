#pragma once

#include <string>
#include <vector>

#include "common/app/config/finding.hpp"
#include "common/model/result.hpp"
#include "modeller/shape.hpp"

namespace interlace::modeller {

/// The shapes listed in the file at `path` (format: docs/models.md), at least one. Meshes are looked for beside the file; they are not read
/// here. Errors name line, key and rule. Blocks as the file system does; any thread.
[[nodiscard]] model::Result<std::vector<Shape>, app::ConfigError> load_shapes(const std::string& path);

}  // namespace interlace::modeller
