#include "simulator/flow.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>
#include <nlohmann/json.hpp>
#include <numeric>
#include <random>
#include <thread>

#include "simulator/generator.hpp"
#include "simulator/virtual_cell.hpp"

namespace interlace::sim {

namespace {

/// What one program came to.
struct Played {
  std::size_t submitted = 0, completed = 0, collisions = 0;
  double makespan = 0;        // [s]
  std::vector<double> flows;  // [s]
};

Played play(const std::shared_ptr<const model::Cell>& cell, const model::Program& program, const std::string& strategy,
            std::uint64_t seed) {
  VirtualOptions run;
  run.strategy = strategy;
  run.seed = seed;
  const app::RunReport report = run_virtual(cell, program, run);
  Played played;
  played.submitted = report.submitted;
  played.completed = report.completed;
  played.collisions = report.collisions.value_or(0);
  played.makespan = report.makespan;
  for (const app::CommandRow& row : report.commands) {
    if (!row.escape && row.state == model::CommandState::completed) played.flows.push_back(*row.end - row.release);
  }
  return played;
}

/// Calls `work(i)` for i = 0 … n−1 in `jobs` threads until `stop`. False when it was stopped.
bool for_each_run(std::size_t n, const FlowOptions& options, const std::function<void(std::size_t)>& work, FlowProgress& progress) {
  std::atomic<std::size_t> next{0};
  std::atomic<bool> stopped{false};
  std::mutex one_at_a_time;
  const auto serve = [&] {
    for (std::size_t i = next++; i < n; i = next++) {
      if (options.stop && options.stop()) stopped = true;
      if (stopped) return;
      work(i);
      const std::lock_guard lock{one_at_a_time};
      ++progress.runs;
      if (options.progress) options.progress(progress);
    }
  };
  std::vector<std::thread> threads;
  for (std::size_t j = 1; j < std::max<std::size_t>(1, options.jobs); ++j) threads.emplace_back(serve);
  serve();
  for (std::thread& t : threads) t.join();
  return !stopped;
}

/// The value that 95 of 100 do not exceed.
double percentile_95(const std::vector<double>& sorted) {
  if (sorted.empty()) return 0;
  const auto rank = static_cast<std::size_t>(std::ceil(0.95 * static_cast<double>(sorted.size())));
  return sorted[std::min(sorted.size(), std::max<std::size_t>(1, rank)) - 1];
}

FlowRow row_of(const std::string& strategy, double load, double rate, const std::vector<Played>& runs) {
  FlowRow row;
  row.strategy = strategy;
  row.load = load;
  row.rate = rate;
  std::vector<double> flows;
  for (const Played& played : runs) {
    row.submitted += played.submitted;
    row.completed += played.completed;
    row.collisions += played.collisions;
    flows.insert(flows.end(), played.flows.begin(), played.flows.end());
  }
  std::sort(flows.begin(), flows.end());
  if (flows.empty()) return row;
  row.mean = std::accumulate(flows.begin(), flows.end(), 0.0) / static_cast<double>(flows.size());
  row.p95 = percentile_95(flows);
  row.longest = flows.back();
  return row;
}

}  // namespace

model::Program with_arrivals(model::Program program, double rate, std::uint64_t seed) {
  const double per_robot = rate / static_cast<double>(program.robots.size());
  for (std::size_t i = 0; i < program.robots.size(); ++i) {
    std::seed_seq words{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32), static_cast<std::uint32_t>(i)};
    std::mt19937_64 random{words};
    double at = 0;
    for (model::ProgramStep& step : program.robots[i].second) {
      const double u = static_cast<double>(random() >> 11) * 0x1p-53;  // [0, 1), the same with every library
      at += -std::log1p(-u) / per_robot;
      step.at = at;
    }
  }
  return program;
}

