#include "simulator/campaign.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <stdexcept>
#include <thread>

#include "planner/core/strategy.hpp"
#include "simulator/generator.hpp"
#include "simulator/virtual_cell.hpp"

namespace interlace::sim {

namespace {

struct RunResult {
  CampaignRun run;
  std::vector<double> map_builds;  // [s]
};

class Campaign {
 public:
  explicit Campaign(const CampaignOptions& options) : options_(options) {
    if (options.cells.empty()) throw std::invalid_argument("a campaign needs a cell");
    if (!core::is_strategy(options.strategy)) throw std::invalid_argument(fmt::format("unknown strategy \"{}\"", options.strategy));
    for (const CampaignCell& c : options.cells) {
      auto cell = std::make_shared<model::Cell>(*c.cell);
      if (options.resolution) cell->planning.resolution = *options.resolution;
      cells_.push_back(std::move(cell));
    }
    std::size_t commands = 0;
    while (commands < options.commands) {
      const std::size_t cell = results_.size() % options.cells.size();
      RunResult& r = results_.emplace_back();
      r.run.cell = cell;
      r.run.seed = options.seed + (results_.size() - 1);
      commands += options.per_robot * options.cells[cell].cell->robots.size();
    }
    progress_.programs_in_all = results_.size();
    progress_.commands_in_all = commands;
  }

  CampaignReport run() {
    const double before = now();
    std::vector<std::thread> threads;
    working_ = std::clamp<std::size_t>(options_.jobs, 1, std::max<std::size_t>(results_.size(), 1));
    const std::size_t count = working_;
    for (std::size_t i = 0; i < count; ++i) threads.emplace_back([this] { work(); });
    {
      std::unique_lock lock{mutex_};
      while (!changed_.wait_for(lock, std::chrono::seconds{2}, [this] { return working_ == 0; })) tell(lock);
    }
    for (std::thread& t : threads) t.join();
    if (fault_) std::rethrow_exception(fault_);
    CampaignReport report = collect();
    report.real_time = now() - before;
    return report;
  }

 private:
  [[nodiscard]] double now() const { return options_.stopwatch ? options_.stopwatch() : 0; }

  void tell(std::unique_lock<std::mutex>& lock) {
    if (!options_.progress) return;
    const CampaignProgress progress = progress_;
    lock.unlock();
    options_.progress(progress);
    lock.lock();
  }

  void work() {
    try {
      for (;;) {
        const std::size_t k = next_++;
        if (k >= results_.size() || stop_) break;
        if (options_.stop && options_.stop()) {
          stop_ = true;
          break;
        }
        run_one(results_[k]);
        const std::lock_guard lock{mutex_};
        const CampaignRun& run = results_[k].run;
        ++progress_.programs;
        progress_.commands += run.verdict.submitted;
        progress_.failing += run.good() ? 0 : 1;
        progress_.collisions += run.collisions;
      }
    } catch (...) {
      const std::lock_guard lock{mutex_};
      fault_ = std::current_exception();
      stop_ = true;
    }
    const std::lock_guard lock{mutex_};
    --working_;
    changed_.notify_all();
  }

  void run_one(RunResult& result) const {
    const double before = now();
    CampaignRun& run = result.run;
    const auto& cell = cells_[run.cell];
    GeneratorOptions what;
    what.seed = run.seed;
    what.per_robot = options_.per_robot;
    const auto program = generate_program(*cell, what);
    run.done = true;
    if (!program) {
      run.verdict.complaints.push_back("no program: " + program.error());
      return;
    }
    TraceCheck check{*cell};
    StatusJudge judge;
    VirtualOptions options;
    options.strategy = options_.strategy;
    options.seed = run.seed;
    options.stopwatch = options_.stopwatch;
    options.observe = false;  // judged here, by other code
    options.on_status = [&](const model::CommandStatus& status) { judge.on_status(status); };
    options.on_postures = [&](double t, const std::vector<model::Joints>& joints) {
      check.step(t, joints);
      run.virtual_time = t;
    };
    options.on_tools = [&](model::RobotIndex robot, model::ToolSet tools) { check.hold(robot, tools); };
    options.on_map_builds = [&](const std::vector<double>& seconds) { result.map_builds = seconds; };
    const app::RunReport report = run_virtual(cell, *program, options);
    run.verdict = judge.verdict(report.commands);
    run.collisions = check.collisions();
    run.nearest = check.least();
    run.real_time = now() - before;
  }

  [[nodiscard]] CampaignReport collect() const {
    CampaignReport report;
    report.strategy = options_.strategy;
    report.per_robot = options_.per_robot;
    report.resolution = options_.resolution;
    report.stopped = stop_;
    std::vector<std::vector<double>> builds(options_.cells.size());
    for (const CampaignCell& c : options_.cells) {
      report.paths.push_back(c.path);
      CampaignRow& row = report.rows.emplace_back();
      row.cell = c.cell->name;
      row.robots = c.cell->robots.size();
    }
    for (const RunResult& r : results_) {
      const CampaignRun& run = r.run;
      if (!run.done) continue;
      CampaignRow& row = report.rows[run.cell];
      ++row.programs;
      row.total.submitted += run.verdict.submitted;
      row.total.completed += run.verdict.completed;
      row.total.rejected += run.verdict.rejected;
      row.total.unserved += run.verdict.unserved;
      row.total.lost += run.verdict.lost;
      row.total.contradicted += run.verdict.contradicted;
      row.total.escapes += run.verdict.escapes;
      row.total.fruitless_rounds += run.verdict.fruitless_rounds;
      row.total.warnings += run.verdict.warnings;
      row.collisions += run.collisions;
      if (run.nearest.clearance < row.nearest.clearance) row.nearest = run.nearest;
      row.virtual_time += run.virtual_time;
      row.real_time += run.real_time;
      builds[run.cell].insert(builds[run.cell].end(), r.map_builds.begin(), r.map_builds.end());
      if (run.good()) continue;
      ++row.failing;
      report.failing.push_back(run);
    }
    for (std::size_t i = 0; i < builds.size(); ++i) report.rows[i].map_build = app::statistics_of(std::move(builds[i]));
    return report;
  }

  const CampaignOptions& options_;
  std::vector<std::shared_ptr<const model::Cell>> cells_;
  std::vector<RunResult> results_;  // each written by one thread, read when all are done
  std::atomic<std::size_t> next_{0};
  std::atomic<bool> stop_{false};
  std::mutex mutex_;  // guards all below
  std::condition_variable changed_;
  std::size_t working_ = 0;
  CampaignProgress progress_;
  std::exception_ptr fault_;
};

}  // namespace

CampaignReport run_campaign(const CampaignOptions& options) {
  return Campaign{options}.run();
}

}  // namespace interlace::sim
