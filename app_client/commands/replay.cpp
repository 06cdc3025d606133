#include "recording/replay.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "app_client/commands/recordings.hpp"
#include "planner/core/strategy.hpp"
#include "recording/what_if.hpp"

namespace interlace::client::commands {

namespace {

using app::ExitCode;

struct ReplayArguments {
  std::string file, strategy, cell, report;
  bool json = false;
};

nlohmann::json json_of(const recording::Replay& replay) {
  nlohmann::json json{{"calls", replay.calls}, {"decisions", replay.decisions}, {"identical", !replay.difference}};
  if (const auto& d = replay.difference) {
    json["difference"] = {{"call", d->call},
                          {"at_s", model::to_seconds(d->now)},
                          {"told", d->told},
                          {"recorded_digest", fmt::format("{:016x}", d->recorded.digest)},
                          {"replayed_digest", fmt::format("{:016x}", d->replayed.digest)},
                          {"decided_now", d->decided}};
  }
  return json;
}

bool finish_report(const ReplayArguments& a, const nlohmann::json& json) {
  if (a.json) std::cout << json.dump(2) << '\n' << std::flush;
  return a.report.empty() || write_file(a.report, json.dump(2));
}

ExitCode check_decisions(const ReplayArguments& a, const recording::Recorded& recorded) {
  const auto cell = std::make_shared<const model::Cell>(recorded.cell.cell);
  nlohmann::json json = nlohmann::json::array();
  bool identical = true;
  for (const recording::PlannerLife& life : recorded.lives) {
    const recording::Replay replay = recording::replay(cell, life);
    json.push_back(json_of(replay));
    if (replay.difference) {
      identical = false;
      const auto& d = *replay.difference;
      fmt::print(stderr,
                 "call {} at {:.6f} s of planner time decides differently: told \"{}\", it recorded {} dispatches, {} withdrawals and {} "
                 "statuses (digest {:016x}), now it decides (digest {:016x}): {}\n",
                 d.call, model::to_seconds(d.now), d.told, d.recorded.dispatches, d.recorded.withdrawals, d.recorded.statuses,
                 d.recorded.digest, d.replayed.digest, d.decided);
    } else if (!a.json) {
      std::cout << fmt::format("planner {:016x}: {} calls replayed, {} decisions, all identical\n", life.incarnation, replay.calls,
                               replay.decisions);
    }
  }
  std::cout << std::flush;
  if (!finish_report(a, json)) return ExitCode::fault;
  return identical ? ExitCode::ok : ExitCode::unserved;
}

ExitCode compare(const ReplayArguments& a, const recording::Recorded& recorded) {
  const recording::PlannerLife& life = recorded.lives.front();
  const auto cell = std::make_shared<const model::Cell>(recorded.cell.cell);
  auto other = cell;
  if (!a.cell.empty() && recorded.has_cell_file) {
    auto loaded = app::load_cell(a.cell);
    if (!loaded) {
      fmt::print(stderr, "{}\n", to_string(loaded.error()));
      return ExitCode::bad_input;
    }
    other = std::make_shared<const model::Cell>(std::move(loaded->cell));
  }
  const app::RunReport simulated = recording::what_if(cell, life, life.settings.strategy);
  const app::RunReport changed = recording::what_if(other, life, a.strategy.empty() ? life.settings.strategy : a.strategy);
  if (!a.json)
    std::cout << recording::comparison({{"recorded", recorded.report}, {"simulated the same", simulated}, {"simulated changed", changed}})
              << std::flush;
  const nlohmann::json json{{"recorded", app::to_json(recorded.report)},
                            {"simulated_same", app::to_json(simulated)},
                            {"simulated_changed", app::to_json(changed)}};
  if (!finish_report(a, json)) return ExitCode::fault;
  if (changed.collisions.value_or(0) > 0) return ExitCode::collision;
  return changed.unserved > 0 ? ExitCode::unserved : ExitCode::ok;
}

ExitCode execute_replay(const ReplayArguments& a) {
  const auto& known = core::strategy_names();
  if (!a.strategy.empty() && std::find(known.begin(), known.end(), a.strategy) == known.end()) {
    fmt::print(stderr, "--strategy: found \"{}\", expected one of: {}\n", a.strategy, fmt::join(known, " "));
    return ExitCode::bad_input;
  }
  const auto recorded = recording::read_recorded(a.file, a.cell);
  if (!recorded) {
    fmt::print(stderr, "{}\n", recorded.error());
    return ExitCode::bad_input;
  }
  if (recorded->cut_off)
    fmt::print(stderr, "{}: was not ended properly, it is whole up to byte {}; what its recorder had last heard may be missing\n", a.file,
               *recorded->cut_off);
  const bool changed = !a.strategy.empty() || (!a.cell.empty() && recorded->has_cell_file);
  return changed ? compare(a, *recorded) : check_decisions(a, *recorded);
}

}  // namespace

Command replay(CLI::App& parent) {
  auto a = std::make_shared<ReplayArguments>();
  auto* command = parent.add_subcommand("replay", "makes a recording happen again: the same decisions, or what would have been");
  command->add_option("FILE", a->file, "recording of `interlace record` or `interlace-sim --record`")->required();
  command->add_option("--strategy", a->strategy, "what would have happened with this one");
  command->add_option("--cell", a->cell, "what would have happened with this cell file; when the recording has none, its own");
  command->add_option("--report", a->report, "write what came out to this JSON file");
  command->add_flag("--json", a->json, "print JSON on stdout");
  command->footer(
      "Without --strategy and --cell the planner is told what it was told then, and every decision is compared bit for bit: ends with 0 "
      "when\n"
      "all are identical, 1 when one differs, which is named; 2 when the recording does not begin with the planner or has a gap.\n"
      "With one of them the recorded commands are given at their times in virtual time, and the runs are set side by side: ends with 0, "
      "with\n"
      "1 when a command is left unserved, 3 when robots touch.\n"
      "Example:\n  interlace replay run.mcap\n  interlace replay run.mcap --strategy zone");
  return {command, [a](Interrupts& /*nothing waits*/) { return execute_replay(*a); }};
}

}  // namespace interlace::client::commands
