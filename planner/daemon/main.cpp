#include <fmt/format.h>

#include <cstdio>

#include "common/app/command_line.hpp"
#include "common/app/signals.hpp"
#include "planner/core/strategy.hpp"
#include "planner/daemon/planner_node.hpp"

using namespace interlace;
using app::ExitCode;

int main(int argc, char** argv) {
  try {
    app::Signals signals;
    CLI::App cli{"The planner of a cell: takes commands, decides when each motion starts so that nothing touches, and says why."};
    std::string file, strategy;
    int domain = 0;
    auto level = app::LogLevel::info;
    cli.add_option("CELL", file, "cell file (deploy/cells/*/cell.yaml)")->required();
    cli.add_option("--strategy", strategy, fmt::format("one of {}; default: the cell file's", fmt::join(core::strategy_names(), ", ")))
        ->check(CLI::IsMember(std::vector<std::string>{core::strategy_names().begin(), core::strategy_names().end()}));
    app::add_domain(cli, domain);
    app::add_log_level(cli, level);
    app::add_common(cli);
    if (const auto code = app::parse(cli, argc, argv)) return app::to_int(*code);
    app::start_logging("planner", level);
    auto cell = app::load_cell(file);
    if (!cell) {
      fmt::print(stderr, "{}\n", to_string(cell.error()));
      return app::to_int(ExitCode::bad_input);
    }
    daemon::PlannerNode node{std::move(*cell), {static_cast<std::uint32_t>(domain), strategy}};
    signals.on_signal([&](int, int) { node.stop(); });
    node.run();
    signals.stop_calling();
    return app::to_int(ExitCode::ok);
  } catch (const std::exception& e) {
    fmt::print(stderr, "interlace-planner: {}\n", e.what());
    return app::to_int(ExitCode::fault);
  }
}
