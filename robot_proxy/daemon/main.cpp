#include <fmt/format.h>

#include <cstdio>

#include "common/app/command_line.hpp"
#include "common/app/signals.hpp"
#include "robot_proxy/daemon/proxy_node.hpp"
#include "robot_proxy/drivers/sim/sim_driver.hpp"

using namespace interlace;
using app::ExitCode;

int main(int argc, char** argv) {
  try {
    app::Signals signals;
    CLI::App cli{"The proxy of one robot: tells everyone where it is and starts the planner's motions in their windows, or refuses."};
    std::string file, name;
    int domain = 0;
    std::uint64_t seed = 1;
    auto level = app::LogLevel::info;
    cli.add_option("CELL", file, "cell file (deploy/cells/*/cell.yaml), the same the planner reads")->required();
    cli.add_option("--robot", name, "the robot of the cell this proxy stands for")->required();
    cli.add_option("--seed", seed, "of the simulated controller's latency and speed");
    app::add_domain(cli, domain);
    app::add_log_level(cli, level);
    app::add_common(cli);
    if (const auto code = app::parse(cli, argc, argv)) return app::to_int(*code);
    app::start_logging("proxy", level);
    const auto cell = app::load_cell(file);
    const auto robot = cell ? cell->cell.find(model::RobotName{name}) : std::nullopt;
    if (!robot) {
      fmt::print(stderr, "{}\n", cell ? fmt::format("--robot: found \"{}\", expected a robot of {}", name, file) : to_string(cell.error()));
      return app::to_int(ExitCode::bad_input);
    }
    proxy::SimOptions sim{proxy::SimDriver::kPeriod};
    sim.seed = seed + *robot;
    proxy::ProxyNode node{*cell, *robot, static_cast<std::uint32_t>(domain),
                          std::make_unique<proxy::SimDriver>(cell->cell.robots[*robot], sim)};
    signals.on_signal([&](int, int) { node.stop(); });
    node.run();
    signals.stop_calling();
    return app::to_int(ExitCode::ok);
  } catch (const std::exception& e) {
    fmt::print(stderr, "interlace-proxy: {}\n", e.what());
    return app::to_int(ExitCode::fault);
  }
}
