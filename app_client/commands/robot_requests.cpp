// stop, hold, resume: one request for each robot, or for all, and its answers.
#include <memory>

#include "app_client/commands/command.hpp"

namespace interlace::client::commands {

namespace {

struct RobotArguments {
  CellOptions cell;
  std::vector<std::string> robots;
};

using Give = model::Result<model::CommandId, SubmitError> (Client::*)(const model::RobotName&);

struct Request {
  const char* name;
  const char* description;
  const char* footer;
  const char* unanswered;  ///< said of a robot for which no answer came
  Give give;
};

Command request(CLI::App& parent, const Request& r) {
  auto a = std::make_shared<RobotArguments>();
  auto* command = parent.add_subcommand(r.name, r.description);
  command->add_option("ROBOT", a->robots, "which robots; default: all");
  add_cell_options(*command, a->cell);
  command->footer(r.footer);
  return {command, [a, give = r.give, unanswered = r.unanswered](Interrupts& interrupts) {
            const auto ask = [give](Client& client, const model::RobotName& robot) { return (client.*give)(robot); };
            return ask_each(a->cell, a->robots, interrupts, ask, unanswered);
          }};
}

}  // namespace

Command stop(CLI::App& parent) {
  return request(parent, {"stop", "give up everything that has not started",
                          "A running motion ends where it was going: this is no emergency stop.\nExample:\n  interlace stop --cell exp-4-2",
                          "NOT STOPPED, the planner did not answer", &Client::stop});
}

Command hold(CLI::App& parent) {
  return request(
      parent,
      {"hold", "have robots end what they do and start nothing more",
       "A held robot ends the motion it has begun and then stands: its commands wait, and it is not moved out of anybody's way either. The "
       "hold\n"
       "ends with `interlace resume` and with nothing else; a planner that is restarted learns of it from the robot's proxy.\n"
       "This is no emergency stop and protects nobody.\n"
       "Example:\n  interlace hold r1 --cell exp-4-2",
       "NOT HELD, the planner did not answer", &Client::hold});
}

Command resume(CLI::App& parent) {
  return request(parent, {"resume", "end the hold of robots: they go on with what waits for them",
                          "Example:\n  interlace resume r1 --cell exp-4-2", "not resumed, the planner did not answer", &Client::resume});
}

}  // namespace interlace::client::commands
