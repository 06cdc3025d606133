#include <fmt/format.h>

#include <cstdio>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "app_client/commands/command.hpp"
#include "app_client/output.hpp"
#include "app_client/request.hpp"

namespace interlace::client::commands {

namespace {

using app::ExitCode;
using model::CommandState;

struct SendArguments {
  CellOptions cell;
  std::string robot, id;
  MotionWords motion;
  std::string length = "mm", angle = "deg";
  int priority = 0;
  std::optional<double> deadline;
  bool wait = true;
  double within = 600;  // [s]
};

ExitCode judge(const Answer& answer, const SendArguments& a) {
  const CommandState state = answer.status.state;
  if (state == CommandState::completed) return ExitCode::ok;
  if (!a.wait && !model::is_final(state)) return answer.told ? ExitCode::ok : ExitCode::unavailable;
  return ExitCode::unserved;
}

ExitCode follow(Client& client, const model::CommandSubmitted& command, const SendArguments& a, const Interrupts& interrupts) {
  const LocalTime start = LocalTime::clock::now();
  client.on_answer([&](const Answer& answer) {
    if (a.cell.json) return;
    if (answer.status.id != command.id && answer.status.serves != command.id) return;
    const double t = std::chrono::duration<double>(LocalTime::clock::now() - start).count();
    fmt::print(stderr, "{:8.2f} s  {}  {}\n", t, answer.status.robot.str(),
               answer.status.escape ? describe_escape(answer.status) : describe(answer.status));
  });
  if (const auto submitted = client.submit(command); !submitted) {
    fmt::print(stderr, "{}: {}\n", command.id.str(), to_string(submitted.error()));
    return ExitCode::bad_input;
  }
  const auto enough = [&] {
    const Answer& answer = *client.find(command.id);
    return model::is_final(answer.status.state) || (!a.wait && answer.told) || answer.status.escape;
  };
  bool done = client.spin_until(after_seconds(a.wait ? a.within : a.cell.timeout), [&] { return enough() || interrupts.requested(); });
  if (interrupts.requested() && !enough()) {
    fmt::print(stderr, "interrupted: giving {} up if it has not started\n", command.id.str());
    (void)client.cancel(command.robot, command.id);
    done = client.spin_until(after_seconds(a.cell.timeout),
                             [&] { return enough() || client.find(command.id)->status.state == CommandState::started; });
  }
  const Answer answer = *client.find(command.id);
  if (answer.status.escape) {
    fmt::print(stderr, "--id: found \"{}\", which is an escape of the planner for {}; nothing was sent under it\n", command.id.str(),
               answer.status.serves.str());
    return ExitCode::bad_input;
  }
  if (!done) fmt::print(stderr, "{} is not final yet; it stays with the planner\n", command.id.str());
  std::cout << (a.cell.json ? to_json(answer).dump(2) : fmt::format("{} {}", command.id.str(), describe(answer.status))) << '\n'
            << std::flush;
  return interrupts.requested() ? ExitCode::interrupted : judge(answer, a);
}

ExitCode execute(const SendArguments& a, Interrupts& interrupts) {
  const auto motion = make_request(a.motion, make_units(a.length, a.angle));
  if (!motion) {
    fmt::print(stderr, "{}\n", motion.error());
    return ExitCode::bad_input;
  }
  Client client{client_options(a.cell)};
  const Interrupts::Scope scope{interrupts, [&] { client.wake(); }};
  if (const auto code = connect(client, a.cell, interrupts)) return *code;
  if (!check_robot(client, a.robot)) return ExitCode::bad_input;
  model::CommandSubmitted command;
  command.id = model::CommandId{a.id.empty() ? make_id("send") : a.id};
  command.robot = model::RobotName{a.robot};
  command.motion = *motion;
  command.priority = a.priority;
  command.deadline = a.deadline;
  return follow(client, command, a, interrupts);
}

}  // namespace

Command send(CLI::App& parent) {
  auto a = std::make_shared<SendArguments>();
  auto* command = parent.add_subcommand("send", "send one command and wait until it is done");
  command->add_option("ROBOT", a->robot, "which robot")->required();
  command->add_option("MOVE", a->motion.move, "linear: straight TCP line; joint: synchronised joint move")
      ->required()
      ->check(CLI::IsMember({"linear", "joint"}));
  command
      ->add_option("TARGET", a->motion.values, "linear: X Y Z ROLL PITCH YAW of the TCP in the world frame; joint: J1 … J6, base to flange")
      ->required()
      ->expected(static_cast<int>(model::kJoints));
  add_cell_options(*command, a->cell);
  command->add_option("--unit", a->length, "of lengths: mm or m")->check(CLI::IsMember({"mm", "m"}))->capture_default_str();
  command->add_option("--angle", a->angle, "of angles: deg or rad")->check(CLI::IsMember({"deg", "rad"}))->capture_default_str();
  command->add_option("--velocity", a->motion.velocity, "of the TCP per second; default: the robot's limit");
  command->add_option("--acceleration", a->motion.acceleration, "of the TCP per second²; default: the robot's limit");
  command->add_option("--attach", a->motion.attach, "take this tool or payload of the cell file; from then on it is part of the robot");
  command->add_option("--detach", a->motion.detach, "leave this one where the robot stands");
  command->add_option("--when", a->motion.when, "of --attach and --detach: before the robot starts, or once it has arrived")
      ->check(CLI::IsMember({"start", "completion"}))
      ->capture_default_str();
  command->add_option("--priority", a->priority, "higher goes first where robots compete; a robot's own queue keeps its order")
      ->check(CLI::Range(-1000000, 1000000));
  command
      ->add_option(
          "--deadline", a->deadline,
          "to be done within this many seconds after the planner took it; whether it was is reported as met, late or impossible, and it is "
          "carried out all the same")
      ->check(CLI::Range(0.0, 1e7));
  command->add_option("--id", a->id, "of the command; sent again, it is answered again and not executed again. Default: a new one");
  command->add_flag("--wait,!--no-wait", a->wait, "wait for the end (default), or only for the planner's first answer");
  command->add_option("--within", a->within, "with --wait: stop waiting after this many seconds")
      ->check(CLI::Range(0.0, 1e7))
      ->capture_default_str();
  command->footer(
      "Example:\n  interlace send r1 linear 300 250 330 0 0 0 --cell exp-4-2\n  interlace send r1 joint 0 45 90 0 45 0 --cell exp-4-2 "
      "--no-wait\n  interlace send r1 linear 400 150 200 0 0 0 --cell tools-2 --attach long");
  return {command, [a](Interrupts& interrupts) { return execute(*a, interrupts); }};
}

}  // namespace interlace::client::commands
