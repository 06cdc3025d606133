#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <optional>

#include "common/app/command_line.hpp"
#include "common/app/signals.hpp"
#include "monitor/daemon/monitor_node.hpp"
#include "monitor/daemon/player_node.hpp"

using namespace interlace;
using app::ExitCode;

namespace {

/// Shows the address, and works until a signal.
template <typename Node>
int serve(Node& node, app::Signals& signals) {
  signals.on_signal([&](int, int) { node.stop(); });
  fmt::print("{}\n", node.url());
  std::fflush(stdout);
  node.run();
  signals.stop_calling();
  return app::to_int(ExitCode::ok);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    app::Signals signals;
    CLI::App cli{
        "Shows a running cell, or a recording of one, in a browser: the arms, what each command waits for and until when, and how near "
        "everything comes.\n"
        "Reads what the cell's processes say to each other and writes nothing to them. Prints the address of the page.\n"
        "With --ros2-domain also for ROS 2's tools, such as RViz, Foxglove and `ros2 topic echo` (docs/ros2.md)."};
    std::string file, recording,
        folder = std::filesystem::canonical("/proc/self/exe").parent_path().parent_path() / "share/interlace/monitor";
    monitor::ServerOptions server;
    int domain = 0;
    std::optional<std::uint32_t> ros2_domain;
    auto level = app::LogLevel::info;
    cli.add_option("CELL", file, "cell file (deploy/cells/*/cell.yaml): the same as the planner's");
    cli.add_option("--recording", recording,
                   "play this file of `interlace record` or `interlace-sim --record`; CELL is for one without its cell");
    cli.add_option("--listen", server.address, "address to serve on; 0.0.0.0 lets everyone on the network look on")->capture_default_str();
    cli.add_option("--port", server.port,
                   fmt::format("0 takes any free one; default: {}, or the next that is free", monitor::kDefaultPort));
    cli.add_option("--viewers", server.viewers, "at most so many pages look on at a time")
        ->check(CLI::Range(1, 100))
        ->capture_default_str();
    cli.add_option("--page", folder, "folder of the page; default: the one built or installed with this program");
    cli.add_option("--ros2-domain", ros2_domain,
                   "show the cell to ROS 2 on this DDS domain, ROS 2's own ROS_DOMAIN_ID; another than the cell's")
        ->check(CLI::Range(0, app::kMaxDomain));
    app::add_domain(cli, domain);
    app::add_log_level(cli, level);
    app::add_common(cli);
    if (const auto code = app::parse(cli, argc, argv)) return app::to_int(*code);
    app::start_logging("monitor", level);
    if (file.empty() && recording.empty())
      return fmt::print(stderr, "CELL: found nothing, expected a cell file or --recording FILE\n"), app::to_int(ExitCode::bad_input);
    if (ros2_domain && !recording.empty()) {
      return fmt::print(stderr, "--ros2-domain: found it with --recording, expected it with a running cell alone\n"),
             app::to_int(ExitCode::bad_input);
    }
    if (ros2_domain == static_cast<std::uint32_t>(domain)) {
      return fmt::print(stderr, "--ros2-domain {0}: found the cell's own domain, expected another one\n", domain),
             app::to_int(ExitCode::bad_input);
    }
    auto page = monitor::Bundle::load(folder);
    if (!page) return fmt::print(stderr, "no page to serve: {}\n", page.error()), app::to_int(ExitCode::unavailable);
    if (!recording.empty()) {
      auto playback = monitor::Playback::open(recording, file);
      if (!playback) return fmt::print(stderr, "{}\n", playback.error()), app::to_int(ExitCode::bad_input);
      monitor::PlayerNode node{std::move(*playback), server, std::move(*page)};
      return serve(node, signals);
    }
    auto cell = app::load_cell(file);
    if (!cell) return fmt::print(stderr, "{}\n", to_string(cell.error())), app::to_int(ExitCode::bad_input);
    monitor::MonitorNode node{std::move(*cell), static_cast<std::uint32_t>(domain), server, std::move(*page), ros2_domain};
    return serve(node, signals);
  } catch (const std::exception& e) {
    fmt::print(stderr, "interlace-monitor: {}\n", e.what());
    return app::to_int(ExitCode::fault);
  }
}
