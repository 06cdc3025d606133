#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <optional>
#include <string>

#include "app_client/client.hpp"
#include "app_client/interrupts.hpp"
#include "common/app/exit_code.hpp"

/// The sub-commands of `interlace`: each adds its options to the command line and says how to run.
namespace interlace::client::commands {

struct Command {
  CLI::App* options;  ///< parsed() when it was chosen
  std::function<app::ExitCode(Interrupts&)> run;
};

[[nodiscard]] Command run(CLI::App& parent);
[[nodiscard]] Command send(CLI::App& parent);
[[nodiscard]] Command status(CLI::App& parent);
[[nodiscard]] Command watch(CLI::App& parent);
[[nodiscard]] Command cancel(CLI::App& parent);
[[nodiscard]] Command stop(CLI::App& parent);

/// What every sub-command needs to find its cell.
struct CellOptions {
  std::string cell;
  int domain = 0;
  double timeout = 10;  ///< for the planner to be heard [s]
  bool json = false;
};

/// Adds --cell, --domain, --timeout and --json.
void add_cell_options(CLI::App& command, CellOptions& options);

[[nodiscard]] LocalTime after_seconds(double seconds);

[[nodiscard]] ClientOptions client_options(const CellOptions& options);

/// Connects to the planner's state and to its queues. Empty: done. Otherwise what to end with; the reason has been printed.
[[nodiscard]] std::optional<app::ExitCode> connect(Client& client, const CellOptions& options, const Interrupts& interrupts);
/// The same for the planner's state alone.
[[nodiscard]] std::optional<app::ExitCode> hear_planner(Client& client, const CellOptions& options, const Interrupts& interrupts);

/// Says so on stderr when the cell has no robot of that name.
[[nodiscard]] bool check_robot(const Client& client, const std::string& robot);

/// Writes `text` and a newline to the file; complains on stderr when that fails.
[[nodiscard]] bool write_file(const std::string& path, const std::string& text);

}  // namespace interlace::client::commands
