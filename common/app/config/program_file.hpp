#pragma once

#include <string>
#include <vector>

#include "common/app/config/finding.hpp"
#include "common/model/cell.hpp"
#include "common/model/program.hpp"
#include "common/model/result.hpp"

namespace interlace::app {

inline constexpr int kMaxProgramSize = 200'000;  ///< commands of one program, `repeat` unrolled

/// The program in `text` (format: docs/files.md) with `repeat` unrolled: the whole list of a robot that many times, each with the
/// release times (`at`) of the file, counted from the start of the program. `file_name` only appears in messages. Robots must be among
/// `robots`. Whether the targets can be reached is not asked here: the planner judges a command from where its robot stands then. Pure; any
/// thread.
[[nodiscard]] model::Result<model::Program, ConfigError> parse_program(const std::string& text, const std::string& file_name,
                                                                       const std::vector<model::RobotName>& robots);
/// For the robots and tools of `cell`; for any validly named ones when it is null. Without a cell the planner judges a tool's name.
[[nodiscard]] model::Result<model::Program, ConfigError> parse_program(const std::string& text, const std::string& file_name,
                                                                       const model::Cell* cell);

/// Read and parse the file at `path`.
[[nodiscard]] model::Result<model::Program, ConfigError> load_program(const std::string& path, const std::vector<model::RobotName>& robots);
[[nodiscard]] model::Result<model::Program, ConfigError> load_program(const std::string& path, const model::Cell* cell);

}  // namespace interlace::app
