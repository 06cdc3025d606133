#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "app_client/commands/command.hpp"
#include "app_client/output.hpp"
#include "app_client/release_plan.hpp"
#include "common/app/config/program_file.hpp"
#include "common/dds/limits.hpp"

namespace interlace::client::commands {

namespace {

using app::ExitCode;

struct ReplaceArguments {
  CellOptions cell;
  std::string robot, program;
};

ExitCode refuse(const std::string& text) {
  fmt::print(stderr, "{}\n", text);
  return ExitCode::bad_input;
}

/// What in a program cannot be part of a replacement; empty: nothing.
std::string unfit(const model::Program& program, const ReplaceArguments& a) {
  if (!program.events.empty()) return fmt::format("{}: events: a replacement has commands only", a.program);
  for (const auto& [robot, steps] : program.robots) {
    if (robot.str() != a.robot && !steps.empty())
      return fmt::format("{}: has commands for {} too, not only for {}", a.program, robot.str(), a.robot);
    if (std::any_of(steps.begin(), steps.end(), [](const auto& step) { return step.at > 0; })) {
      return fmt::format("{}: at: the commands of a replacement are released together", a.program);
    }
  }
  if (program.size() > dds::kMaxReplacement) {
    return fmt::format("{}: {} commands, a queue can be replaced by at most {}", a.program, program.size(), dds::kMaxReplacement);
  }
  return {};
}

ExitCode execute(const ReplaceArguments& a, Interrupts& interrupts) {
  const auto program = app::load_program(a.program, nullptr);
  if (!program) return refuse(to_string(program.error()));
  if (const std::string why = unfit(*program, a); !why.empty()) return refuse(why);
  Client client{client_options(a.cell)};
  const Interrupts::Scope scope{interrupts, [&] { client.wake(); }};
  if (const auto code = connect(client, a.cell, interrupts)) return *code;
  if (!check_robot(client, a.robot)) return ExitCode::bad_input;
  std::vector<model::CommandSubmitted> commands;
  for (PlannedCommand& planned : release_plan(*program, make_id("run"))) commands.push_back(std::move(planned.command));
  const auto id = client.replace(model::RobotName{a.robot}, commands);
  if (!id) return refuse(to_string(id.error()));
  (void)client.spin_until(after_seconds(a.cell.timeout),
                          [&] { return interrupts.requested() || model::is_final(client.find(*id)->status.state); });
  const Answer& answer = *client.find(*id);
  if (a.cell.json) {
    nlohmann::json json = to_json(answer);
    json["commands"] = nlohmann::json::array();
    for (const auto& command : commands) json["commands"].push_back(to_json(*client.find(command.id)));
    std::cout << json.dump(2) << '\n' << std::flush;
  } else {
    std::cout << fmt::format("{}: {}\n", a.robot, answer.told ? describe(answer.status) : "NOT REPLACED, the planner did not answer");
    for (const auto& command : commands) std::cout << fmt::format("  {} {}\n", command.id.str(), describe(client.find(command.id)->status));
    std::cout << std::flush;
  }
  if (interrupts.requested()) return ExitCode::interrupted;
  if (!answer.told) return ExitCode::unavailable;
  return answer.status.state == model::CommandState::completed ? ExitCode::ok : ExitCode::unserved;
}

}  // namespace

Command replace(CLI::App& parent) {
  auto a = std::make_shared<ReplaceArguments>();
  auto* command = parent.add_subcommand("replace", "put other commands in the place of all that waits for a robot");
  command->add_option("ROBOT", a->robot, "whose queue")->required();
  command->add_option("PROGRAM", a->program, "program file with the commands for that robot alone, at most 100")->required();
  add_cell_options(*command, a->cell);
  command->footer(
      "The commands are taken all together or, when one of them is impossible, not at all: then the queue stays as it was. What the robot "
      "has\n"
      "begun, or was just told to begin, it ends. Those that go are cancelled with the reason `replaced`. Does not wait for the new ones.\n"
      "Ends with 0 when the queue was replaced, with 1 when it was refused.\n"
      "Example:\n  interlace replace r1 new-program.yaml --cell exp-4-2");
  return {command, [a](Interrupts& interrupts) { return execute(*a, interrupts); }};
}

}  // namespace interlace::client::commands
