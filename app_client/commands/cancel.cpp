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
using model::CommandState;

struct CancelArguments {
  CellOptions cell;
  std::string robot, id;
};

ExitCode execute(const CancelArguments& a, Interrupts& interrupts) {
  Client client{client_options(a.cell)};
  const Interrupts::Scope scope{interrupts, [&] { client.wake(); }};
  if (const auto code = connect(client, a.cell, interrupts)) return *code;
  if (!check_robot(client, a.robot)) return ExitCode::bad_input;
  const auto id = client.cancel(model::RobotName{a.robot}, model::CommandId{a.id});
  if (!id) {
    fmt::print(stderr, "{}: {}\n", a.id, to_string(id.error()));
    return ExitCode::bad_input;
  }
  (void)client.spin_until(after_seconds(a.cell.timeout), [&] {
    const auto& status = client.find(*id)->status;
    return interrupts.requested() || model::is_final(status.state) || status.state == CommandState::started || status.escape;
  });
  const Answer& answer = *client.find(*id);
  std::cout << (a.cell.json ? to_json(answer).dump(2) : fmt::format("{} {}", a.id, describe(answer.status))) << '\n' << std::flush;
  if (answer.status.escape) {
    fmt::print(stderr, "{} is an escape of the planner: cancel the command it serves, {}\n", a.id, answer.status.serves.str());
  }
  if (interrupts.requested()) return ExitCode::interrupted;
  if (!answer.told) return ExitCode::unavailable;
  return answer.status.state == CommandState::cancelled ? ExitCode::ok : ExitCode::unserved;
}

}  // namespace

Command cancel(CLI::App& parent) {
  auto a = std::make_shared<CancelArguments>();
  auto* command = parent.add_subcommand("cancel", "give up a command that has not started");
  command->add_option("ROBOT", a->robot, "whose command")->required();
  command->add_option("ID", a->id, "of the command, see `interlace status`")->required();
  add_cell_options(*command, a->cell);
  command->footer(
      "Ends with 0 when the command was given up, with 1 when it had started, was final, is not known or is an escape.\n"
      "Example:\n  interlace cancel r1 send-4k9x2m7p0qvd --cell exp-4-2");
  return {command, [a](Interrupts& interrupts) { return execute(*a, interrupts); }};
}

}  // namespace interlace::client::commands
