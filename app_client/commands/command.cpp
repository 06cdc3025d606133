#include "app_client/commands/command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>

#include "app_client/output.hpp"
#include "common/app/command_line.hpp"

namespace interlace::client::commands {

namespace {

app::ExitCode complain(const Client& client, const CellOptions& options, const Interrupts& interrupts) {
  if (interrupts.requested()) return app::ExitCode::interrupted;
  if (client.planner()) {
    fmt::print(stderr, "the planner of cell {} is heard, but its queues did not answer within {:g} s\n", options.cell, options.timeout);
  } else {
    fmt::print(stderr, "no planner of cell {} was heard on domain {} within {:g} s; is `interlace-planner` running?\n", options.cell,
               options.domain, options.timeout);
  }
  return app::ExitCode::unavailable;
}

}  // namespace

void add_cell_options(CLI::App& command, CellOptions& options) {
  const auto valid_name = [](const std::string& text) {
    return model::is_valid_name(text) ? std::string{} : "a name is 1 to 64 letters, digits, '_', '-', '.' or ':'";
  };
  command.add_option("--cell", options.cell, "name of the running cell, as in its cell file")
      ->required()
      ->check(CLI::Validator{valid_name, "NAME"});
  app::add_domain(command, options.domain);
  command.add_option("--timeout", options.timeout, "seconds to wait for the planner")
      ->check(CLI::Range(0.0, 86400.0))
      ->capture_default_str();
  command.add_flag("--json", options.json, "print JSON on stdout");
}

LocalTime after_seconds(double seconds) {
  return LocalTime::clock::now() + std::chrono::duration_cast<LocalDuration>(std::chrono::duration<double>{seconds});
}

ClientOptions client_options(const CellOptions& options) {
  ClientOptions out;
  out.cell = options.cell;
  out.domain = static_cast<std::uint32_t>(options.domain);
  out.name = make_id("cli");
  return out;
}

std::optional<app::ExitCode> connect(Client& client, const CellOptions& options, const Interrupts& interrupts) {
  if (client.connect(after_seconds(options.timeout), [&] { return interrupts.requested(); })) return std::nullopt;
  return complain(client, options, interrupts);
}

std::optional<app::ExitCode> hear_planner(Client& client, const CellOptions& options, const Interrupts& interrupts) {
  if (client.hear_planner(after_seconds(options.timeout), [&] { return interrupts.requested(); })) return std::nullopt;
  return complain(client, options, interrupts);
}

bool check_robot(const Client& client, const std::string& robot) {
  const auto& robots = client.planner()->robots;
  if (std::any_of(robots.begin(), robots.end(), [&](const model::RobotStatus& r) { return r.name.str() == robot; })) return true;
  std::string names;
  for (const auto& r : robots) names += (names.empty() ? "" : ", ") + r.name.str();
  fmt::print(stderr, "unknown robot \"{}\", cell {} has {}\n", robot, client.planner()->cell, names);
  return false;
}

app::ExitCode ask_each(const CellOptions& options, const std::vector<std::string>& robots, Interrupts& interrupts,
                       const std::function<model::Result<model::CommandId, SubmitError>(Client&, const model::RobotName&)>& give,
                       const std::string& unanswered) {
  Client client{client_options(options)};
  const Interrupts::Scope scope{interrupts, [&] { client.wake(); }};
  if (const auto code = connect(client, options, interrupts)) return *code;
  std::vector<model::RobotName> names;
  for (const auto& robot : robots) {
    if (!check_robot(client, robot)) return app::ExitCode::bad_input;
    names.emplace_back(robot);
  }
  if (names.empty()) {
    for (const auto& robot : client.planner()->robots) names.push_back(robot.name);
  }
  std::vector<model::CommandId> requests;
  for (const auto& robot : names) {
    if (const auto id = give(client, robot)) requests.push_back(*id);
  }
  const auto answered = [&](const model::CommandId& id) { return model::is_final(client.find(id)->status.state); };
  (void)client.spin_until(after_seconds(options.timeout),
                          [&] { return interrupts.requested() || std::all_of(requests.begin(), requests.end(), answered); });
  bool all_told = true;
  nlohmann::json json = nlohmann::json::array();
  for (const auto& id : requests) {
    const Answer& answer = *client.find(id);
    const bool told = answer.told && model::is_final(answer.status.state);
    all_told = all_told && told;
    json.push_back(to_json(answer));
    if (!options.json) std::cout << fmt::format("{}: {}\n", answer.status.robot.str(), told ? answer.status.text : unanswered);
  }
  if (options.json) std::cout << json.dump(2) << '\n';
  std::cout << std::flush;
  return all_told ? app::ExitCode::ok : app::ExitCode::unavailable;
}

bool write_file(const std::string& path, const std::string& text) {
  std::ofstream out{path};
  out << text << '\n';
  out.close();
  if (!out) fmt::print(stderr, "{}: cannot be written\n", path);
  return static_cast<bool>(out);
}

}  // namespace interlace::client::commands
