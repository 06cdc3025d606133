#pragma once

#include "app_client/commands/command.hpp"

/// The sub-commands that write recordings and make them happen again.
namespace interlace::client::commands {

[[nodiscard]] Command record(CLI::App& parent);
[[nodiscard]] Command replay(CLI::App& parent);

}  // namespace interlace::client::commands
