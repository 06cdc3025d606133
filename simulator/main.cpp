#include <fmt/format.h>

#include <unistd.h>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>

#include "common/app/command_line.hpp"
#include "common/app/config/cell_file.hpp"
#include "common/app/config/program_file.hpp"
#include "common/app/guarded_main.hpp"
#include "planner/core/strategy.hpp"
#include "simulator/optimum.hpp"
#include "simulator/recording.hpp"
#include "simulator/virtual_cell.hpp"

using namespace interlace;
using app::ExitCode;

namespace {

struct Arguments {
  std::string cell, program, trace, report, record;
  std::string strategy;
  double trace_period = 0.01;
  std::uint64_t seed = 1;
  bool json = false;
  bool optimum = false;
  std::optional<double> promise;  // [s]
};

std::optional<ExitCode> parse(int argc, char** argv, Arguments& a) {
  CLI::App cli{
      "Runs a program on a cell in virtual time: the planner and the simulated controllers of the daemons, without waiting for them.\n"
      "Prints how long it took, what was delayed and whether anything touched."};
  cli.add_option("CELL", a.cell, "cell file (deploy/cells/*/cell.yaml)")->required();
  cli.add_option("PROGRAM", a.program, "program file")->required();
  std::string names = "all";
  for (const auto name : core::strategy_names()) names += fmt::format(", {}", name);
  cli.add_option("--strategy", a.strategy, "how starts are chosen: " + names + "; default: the cell file's");
  cli.add_option("--trace", a.trace, "write postures to this CSV file; with --strategy all the strategy's name goes before the extension");
  cli.add_option(
      "--record", a.record,
      "write everything to this MCAP file, as `interlace record` does of a running cell, in virtual time; with --strategy all the "
      "strategy's name goes before the extension");
  cli.add_option("--trace-period", a.trace_period, "seconds between rows of the trace")->check(CLI::Range(1e-4, 10.0));
  cli.add_option("--report", a.report, "write the report to this JSON file");
  cli.add_option("--seed", a.seed, "of the simulated controllers' latencies and speeds");
  cli.add_flag("--optimum", a.optimum,
               "work out the least possible time, waiting at stops and nothing else; exact for two and three robots, else a bound");
  cli.add_option("--promise", a.promise,
                 "with --optimum: a start may rely on a promised departure that follows within so many seconds; default: the cell file's");
  cli.add_flag("--json", a.json, "print the report as JSON instead of a summary");
  app::add_common(cli);
  return app::parse(cli, argc, argv);
}

std::string with_strategy(const std::string& file, const std::string& strategy) {
  const auto slash = file.find_last_of('/');
  const auto dot = file.find_last_of('.');
  const bool has_extension = dot != std::string::npos && (slash == std::string::npos || dot > slash);
  return has_extension ? file.substr(0, dot) + "." + strategy + file.substr(dot) : file + "." + strategy;
}

double elapsed_seconds() {
  static const auto begin = std::chrono::steady_clock::now();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// A line on a terminal's stderr at most every two seconds.
void show_progress(double t, std::size_t finished, std::size_t all) {
  static double last = 0;
  if (elapsed_seconds() < last + 2 || isatty(STDERR_FILENO) == 0) return;
  last = elapsed_seconds();
  fmt::print(stderr, "{} of {} commands at {:.1f} s of virtual time\n", finished, all, t);
}

std::string read_file(const std::string& path) {
  std::ifstream in{path, std::ios::binary};
  return {std::istreambuf_iterator<char>{in}, {}};
}

bool write_file(const std::string& path, const std::string& text) {
  std::ofstream out{path};
  out << text << '\n';
  out.close();
  if (!out) fmt::print(stderr, "{}: cannot be written\n", path);
  return static_cast<bool>(out);
}

ExitCode judge(const std::vector<app::RunReport>& reports) {
  bool collision = false;
  bool unserved = false;
  for (const auto& r : reports) {
    collision = collision || (r.collisions && *r.collisions > 0);
    unserved = unserved || r.completed + r.cancelled < r.submitted;  // those that the program itself cancels are not missed
  }
  return collision ? ExitCode::collision : unserved ? ExitCode::unserved : ExitCode::ok;
}

ExitCode run(const Arguments& a) {
  auto loaded = app::load_cell(a.cell);
  if (!loaded) {
    fmt::print(stderr, "{}\n", to_string(loaded.error()));
    return ExitCode::bad_input;
  }
  const auto cell = std::make_shared<const model::Cell>(loaded->cell);
  const auto program = app::load_program(a.program, cell.get());
  if (!program) {
    fmt::print(stderr, "{}\n", to_string(program.error()));
    return ExitCode::bad_input;
  }
  const std::string wanted = a.strategy.empty() ? cell->planning.strategy : a.strategy;
  std::vector<std::string> strategies;
  for (const auto name : core::strategy_names()) {
    if (wanted == "all" || wanted == name) strategies.emplace_back(name);
  }
  if (strategies.empty()) {
    fmt::print(stderr, "--strategy: found \"{}\", expected one of: all {}\n", wanted, fmt::join(core::strategy_names(), " "));
    return ExitCode::bad_input;
  }

  std::optional<sim::Optimum> optimum, confirmed, promised;
  if (a.optimum) {
    const double promise = a.promise.value_or(cell->planning.promise);
    for (auto* wanted_optimum : {&optimum, &confirmed, &promised}) {
      sim::OptimumOptions options;
      options.confirmed = wanted_optimum != &optimum;
      options.promise = wanted_optimum == &promised ? promise : 0;
      auto found = sim::least_makespan(*cell, *program, options);
      if (!found) {
        fmt::print(stderr, "{}\n", found.error());
        return ExitCode::bad_input;
      }
      *wanted_optimum = std::move(*found);
    }
    if (!a.json) {
      fmt::print("optimum: {}\n  where no start relies on one that is still to come: {}\n  or on one that is promised within {} s: {}\n",
                 summary(*optimum), summary(*confirmed), promise, summary(*promised));
      std::fflush(stdout);
    }
  }
  std::vector<app::RunReport> reports;
  for (const std::string& strategy : strategies) {
    sim::VirtualOptions options;
    options.strategy = strategy;
    options.seed = a.seed;
    options.trace_period = a.trace_period;
    options.stopwatch = elapsed_seconds;
    options.progress = show_progress;
    std::ofstream trace_file;
    std::optional<sim::TraceWriter> trace;
    if (!a.trace.empty()) {
      const std::string path = wanted == "all" ? with_strategy(a.trace, strategy) : a.trace;
      trace_file.open(path);
      if (!trace_file) {
        fmt::print(stderr, "{}: cannot be written\n", path);
        return ExitCode::bad_input;
      }
      options.trace = &trace.emplace(trace_file);
    }
    std::unique_ptr<sim::Recording> recording;
    if (!a.record.empty()) {
      auto started = sim::start_recording(wanted == "all" ? with_strategy(a.record, strategy) : a.record, *loaded, read_file(a.cell));
      if (!started) {
        fmt::print(stderr, "{}\n", started.error());
        return ExitCode::bad_input;
      }
      recording = std::move(*started);
      recording->listen(options);
    }
    reports.push_back(sim::run_virtual(cell, *program, options));
    if (!a.json) std::cout << summary(reports.back()) << std::flush;
    if (recording) {
      if (const auto failure = recording->close()) {
        fmt::print(stderr, "{}\n", *failure);
        return ExitCode::fault;
      }
    }
    trace_file.close();
    if (!a.trace.empty() && !trace_file) {
      fmt::print(stderr, "the trace could not be written completely\n");
      return ExitCode::fault;
    }
  }
  nlohmann::json json = nlohmann::json::array();
  for (const auto& r : reports) {
    json.push_back(to_json(r));
    if (!optimum) continue;
    const auto seconds = [](const sim::Optimum& o) { return o.makespan ? nlohmann::json(*o.makespan) : nlohmann::json(nullptr); };
    json.back()["optimum_s"] = seconds(*optimum);
    json.back()["confirmed_optimum_s"] = seconds(*confirmed);
    json.back()["promised_optimum_s"] = seconds(*promised);
    json.back()["optimum_exact"] = optimum->exact && confirmed->exact && promised->exact;
  }
  if (a.json) std::cout << json.dump(2) << '\n';
  if (!a.report.empty() && !write_file(a.report, json.dump(2))) return ExitCode::fault;
  return judge(reports);
}

}  // namespace

int main(int argc, char** argv) {
  return app::guarded_main("interlace-sim", [&] {
    Arguments arguments;
    const auto code = parse(argc, argv, arguments);
    return code ? *code : run(arguments);
  });
}
