#include <memory>

#include "app_client/commands/command.hpp"

namespace interlace::client::commands {

namespace {

struct Arguments {
  CellOptions cell;
  std::vector<std::string> robots;
};

}  // namespace

Command hold(CLI::App& parent) {
  auto a = std::make_shared<Arguments>();
  auto* command = parent.add_subcommand("hold", "have robots end what they do and start nothing more");
  command->add_option("ROBOT", a->robots, "which robots; default: all");
  add_cell_options(*command, a->cell);
  command->footer(
      "A held robot ends the motion it has begun and then stands: its commands wait, and it is not moved out of anybody's way either. The "
      "hold\n"
      "ends with `interlace resume` and with nothing else; a planner that is restarted learns of it from the robot's proxy.\n"
      "This is no emergency stop and protects nobody.\n"
      "Example:\n  interlace hold r1 --cell exp-4-2");
  const auto give = [](Client& client, const model::RobotName& robot) { return client.hold(robot); };
  return {command, [a, give](Interrupts& interrupts) {
            return ask_each(a->cell, a->robots, interrupts, give, "NOT HELD, the planner did not answer");
          }};
}

Command resume(CLI::App& parent) {
  auto a = std::make_shared<Arguments>();
  auto* command = parent.add_subcommand("resume", "end the hold of robots: they go on with what waits for them");
  command->add_option("ROBOT", a->robots, "which robots; default: all");
  add_cell_options(*command, a->cell);
  command->footer("Example:\n  interlace resume r1 --cell exp-4-2");
  const auto give = [](Client& client, const model::RobotName& robot) { return client.resume(robot); };
  return {command, [a, give](Interrupts& interrupts) {
            return ask_each(a->cell, a->robots, interrupts, give, "not resumed, the planner did not answer");
          }};
}

}  // namespace interlace::client::commands
