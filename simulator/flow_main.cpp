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
#include "simulator/flow.hpp"

using namespace interlace;
using app::ExitCode;

namespace {

struct Arguments {
  std::string cell, report;
  bool json = false;
  sim::FlowOptions options;
};

std::optional<ExitCode> parse(int argc, char** argv, Arguments& a) {
  CLI::App cli{
      "Measures in virtual time how long commands take from submission to completion when they arrive over time: as a Poisson process,\n"
      "at shares of what strategy `event` completes with all commands there from the start. Every strategy gets the same random programs\n"
      "(interlace-generate) with the same arrivals. A strategy without escapes may leave commands undone: times are those of the\n"
      "completed ones, so look at how many these are.\n\n"
      "  interlace-flow deploy/cells/pattern-triangle-3 --strategies zone acm event --loads 0.5 0.8 0.95 --report flow.json"};
  a.options.jobs = std::max(1U, std::thread::hardware_concurrency());
  cli.add_option("CELL", a.cell, "cell file, or a folder with a cell.yaml")->required();
  cli.add_option("--strategies", a.options.strategies, fmt::format("one or more of: {}", fmt::join(core::strategy_names(), ", ")))
      ->capture_default_str();
  cli.add_option("--loads", a.options.loads, "rates of arrival, as shares of the throughput of the reference")
      ->check(CLI::Range(0.001, 10.0))
      ->capture_default_str();
  cli.add_option("--reference", a.options.reference, "the strategy whose throughput counts as 1")->capture_default_str();
  cli.add_option("--programs", a.options.programs, "random programs for each load")->check(CLI::Range(1, 10'000))->capture_default_str();
  cli.add_option("--per-robot", a.options.per_robot, "commands for each robot in a program")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  cli.add_option("--seed", a.options.seed, "of the first program, its arrivals and controllers; the next has the next one")
      ->capture_default_str();
  cli.add_option("--resolution", a.options.resolution,
                 "of the collision maps in s, instead of the cell's own: coarser is faster and more cautious")
      ->check(CLI::Range(0.001, 1.0));
  cli.add_option("--jobs", a.options.jobs, "programs at a time; the result does not depend on it")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  cli.add_option("--report", a.report, "write the report to this JSON file");
  cli.add_flag("--json", a.json, "print the report as JSON instead of a table");
  app::add_common(cli);
  return app::parse(cli, argc, argv);
}

double elapsed_seconds() {
  static const auto begin = std::chrono::steady_clock::now();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// A line on stderr at most every two seconds.
void show_progress(const sim::FlowProgress& p) {
  static double last = 0;
  if (elapsed_seconds() < last + 2) return;
  last = elapsed_seconds();
  fmt::print(stderr, "{} of {} runs, {:.0f} s\n", p.runs, p.runs_in_all, last);
}

bool known(const char* option, const std::string& strategy) {
  if (core::is_strategy(strategy)) return true;
  fmt::print(stderr, "{}: found \"{}\", expected one of: {}\n", option, strategy, fmt::join(core::strategy_names(), " "));
  return false;
}

ExitCode run(Arguments& a) {
  const std::string path = std::filesystem::is_directory(a.cell) ? (std::filesystem::path{a.cell} / "cell.yaml").string() : a.cell;
  auto loaded = app::load_cell(path);
  if (!loaded) {
    fmt::print(stderr, "{}\n", to_string(loaded.error()));
    return ExitCode::bad_input;
  }
  a.options.cell = std::make_shared<const model::Cell>(std::move(loaded->cell));
  if (!known("--reference", a.options.reference)) return ExitCode::bad_input;
  for (const std::string& strategy : a.options.strategies) {
    if (!known("--strategies", strategy)) return ExitCode::bad_input;
  }
  std::ofstream file;
  if (!a.report.empty()) {  // known to be writable before long work
    file.open(a.report);
    if (!file) {
      fmt::print(stderr, "{}: cannot be written\n", a.report);
      return ExitCode::bad_input;
    }
  }
  const app::Interrupts interrupts;
  a.options.stop = [&interrupts] { return interrupts.requested(); };
  a.options.progress = show_progress;
  const auto report = sim::measure_flow(a.options);
  if (!report) {
    fmt::print(stderr, "{}: {}\n", a.cell, report.error());
    return ExitCode::bad_input;
  }
  if (report->stopped) return ExitCode::interrupted;
  std::cout << (a.json ? to_json(*report).dump(2) + '\n' : table(*report)) << std::flush;
  if (!a.report.empty()) {
    file << to_json(*report).dump(2) << '\n';
    file.close();
    if (!file) {
      fmt::print(stderr, "{}: cannot be written\n", a.report);
      return ExitCode::fault;
    }
  }
  return ExitCode::ok;
}

}  // namespace

int main(int argc, char** argv) {
  return app::guarded_main("interlace-flow", [&] {
    Arguments arguments;
    const auto code = parse(argc, argv, arguments);
    return code ? *code : run(arguments);
  });
}
