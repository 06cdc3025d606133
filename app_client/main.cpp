#include <fmt/format.h>

#include <cstdio>

#include "app_client/commands/command.hpp"
#include "app_client/commands/recordings.hpp"
#include "common/app/command_line.hpp"

using namespace interlace;
namespace commands = client::commands;

int main(int argc, char** argv) {
  try {
    app::Interrupts interrupts;
    CLI::App cli{"Gives commands to a running cell and shows what becomes of them. `interlace SUBCOMMAND --help` tells more."};
    app::add_common(cli);
    cli.require_subcommand(1);
    const std::vector<commands::Command> all{commands::run(cli),     commands::send(cli),   commands::status(cli), commands::watch(cli),
                                             commands::cancel(cli),  commands::stop(cli),   commands::hold(cli),   commands::resume(cli),
                                             commands::replace(cli), commands::record(cli), commands::replay(cli)};
    if (const auto code = app::parse(cli, argc, argv)) return app::to_int(*code);
    for (const auto& command : all) {
      if (command.options->parsed()) return app::to_int(command.run(interrupts));
    }
    return app::to_int(app::ExitCode::bad_input);
  } catch (const std::exception& e) {
    fmt::print(stderr, "interlace: {}\n", e.what());
    return app::to_int(app::ExitCode::fault);
  }
}
