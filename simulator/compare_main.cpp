#include <fmt/format.h>

#include <filesystem>

#include "common/app/command_line.hpp"
#include "common/app/config/cell_file.hpp"
#include "common/app/guarded_main.hpp"
#include "planner/core/strategy.hpp"
#include "simulator/compare.hpp"

using namespace interlace;
using app::ExitCode;

namespace {

struct Arguments {
  std::vector<std::string> cells;
  sim::CompareOptions options;
};

std::optional<ExitCode> parse(int argc, char** argv, Arguments& a) {
  CLI::App cli{
      "Runs the same random programs (interlace-generate) with two strategies in virtual time and compares how long they took.\n\n"
      "  interlace-compare --cells deploy/cells/pattern-* --programs 50"};
  const auto names = fmt::format("{}", fmt::join(core::strategy_names(), ", "));
  cli.add_option("--cells", a.cells, "folders with a cell.yaml, or cell files")->required();
  cli.add_option("--programs", a.options.programs, "for each cell")->check(CLI::Range(1, 1'000'000))->capture_default_str();
  cli.add_option("--per-robot", a.options.per_robot, "commands for each robot")->check(CLI::Range(1, 1000))->capture_default_str();
  cli.add_option("--seed", a.options.seed, "of the first program; the next has the next one")->capture_default_str();
  cli.add_option("--base", a.options.base, "strategy to compare with: " + names)->capture_default_str();
  cli.add_option("--strategy", a.options.other, "strategy: " + names)->capture_default_str();
  cli.add_option("--jobs", a.options.jobs, "programs at a time; the result does not depend on it")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  app::add_common(cli);
  return app::parse(cli, argc, argv);
}

ExitCode run(const Arguments& a) {
  for (const std::string& name : {a.options.base, a.options.other}) {
    if (core::is_strategy(name)) continue;
    fmt::print(stderr, "found \"{}\", expected one of: {}\n", name, fmt::join(core::strategy_names(), " "));
    return ExitCode::bad_input;
  }
  constexpr const char* kLine = "{:<20} {:>8} {:>10} {:>10} {:>7} {:>7} {:>6} {:>8} {:>8} {:>8} {:>10} {:>8}\n";
  fmt::print(fmt::runtime(kLine), "cell", "programs", a.options.base + " s", a.options.other + " s", "ratio", "worst", "seed", "escapes",
             "escapes", "unserved", "collisions", "real s");
  ExitCode code = ExitCode::ok;
  for (const std::string& given : a.cells) {
    const std::string path = std::filesystem::is_directory(given) ? (std::filesystem::path{given} / "cell.yaml").string() : given;
    auto loaded = app::load_cell(path);
    if (!loaded) {
      fmt::print(stderr, "{}\n", to_string(loaded.error()));
      return ExitCode::bad_input;
    }
    const auto row = sim::compare(std::make_shared<const model::Cell>(std::move(loaded->cell)), a.options);
    fmt::print(fmt::runtime(kLine), row.cell, row.programs, fmt::format("{:.2f}", row.base_makespan),
               fmt::format("{:.2f}", row.other_makespan), fmt::format("{:.3f}", row.ratio), fmt::format("{:.3f}", row.worst),
               row.worst_seed, row.base_escapes, row.other_escapes, row.unserved, row.collisions, fmt::format("{:.1f}", row.real_time));
    std::fflush(stdout);
    if (row.unserved > 0) code = ExitCode::unserved;
    if (row.collisions > 0) return ExitCode::collision;
  }
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  return app::guarded_main("interlace-compare", [&] {
    Arguments arguments;
    const auto code = parse(argc, argv, arguments);
    return code ? *code : run(arguments);
  });
}
