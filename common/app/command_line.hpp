#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "common/app/exit_code.hpp"
#include "common/app/logging.hpp"

namespace interlace::app {

inline constexpr int kMaxDomain = 232;  ///< the last one whose ports fit into 16 bits

/// Version of this build, "0.1.0".
[[nodiscard]] const char* version();

/// Gives `app` --version and the exit codes at the end of --help.
void add_common(CLI::App& app);

/// --domain 0 … 232, else the environment's INTERLACE_DOMAIN, else 0; checked wherever it comes from.
CLI::Option* add_domain(CLI::App& app, int& domain);

/// --log debug|info|warning|error, else info.
CLI::Option* add_log_level(CLI::App& app, LogLevel& level);

/// Parses the arguments. Empty: go on. Otherwise end with this code; everything there is to say has been printed (help and version to
/// stdout, a mistake to stderr).
[[nodiscard]] std::optional<ExitCode> parse(CLI::App& app, int argc, const char* const* argv);

}  // namespace interlace::app