model::Result<FlowReport, std::string> measure_flow(const FlowOptions& options) {
  auto cell = std::make_shared<model::Cell>(*options.cell);
  if (options.resolution) cell->planning.resolution = *options.resolution;
  std::vector<model::Program> programs;
  for (std::size_t p = 0; p < options.programs; ++p) {
    GeneratorOptions generator;
    generator.seed = options.seed + p;
    generator.per_robot = options.per_robot;
    auto program = generate_program(*cell, generator);
    if (!program) return model::unexpected(fmt::format("seed {}: {}", generator.seed, program.error()));
    programs.push_back(std::move(*program));
  }
  FlowReport report;
  report.reference = options.reference;
  FlowProgress progress{0, programs.size() * (1 + options.loads.size() * options.strategies.size())};
  std::vector<Played> full(programs.size());
  const auto play_full = [&](std::size_t p) { full[p] = play(cell, programs[p], options.reference, options.seed + p); };
  report.stopped = !for_each_run(programs.size(), options, play_full, progress);
  double completed = 0, time = 0;
  for (const Played& played : full) {
    completed += static_cast<double>(played.completed);
    time += played.makespan;
  }
  report.throughput = time > 0 ? completed / time : 0;
  if (report.stopped) return report;
  if (report.throughput <= 0) return model::unexpected(fmt::format("strategy {} completes nothing here", options.reference));

  const std::size_t cases = options.loads.size() * options.strategies.size();
  std::vector<std::vector<Played>> runs(cases, std::vector<Played>(programs.size()));
  const auto play_case = [&](std::size_t i) {
    const std::size_t c = i / programs.size(), p = i % programs.size();
    const double rate = options.loads[c / options.strategies.size()] * report.throughput;
    const auto program = with_arrivals(programs[p], rate, options.seed + p);
    runs[c][p] = play(cell, program, options.strategies[c % options.strategies.size()], options.seed + p);
  };
  report.stopped = !for_each_run(cases * programs.size(), options, play_case, progress);
  if (report.stopped) return report;
  for (std::size_t c = 0; c < cases; ++c) {
    const double load = options.loads[c / options.strategies.size()];
    report.rows.push_back(row_of(options.strategies[c % options.strategies.size()], load, load * report.throughput, runs[c]));
  }
  return report;
}

nlohmann::json to_json(const FlowReport& report) {
  nlohmann::json rows = nlohmann::json::array();
  for (const FlowRow& r : report.rows) {
    rows.push_back({{"strategy", r.strategy},
                    {"load", r.load},
                    {"rate_per_s", r.rate},
                    {"submitted", r.submitted},
                    {"completed", r.completed},
                    {"collisions", r.collisions},
                    {"mean_flow_s", r.mean},
                    {"p95_flow_s", r.p95},
                    {"longest_flow_s", r.longest}});
  }
  return {{"reference", report.reference}, {"throughput_per_s", report.throughput}, {"stopped", report.stopped}, {"rows", std::move(rows)}};
}

std::string table(const FlowReport& report) {
  std::vector<double> loads;
  std::vector<std::string> strategies;
  for (const FlowRow& r : report.rows) {
    if (std::find(loads.begin(), loads.end(), r.load) == loads.end()) loads.push_back(r.load);
    if (std::find(strategies.begin(), strategies.end(), r.strategy) == strategies.end()) strategies.push_back(r.strategy);
  }
  std::string text =
      fmt::format("Throughput of {} with full queues: {:.4f} commands a second.\n\n| strategy |", report.reference, report.throughput);
  for (const double load : loads) text += fmt::format(" mean flow at {:g} % [s] | 95th percentile [s] | completed |", 100 * load);
  text += "\n|---|";
  for (std::size_t i = 0; i < loads.size(); ++i) text += "---|---|---|";
  text += '\n';
  for (const std::string& strategy : strategies) {
    text += fmt::format("| {} |", strategy);
    for (const double load : loads) {
      const auto r =
          std::find_if(report.rows.begin(), report.rows.end(), [&](const FlowRow& x) { return x.strategy == strategy && x.load == load; });
      text += fmt::format(" {:.2f} | {:.2f} | {} of {}{} |", r->mean, r->p95, r->completed, r->submitted,
                          r->collisions > 0 ? fmt::format(", {} COLLISIONS", r->collisions) : "");
    }
    text += '\n';
  }
  return text;
}

}  // namespace interlace::sim
