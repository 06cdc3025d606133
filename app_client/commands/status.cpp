#include <fmt/format.h>

#include <cstdio>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "app_client/commands/command.hpp"
#include "app_client/output.hpp"

namespace interlace::client::commands {

namespace {

using app::ExitCode;

struct StatusArguments {
  CellOptions cell;
  bool watch = false;
};

void show(const Client& client, const StatusArguments& a) {
  const auto& state = *client.planner();
  if (a.cell.json) {
    std::cout << to_json(state, client.planner_alive()).dump(a.watch ? -1 : 2) << '\n' << std::flush;
  } else {
    std::cout << describe(state, client.planner_alive()) << (a.watch ? "\n" : "") << std::flush;
  }
}

ExitCode show_forever(Client& client, const StatusArguments& a, const Interrupts& interrupts) {
  std::optional<std::pair<std::uint64_t, model::Instant>> shown;
  bool alive = true;
  const auto stop_or_show = [&] {
    const std::pair newest{client.planner()->incarnation, client.planner()->at};
    if (shown != newest || alive != client.planner_alive()) {
      alive = client.planner_alive();
      show(client, a);
      shown = newest;
    }
    return interrupts.requested();
  };
  while (!client.spin_until(after_seconds(3600), stop_or_show)) {
  }
  return ExitCode::ok;
}

ExitCode execute(const StatusArguments& a, Interrupts& interrupts) {
  Client client{client_options(a.cell)};
  const Interrupts::Scope scope{interrupts, [&] { client.wake(); }};
  if (const auto code = hear_planner(client, a.cell, interrupts)) return *code;
  if (a.watch) return show_forever(client, a, interrupts);
  show(client, a);
  return ExitCode::ok;
}

}  // namespace

Command status(CLI::App& parent) {
  auto a = std::make_shared<StatusArguments>();
  auto* command = parent.add_subcommand("status", "what every robot of a cell does, and what it waits for");
  add_cell_options(*command, a->cell);
  command->add_flag("--watch", a->watch, "again at each change, until Ctrl-C");
  command->footer("Example:\n  interlace status --cell exp-4-2 --watch");
  return {command, [a](Interrupts& interrupts) { return execute(*a, interrupts); }};
}

}  // namespace interlace::client::commands
