#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <thread>

#include "common/app/command_line.hpp"
#include "common/app/config/cell_file.hpp"
#include "common/app/guarded_main.hpp"
#include "common/app/interrupts.hpp"
#include "planner/core/strategy.hpp"
#include "simulator/campaign.hpp"

using namespace interlace;
using app::ExitCode;

namespace {

struct Arguments {
  std::vector<std::string> cells;
  std::string report;
  std::size_t show = 10;
  bool json = false;
  sim::CampaignOptions options;
};

std::optional<ExitCode> parse(int argc, char** argv, Arguments& a) {
  CLI::App cli{
      "Runs random programs on cells in virtual time, one after the other, and looks for anything that must not happen: robots that\n"
      "touch (from their joints every millisecond, by code that is not the planner's), commands left unserved, rejected, lost or ended\n"
      "twice, escapes that help no command. The programs are well-formed (interlace-generate), so all of it can be served.\n"
      "Each failing program is told as a command line that runs it again.\n\n"
      "  interlace-campaign --cells deploy/cells/pattern-* --commands 100000 --report campaign.json"};
  a.options.jobs = std::max(1U, std::thread::hardware_concurrency());
  cli.add_option("--cells", a.cells, "folders with a cell.yaml, or cell files; programs go to them in turn")->required();
  cli.add_option("--commands", a.options.commands, "run programs until they have this many")
      ->check(CLI::Range(1, 100'000'000))
      ->capture_default_str();
  cli.add_option("--per-robot", a.options.per_robot, "commands for each robot in a program")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  cli.add_option("--seed", a.options.seed, "of the first program; the next has the next one")->capture_default_str();
  cli.add_option("--strategy", a.options.strategy, fmt::format("how starts are chosen: {}", fmt::join(core::strategy_names(), ", ")))
      ->capture_default_str();
  cli.add_option("--resolution", a.options.resolution,
                 "of the collision maps in s, instead of the cells' own: coarser is faster and more cautious")
      ->check(CLI::Range(0.001, 1.0));
  cli.add_option("--jobs", a.options.jobs, "programs at a time; the result does not depend on it")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  cli.add_option("--show", a.show, "failing programs to print at most; the report has all")->capture_default_str();
  cli.add_option("--report", a.report, "write the report to this JSON file");
  cli.add_flag("--json", a.json, "print the report as JSON instead of a table");
  app::add_common(cli);
  return app::parse(cli, argc, argv);
}

double elapsed_seconds() {
  static const auto begin = std::chrono::steady_clock::now();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

void show_progress(const sim::CampaignProgress& p) {
  fmt::print(stderr, "{} of {} commands, {} of {} programs, {} failing, {} collisions, {:.0f} s\n", p.commands, p.commands_in_all,
             p.programs, p.programs_in_all, p.failing, p.collisions, elapsed_seconds());
}

ExitCode judge(const sim::CampaignReport& report) {
  for (const auto& row : report.rows) {
    if (row.collisions > 0) return ExitCode::collision;
  }
  if (!report.failing.empty()) return ExitCode::unserved;
  return report.stopped ? ExitCode::interrupted : ExitCode::ok;
}

ExitCode run(Arguments& a) {
  for (const std::string& given : a.cells) {
    const std::string path = std::filesystem::is_directory(given) ? (std::filesystem::path{given} / "cell.yaml").string() : given;
    auto loaded = app::load_cell(path);
    if (!loaded) {
      fmt::print(stderr, "{}\n", to_string(loaded.error()));
      return ExitCode::bad_input;
    }
    a.options.cells.push_back({given, std::make_shared<const model::Cell>(std::move(loaded->cell))});
  }
  if (!core::is_strategy(a.options.strategy)) {
    fmt::print(stderr, "--strategy: found \"{}\", expected one of: {}\n", a.options.strategy, fmt::join(core::strategy_names(), " "));
    return ExitCode::bad_input;
  }
  std::ofstream file;
  if (!a.report.empty()) {  // known to be writable before hours of work
    file.open(a.report);
    if (!file) {
      fmt::print(stderr, "{}: cannot be written\n", a.report);
      return ExitCode::bad_input;
    }
  }
  const app::Interrupts interrupts;
  a.options.stop = [&interrupts] { return interrupts.requested(); };
  a.options.stopwatch = elapsed_seconds;
  a.options.progress = show_progress;
  const auto report = sim::run_campaign(a.options);
  if (a.json) {
    std::cout << to_json(report).dump(2) << '\n';
  } else {
    std::cout << summary(report, a.show) << std::flush;
  }
  if (!a.report.empty()) {
    file << to_json(report).dump(2) << '\n';
    file.close();
    if (!file) {
      fmt::print(stderr, "{}: cannot be written\n", a.report);
      return ExitCode::fault;
    }
  }
  return judge(report);
}

}  // namespace

int main(int argc, char** argv) {
  return app::guarded_main("interlace-campaign", [&] {
    Arguments arguments;
    const auto code = parse(argc, argv, arguments);
    return code ? *code : run(arguments);
  });
}
