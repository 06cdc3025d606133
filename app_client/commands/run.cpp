#include <fmt/format.h>

#include <cstdio>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "app_client/clearance_watch.hpp"
#include "app_client/commands/command.hpp"
#include "app_client/output.hpp"
#include "app_client/program_run.hpp"
#include "common/app/config/program_file.hpp"

namespace interlace::client::commands {

namespace {

using app::ExitCode;

struct RunArguments {
  CellOptions cell;
  std::string program, report, cell_file;
  bool quiet = false;
  ProgramRunOptions options;
};

ExitCode refuse(const app::ConfigError& error) {
  fmt::print(stderr, "{}\n", to_string(error));
  return ExitCode::bad_input;
}

void show_change(const PlannedCommand* planned, const Answer& answer, double t) {
  const auto& status = answer.status;
  if (status.state == model::CommandState::queued) return;  // a whole program is queued within a moment
  if (!planned) {
    fmt::print(stderr, "{:8.2f} s  {} {}\n", t, status.robot.str(), describe_escape(status));
    return;
  }
  const bool warning = status.reason == model::Reason::deadlock && status.state == model::CommandState::waiting;
  fmt::print(stderr, "{:8.2f} s  {} {}/{}  {}{}\n", t, status.robot.str(), planned->ordinal, planned->of, warning ? "WARNING " : "",
             describe(status));
}

/// Says why a run ended before its program did.
void explain(RunEnd end, const RunArguments& a, const Client& client) {
  switch (end) {
    case RunEnd::finished: return;
    case RunEnd::interrupted: fmt::print(stderr, "interrupted: what had not started was given up\n"); return;
    case RunEnd::stalled:
      fmt::print(stderr, "nothing has moved for {:g} s and nothing can: what had not started was given up\n", a.options.stalled_after);
      return;
    case RunEnd::planner_lost:
      fmt::print(stderr, "the planner {}: the rest of the program was not sent\n",
                 client.planner_replaced() ? "was restarted" : "is not heard any more");
      return;
  }
}

ExitCode judge(RunEnd end, const app::RunReport& report, const Client& client) {
  if (report.collisions && *report.collisions > 0) return ExitCode::collision;
  if (end == RunEnd::interrupted) return ExitCode::interrupted;
  if (end == RunEnd::planner_lost && !client.planner_replaced()) return ExitCode::unavailable;
  return report.completed == report.submitted ? ExitCode::ok : ExitCode::unserved;
}

/// Fails when the cell file is not the one the planner works with.
bool same_cell(const app::LoadedCell& cell, const RunArguments& a, const Client& client) {
  if (cell.cell.name != a.cell.cell) {
    fmt::print(stderr, "--cell: found \"{}\", but {} describes cell {}\n", a.cell.cell, a.cell_file, cell.cell.name);
    return false;
  }
  if (cell.fingerprint != client.planner()->fingerprint) {
    fmt::print(stderr, "{}: differs from the cell file the planner works with\n", a.cell_file);
    return false;
  }
  return true;
}

void add_clearance(const ClearanceWatch& clearance, app::RunReport& report) {
  if (!clearance.saw_anything()) return;
  report.least_clearance = clearance.observer().least_clearance();
  report.fixture_contacts = clearance.observer().fixtures().report();
  report.collisions = clearance.observer().contacts();
}

ExitCode conduct(const RunArguments& a, Client& client, const model::Program& program, const app::LoadedCell* cell,
                 Interrupts& interrupts) {
  std::optional<ClearanceWatch> clearance;
  if (cell) {
    clearance.emplace(*cell, LocalTime::clock::now());
    client.on_posture([&](const dds::PostureMessage& m, LocalTime received) { clearance->on_posture(m, received); });
    for (const auto& robot : cell->cell.robots) client.follow(robot.name);
  }
  ProgramRun run{client, release_plan(program, make_id("run")), a.options, a.quiet ? ProgramRun::OnChange{} : show_change};
  const RunEnd end = run.run([&] { return interrupts.requested(); });
  app::RunReport report = run.report();
  if (clearance) add_clearance(*clearance, report);
  explain(end, a, client);
  const std::string json = nlohmann::json::array({to_json(report)}).dump(2);  // an array, as interlace-sim writes it
  std::cout << (a.cell.json ? json + '\n' : summary(report)) << std::flush;
  if (!a.report.empty() && !write_file(a.report, json)) return ExitCode::fault;
  return judge(end, report, client);
}

ExitCode execute(const RunArguments& a, Interrupts& interrupts) {
  // Everything that can be wrong without a planner is found before one is asked for.
  if (const auto program = app::load_program(a.program, nullptr); !program) {
    return refuse(program.error());
  } else if (!program->events.empty()) {
    fmt::print(stderr, "{}: events: only interlace-sim plays them; here `interlace hold`, `resume`, `cancel` and `replace` do\n",
               a.program);
    return ExitCode::bad_input;
  }
  std::optional<app::LoadedCell> cell;
  if (!a.cell_file.empty()) {
    auto loaded = app::load_cell(a.cell_file);
    if (!loaded) return refuse(loaded.error());
    cell = std::move(*loaded);
  }
  Client client{client_options(a.cell)};
  const Interrupts::Scope scope{interrupts, [&] { client.wake(); }};
  if (const auto code = connect(client, a.cell, interrupts)) return *code;
  if (cell && !same_cell(*cell, a, client)) return ExitCode::bad_input;
  std::vector<model::RobotName> robots;
  for (const auto& robot : client.planner()->robots) robots.push_back(robot.name);
  const auto program = app::load_program(a.program, robots);
  if (!program) return refuse(program.error());
  return conduct(a, client, *program, cell ? &*cell : nullptr, interrupts);
}

}  // namespace

Command run(CLI::App& parent) {
  auto a = std::make_shared<RunArguments>();
  auto* command = parent.add_subcommand("run", "run a program on a cell and report what became of it");
  command->add_option("PROGRAM", a->program, "program file (deploy/cells/*/program.yaml)")->required();
  add_cell_options(*command, a->cell);
  command->add_option("--report", a->report, "write the report to this JSON file");
  command->add_option("--cell-file", a->cell_file, "also watch the clearance between the robots, whose bodies stand in this cell file");
  command->add_option("--stalled-after", a->options.stalled_after, "give up when nothing has moved for this many seconds; 0: never")
      ->check(CLI::Range(0.0, 1e7))
      ->capture_default_str();
  command->add_flag("--quiet", a->quiet, "no line on stderr for each change of a command");
  command->footer(
      "Ctrl-C gives up what has not started, waits for running motions and reports; a second Ctrl-C leaves at once.\n"
      "Example:\n  interlace run deploy/cells/exp-4-2/program.yaml --cell exp-4-2 --report report.json");
  return {command, [a](Interrupts& interrupts) { return execute(*a, interrupts); }};
}

}  // namespace interlace::client::commands
