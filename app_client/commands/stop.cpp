#include <memory>

#include "app_client/commands/command.hpp"

namespace interlace::client::commands {

namespace {

struct Arguments {
  CellOptions cell;
  std::vector<std::string> robots;
};

}  // namespace

Command stop(CLI::App& parent) {
  auto a = std::make_shared<Arguments>();
  auto* command = parent.add_subcommand("stop", "give up everything that has not started");
  command->add_option("ROBOT", a->robots, "which robots; default: all");
  add_cell_options(*command, a->cell);
  command->footer("A running motion ends where it was going: this is no emergency stop.\nExample:\n  interlace stop --cell exp-4-2");
  const auto give = [](Client& client, const model::RobotName& robot) { return client.stop(robot); };
  return {command, [a, give](Interrupts& interrupts) {
            return ask_each(a->cell, a->robots, interrupts, give, "NOT STOPPED, the planner did not answer");
          }};
}

}  // namespace interlace::client::commands
