#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "bench/benchmarks.hpp"
#include "bench/figures.hpp"
#include "common/app/command_line.hpp"
#include "common/app/guarded_main.hpp"

using namespace interlace;
using app::ExitCode;

namespace {

struct Arguments {
  std::string cells = "deploy/cells", figures;
};

std::optional<ExitCode> parse(int argc, char** argv, Arguments& a) {
  CLI::App cli{
      "Measures the design's figures on this machine, each beside its peer in the same run, and prints them as a table.\n"
      "Takes the options of google-benchmark as well, such as --benchmark_filter=C12xC22 or --benchmark_out=FILE.json.\n"
      "Ends with 1 when a figure misses its limit."};
  cli.add_option("--cells", a.cells, "folder of the cells")->capture_default_str();
  cli.add_option("--figures", a.figures, "write the table to this JSON file");
  app::add_common(cli);
  return app::parse(cli, argc, argv);
}

ExitCode run(const Arguments& a) {
  bench::register_map_benchmarks(a.cells);
  bench::register_decision_benchmarks();
  bench::Measurements measured;
  benchmark::RunSpecifiedBenchmarks(&measured);
  const auto figures = bench::figures_of(measured);
  fmt::print("\n{}", bench::to_markdown(figures));
  if (!a.figures.empty()) {
    std::ofstream out{a.figures};
    out << bench::to_json(figures) << '\n';
    out.close();
    if (!out) {
      fmt::print(stderr, "{}: cannot be written\n", a.figures);
      return ExitCode::fault;
    }
  }
  const bool missed = std::any_of(figures.begin(), figures.end(), [](const auto& f) { return f.met && !*f.met; });
  return missed ? ExitCode::unserved : ExitCode::ok;
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  return app::guarded_main("interlace-bench", [&] {
    Arguments arguments;
    const auto code = parse(argc, argv, arguments);
    return code ? *code : run(arguments);
  });
}
