#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "common/app/command_line.hpp"
#include "common/app/guarded_main.hpp"
#include "planner/core/strategy.hpp"
#include "simulator/reproduce/results_page.hpp"

using namespace interlace;
using app::ExitCode;
namespace files = std::filesystem;

namespace {

constexpr const char* kPatterns = "patterns";

struct Arguments {
  std::string cells = "deploy/cells", output = "docs", only;
  std::vector<std::string> campaigns;
};

/// A file that is not as it should be.
struct BadInput : std::runtime_error {
  using std::runtime_error::runtime_error;
};

std::optional<ExitCode> parse(int argc, char** argv, Arguments& a) {
  CLI::App cli{
      "Runs the dissertation's experiments in virtual time with every strategy and writes what came out: OUTPUT/results.md, with tables\n"
      "beside the dissertation's own numbers, and pictures in OUTPUT/results: command charts, distance curves, collision maps.\n"
      "The same bytes on each run, but for the measured times of table 6.3. Start it through docs/reproduce, which builds it first.\n\n"
      "  interlace-reproduce                                everything, into docs\n"
      "  interlace-reproduce --only 4.2 --output /tmp/look  one experiment, elsewhere\n\n"
      "The exit code judges the strategy event alone: the others are there to be compared with."};
  cli.add_option("--cells", a.cells, "folder of the cells")->capture_default_str();
  cli.add_option("--output", a.output, "folder for results.md and results/")->capture_default_str();
  cli.add_option("--only", a.only, "one experiment (4.1 or exp-4-1 … 6.2), or patterns: the programs of table 6.3");
  cli.add_option("--campaign", a.campaigns,
                 "report of interlace-campaign (JSON) to show and to count local minima from; may be given again");
  app::add_common(cli);
  return app::parse(cli, argc, argv);
}

double elapsed_seconds() {
  static const auto begin = std::chrono::steady_clock::now();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

void write_file(const files::path& path, const std::string& text) {
  std::ofstream out{path, std::ios::binary};
  out << text;
  out.close();
  if (!out) throw BadInput{path.string() + ": cannot be written"};
}

/// The case in these files, or nothing with a note in `skipped` when they are not there.
std::optional<reproduce::Case> find_case(const files::path& cell, const files::path& program, const std::string& what,
                                         std::vector<std::string>& skipped) {
  for (const files::path& file : {cell, program}) {
    if (files::exists(file)) continue;
    const auto folder = file.parent_path().filename();
    const std::string message = fmt::format("{}: there is no `{}` in the folder of cells.", what, (folder / file.filename()).string());
    if (std::find(skipped.begin(), skipped.end(), message) != skipped.end()) return std::nullopt;  // said already
    skipped.push_back(message);
    fmt::print(stderr, "{}: skipped, there is no {}\n", what, file.string());
    return std::nullopt;
  }
  auto loaded = reproduce::load_case(cell.string(), program.string());
  if (!loaded) throw BadInput{loaded.error()};
  return std::move(*loaded);
}

std::string one_line(const app::RunReport& r) {
  const std::string all = summary(r);
  return all.substr(0, all.find('\n'));
}

void run_experiments(const Arguments& a, reproduce::Results& results) {
  for (const auto& experiment : reproduce::experiments()) {
    if (!a.only.empty() && a.only != experiment.folder && a.only != experiment.number) continue;
    const files::path folder = files::path{a.cells} / experiment.folder;
    const std::string what = "experiment " + experiment.number;
    auto input = find_case(folder / "cell.yaml", folder / "program.yaml", what, results.skipped);
    if (!input) continue;
    reproduce::ExperimentRun run{experiment, std::move(*input), {}};
    run.least = reproduce::least_times(run.input);
    if (run.least) fmt::print(stderr, "{}: {}\n", what, summary(run.least->waiting));
    for (const auto strategy : core::strategy_names()) {
      run.runs.push_back(reproduce::run_strategy(run.input, std::string{strategy}, true));
      fmt::print(stderr, "{}: {}\n", what, one_line(run.runs.back().report));
    }
    results.experiments.push_back(std::move(run));
  }
}

void run_patterns(const Arguments& a, reproduce::Results& results) {
  if (!a.only.empty() && a.only != kPatterns) return;
  for (const auto& experiment : reproduce::pattern_experiments()) {
    const files::path folder = files::path{a.cells} / experiment.folder;
    const std::string what = fmt::format("{}, program {}", experiment.folder, experiment.number);
    const auto input =
        find_case(folder / "cell.yaml", folder / fmt::format("program-{}.yaml", experiment.number), experiment.folder, results.skipped);
    if (!input) continue;
    for (const char* strategy : {"acm", "event"}) {
      const auto& known = core::strategy_names();
      if (std::find(known.begin(), known.end(), strategy) == known.end()) continue;
      results.patterns.push_back({experiment, reproduce::run_strategy(*input, strategy, false, elapsed_seconds).report});
      fmt::print(stderr, "{}: {}\n", what, one_line(results.patterns.back().report));
    }
  }
}

ExitCode judge(const reproduce::Results& results) {
  std::vector<const app::RunReport*> ours;
  for (const auto& run : results.experiments) {
    if (const auto* r = reproduce::find_run(run, "event")) ours.push_back(&r->report);
  }
  for (const auto& run : results.patterns) {
    if (run.report.strategy == "event") ours.push_back(&run.report);
  }
  bool unserved = false;
  for (const app::RunReport* r : ours) {
    if (r->collisions.value_or(0) > 0) return ExitCode::collision;
    unserved = unserved || r->completed < r->submitted;
  }
  return unserved ? ExitCode::unserved : ExitCode::ok;
}

ExitCode run(const Arguments& a) {
  const auto& known = reproduce::experiments();
  if (!a.only.empty() && a.only != kPatterns &&
      std::none_of(known.begin(), known.end(), [&](const auto& e) { return a.only == e.folder || a.only == e.number; }))
    throw BadInput{fmt::format("--only: found \"{}\", expected an experiment such as 4.2 or exp-4-2, or patterns", a.only)};
  if (!files::is_directory(a.cells)) throw BadInput{a.cells + ": there is no such folder; --cells names the one that holds exp-4-2"};

  reproduce::Results results;
  if (!a.only.empty()) results.skipped.push_back(fmt::format("Everything but {}: only that was asked for (`--only`).", a.only));
  for (const std::string& file : a.campaigns) {
    auto campaign = reproduce::load_campaign(file);
    if (!campaign) throw BadInput{campaign.error()};
    results.campaigns.push_back(std::move(*campaign));
  }
  run_experiments(a, results);
  run_patterns(a, results);
  if (results.experiments.empty() && results.patterns.empty()) throw BadInput{a.cells + ": nothing was run, so nothing was written"};

  const files::path folder = files::path{a.output} / "results";
  std::error_code failed;
  files::create_directories(folder, failed);
  if (failed) throw BadInput{folder.string() + ": " + failed.message()};
  std::vector<std::vector<reproduce::Picture>> pictures;
  std::size_t count = 0;
  for (const auto& experiment : results.experiments) {
    pictures.push_back(reproduce::pictures(experiment));
    for (const auto& picture : pictures.back()) write_file(folder / picture.file, picture.svg);
    count += pictures.back().size();
  }
  const files::path page = files::path{a.output} / "results.md";
  write_file(page, reproduce::results_page(results, pictures));
  fmt::print(stderr, "wrote {} and {} pictures in {}\n", page.string(), count, folder.string());
  return judge(results);
}

}  // namespace

int main(int argc, char** argv) {
  return app::guarded_main("interlace-reproduce", [&] {
    Arguments arguments;
    const auto code = parse(argc, argv, arguments);
    try {
      return code ? *code : run(arguments);
    } catch (const BadInput& e) {
      fmt::print(stderr, "{}\n", e.what());
      return ExitCode::bad_input;
    }
  });
}
