#include "simulator/compare.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <mutex>
#include <thread>

#include "simulator/generator.hpp"
#include "simulator/virtual_cell.hpp"

namespace interlace::sim {

namespace {

double elapsed_seconds() {
  static const auto begin = std::chrono::steady_clock::now();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace

CompareRow compare(const std::shared_ptr<const model::Cell>& cell, const CompareOptions& options) {
  CompareRow row;
  row.cell = cell->name;
  std::atomic<std::size_t> next{0};
  std::mutex mutex;
  const auto work = [&] {
    for (std::size_t k = next++; k < options.programs; k = next++) {
      GeneratorOptions what;
      what.seed = options.seed + k;
      what.per_robot = options.per_robot;
      const auto program = generate_program(*cell, what);
      if (!program) continue;
      VirtualOptions run;
      run.seed = what.seed;
      run.stopwatch = elapsed_seconds;
      run.strategy = options.base;
      const auto base = run_virtual(cell, *program, run);
      run.strategy = options.other;
      const double before = elapsed_seconds();
      const auto other = run_virtual(cell, *program, run);
      const double took = elapsed_seconds() - before;
      const double ratio = other.makespan / base.makespan;
      const std::lock_guard lock{mutex};
      ++row.programs;
      row.base_makespan += base.makespan;
      row.other_makespan += other.makespan;
      row.ratio += ratio;
      if (ratio > row.worst) {
        row.worst = ratio;
        row.worst_seed = what.seed;
      }
      row.base_escapes += base.escapes;
      row.other_escapes += other.escapes;
      row.unserved += base.submitted - base.completed + other.submitted - other.completed;
      row.collisions += base.collisions.value_or(0) + other.collisions.value_or(0);
      row.base_decision = std::max(row.base_decision, base.decision->p99);
      row.other_decision = std::max(row.other_decision, other.decision->p99);
      row.real_time += took;
    }
  };
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < options.jobs; ++i) threads.emplace_back(work);
  for (std::thread& t : threads) t.join();
  const double n = static_cast<double>(std::max<std::size_t>(row.programs, 1));
  row.base_makespan /= n;
  row.other_makespan /= n;
  row.ratio /= n;
  return row;
}

}  // namespace interlace::sim
