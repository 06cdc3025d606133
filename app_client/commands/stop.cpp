#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "app_client/commands/command.hpp"
#include "app_client/output.hpp"

namespace interlace::client::commands {

namespace {

using app::ExitCode;

struct Arguments {
  CellOptions cell;
  std::vector<std::string> robots;
};

ExitCode show(const Client& client, const std::vector<model::CommandId>& requests, bool as_json) {
  bool all_told = true;
  nlohmann::json json = nlohmann::json::array();
  for (const auto& id : requests) {
    const Answer& answer = *client.find(id);
    const bool told = answer.told && model::is_final(answer.status.state);
    all_told = all_told && told;
    if (as_json) {
      json.push_back(to_json(answer));
    } else {
      std::cout << fmt::format("{}: {}\n", answer.status.robot.str(),
                               told ? answer.status.text : "NOT STOPPED, the planner did not answer");
    }
  }
  if (as_json) std::cout << json.dump(2) << '\n';
  std::cout << std::flush;
  return all_told ? ExitCode::ok : ExitCode::unavailable;
}

ExitCode execute(const Arguments& a, Interrupts& interrupts) {
  Client client{client_options(a.cell)};
  const Interrupts::Scope scope{interrupts, [&] { client.wake(); }};
  if (const auto code = connect(client, a.cell, interrupts)) return *code;
  std::vector<model::RobotName> robots;
  for (const auto& robot : a.robots) {
    if (!check_robot(client, robot)) return ExitCode::bad_input;
    robots.emplace_back(robot);
  }
  if (robots.empty()) {
    for (const auto& robot : client.planner()->robots) robots.push_back(robot.name);
  }
  std::vector<model::CommandId> requests;
  for (const auto& robot : robots) {
    if (const auto id = client.stop(robot)) requests.push_back(*id);
  }
  const auto answered = [&](const model::CommandId& id) { return model::is_final(client.find(id)->status.state); };
  (void)client.spin_until(after_seconds(a.cell.timeout),
                          [&] { return interrupts.requested() || std::all_of(requests.begin(), requests.end(), answered); });
  return show(client, requests, a.cell.json);
}

}  // namespace

Command stop(CLI::App& parent) {
  auto a = std::make_shared<Arguments>();
  auto* command = parent.add_subcommand("stop", "give up everything that has not started");
  command->add_option("ROBOT", a->robots, "which robots; default: all");
  add_cell_options(*command, a->cell);
  command->footer("A running motion ends where it was going: this is no emergency stop.\nExample:\n  interlace stop --cell exp-4-2");
  return {command, [a](Interrupts& interrupts) { return execute(*a, interrupts); }};
}

}  // namespace interlace::client::commands
