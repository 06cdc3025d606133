// How long it takes from an event to the decision about a start, in the core alone: rings where everybody is everybody's neighbour, and
// rows where that must not depend on how many there are. With `lookahead`, which looks at all that waits, in the ring of four.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "bench/benchmarks.hpp"
#include "bench/cells.hpp"
#include "bench/cpu_time.hpp"
#include "simulator/generator.hpp"
#include "simulator/virtual_cell.hpp"

namespace interlace::bench {

namespace {

constexpr std::size_t kWaiting = 10;  // commands of each robot, all submitted at once
constexpr const char* kUsual = "event";

/// Only what decides about a start counts: not the reports in between that change nothing.
bool decides(const core::Decisions& d) {
  return !d.dispatches.empty() ||
         std::any_of(d.statuses.begin(), d.statuses.end(), [](const auto& s) { return s.state == model::CommandState::scheduled; });
}

double quantile(std::vector<double>& values, double share) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

void decisions(benchmark::State& state, const std::shared_ptr<const model::Cell>& cell, int programs, const std::string& strategy) {
  std::vector<double> times;
  core::MapStatistics maps;
  std::size_t unserved = 0;
  for (auto _ : state) {
    for (int seed = 1; seed <= programs; ++seed) {
      sim::GeneratorOptions generate;
      generate.seed = static_cast<std::uint64_t>(seed);
      generate.per_robot = kWaiting;
      const auto program = sim::generate_program(*cell, generate);
      if (!program) throw std::runtime_error{program.error()};
      sim::VirtualOptions options;
      options.prepare = true;
      options.strategy = strategy;
      options.observe = false;
      options.check_period = 1;
      options.stopwatch = cpu_seconds;
      options.on_decision = [&](double took, const core::Decisions& d) {
        if (decides(d)) times.push_back(took);
      };
      options.on_maps = [&](const core::MapStatistics& m) {
        maps.built += m.built;
        maps.reused += m.reused;
        maps.evicted += m.evicted;
        maps.kept = std::max(maps.kept, m.kept);
        maps.bytes = std::max(maps.bytes, m.bytes);
      };
      const auto report = sim::run_virtual(cell, *program, options);
      unserved += report.submitted - report.completed - report.rejected;
    }
  }
  state.counters["decisions"] = static_cast<double>(times.size());
  state.counters["p50_ms"] = 1e3 * quantile(times, 0.5);
  state.counters["p95_ms"] = 1e3 * quantile(times, 0.95);
  state.counters["p99_ms"] = 1e3 * quantile(times, 0.99);
  state.counters["max_ms"] = 1e3 * quantile(times, 1);
  state.counters["maps_built"] = static_cast<double>(maps.built);
  state.counters["maps_reused"] = static_cast<double>(maps.reused);
  state.counters["maps_evicted"] = static_cast<double>(maps.evicted);
  state.counters["maps_kept"] = static_cast<double>(maps.kept);
  state.counters["maps_bytes"] = static_cast<double>(maps.bytes);
  state.counters["unserved"] = static_cast<double>(unserved);
}

/// About as many decisions for each cell.
void add(const std::shared_ptr<const model::Cell>& cell, std::size_t robots, const std::string& strategy = kUsual) {
  const int programs = static_cast<int>(std::max<std::size_t>(1, 24 / robots));
  const std::string name = "decision/" + cell->name + (strategy == kUsual ? "" : " " + strategy);
  benchmark::RegisterBenchmark(name.c_str(), [=](benchmark::State& s) { decisions(s, cell, programs, strategy); })
      ->Unit(benchmark::kMillisecond)
      ->Iterations(1);
}

}  // namespace

void register_decision_benchmarks() {
  for (const std::size_t n : {2, 3, 4, 6, 8, 12}) add(ring(n), n);
  for (const std::size_t n : {10, 20, 50, 100}) add(row(n), n);
  add(ring(4), 4, "lookahead");
}

}  // namespace interlace::bench
