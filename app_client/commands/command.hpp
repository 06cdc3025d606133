#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app_client/client.hpp"
#include "common/app/exit_code.hpp"
#include "common/app/interrupts.hpp"

/// The sub-commands of `interlace`: each adds its options to the command line and says how to run.
namespace interlace::client::commands {

using app::Interrupts;

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
[[nodiscard]] Command hold(CLI::App& parent);
[[nodiscard]] Command resume(CLI::App& parent);
[[nodiscard]] Command replace(CLI::App& parent);

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

/// Gives one request for each of `robots`, all of the cell when it is empty, waits for the answers and prints them. `unanswered` is what is
/// said of a robot for which none came.
[[nodiscard]] app::ExitCode ask_each(
    const CellOptions& options, const std::vector<std::string>& robots, Interrupts& interrupts,
    const std::function<model::Result<model::CommandId, SubmitError>(Client&, const model::RobotName&)>& give,
    const std::string& unanswered);

/// Writes `text` and a newline to the file; complains on stderr when that fails.
[[nodiscard]] bool write_file(const std::string& path, const std::string& text);

}  // namespace interlace::client::commands
