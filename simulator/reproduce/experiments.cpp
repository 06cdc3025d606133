#include "simulator/reproduce/experiments.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "common/app/config/cell_file.hpp"
#include "common/app/config/program_file.hpp"
#include "simulator/virtual_cell.hpp"

namespace interlace::reproduce {

namespace {

bool same(const model::MotionRequest& a, const model::MotionRequest& b) {
  if (a.target.index() != b.target.index() || a.velocity != b.velocity || a.acceleration != b.acceleration) return false;
  if (const auto* line = std::get_if<model::LinearTarget>(&a.target))
    return line->X_WT.matrix() == std::get<model::LinearTarget>(b.target).X_WT.matrix();
  return std::get<model::JointTarget>(a.target).q == std::get<model::JointTarget>(b.target).q;
}

/// Length of the shortest list that, repeated, gives `steps`.
std::size_t period(const std::vector<model::ProgramStep>& steps) {
  for (std::size_t p = 1; p < steps.size(); ++p) {
    if (steps.size() % p != 0) continue;
    bool repeats = true;
    for (std::size_t i = p; i < steps.size() && repeats; ++i) repeats = same(steps[i].motion, steps[i - p].motion);
    if (repeats) return p;
  }
  return std::max<std::size_t>(steps.size(), 1);
}

}  // namespace

const std::vector<Experiment>& experiments() {
  static const std::vector<Experiment> all{
      {"exp-4-1", "4.1", "figure 4.6", "tables 4.2 and 4.3"},
      {"exp-4-2", "4.2", "figure 4.9", "tables 4.5 and 4.6"},
      {"exp-5-1", "5.1", "figure 5.7", "tables 5.2 and 5.3"},
      {"exp-5-2", "5.2", "figure 5.10", "tables 5.5 and 5.6"},
      {"exp-6-1", "6.1", "figure 6.14", ""},
      {"exp-6-2", "6.2", "figure 6.18", ""},
  };
  return all;
}

model::Result<Case, std::string> load_case(const std::string& cell_file, const std::string& program_file) {
  auto loaded = app::load_cell(cell_file);
  if (!loaded) return model::unexpected<std::string>{to_string(loaded.error())};
  Case input;
  input.cell = std::make_shared<const model::Cell>(std::move(loaded->cell));
  auto program = app::load_program(program_file, input.cell.get());
  if (!program) return model::unexpected<std::string>{to_string(program.error())};
  input.program = std::move(*program);
  return input;
}

StrategyRun run_strategy(const Case& input, const std::string& strategy, bool with_frames, const std::function<double()>& stopwatch) {
  std::ostringstream csv;
  sim::TraceWriter trace{csv};
  sim::VirtualOptions options;
  options.strategy = strategy;
  options.trace = with_frames ? &trace : nullptr;
  options.stopwatch = stopwatch;
  StrategyRun run;
  run.report = sim::run_virtual(input.cell, input.program, options);
  if (with_frames) run.frames = parse_trace(csv.str(), *input.cell);
  return run;
}

std::optional<LeastTimes> least_times(const Case& input) {
  LeastTimes least;
  least.promise = input.cell->planning.promise;
  for (sim::Optimum* wanted : {&least.waiting, &least.confirmed, &least.promised}) {
    sim::OptimumOptions options;
    options.confirmed = wanted != &least.waiting;
    options.promise = wanted == &least.promised ? least.promise : 0;
    auto found = sim::least_makespan(*input.cell, input.program, options);
    if (!found) return std::nullopt;
    *wanted = std::move(*found);
  }
  return least;
}

const StrategyRun* find_run(const ExperimentRun& run, const std::string& strategy) {
  const auto found = std::find_if(run.runs.begin(), run.runs.end(), [&](const StrategyRun& r) { return r.report.strategy == strategy; });
  return found == run.runs.end() ? nullptr : &*found;
}

NamedCommands named_commands(const Case& input) {
  NamedCommands named;
  for (const auto& [robot, steps] : input.program.robots) {
    const std::size_t in_turn = period(steps);
    const auto index = input.cell->find(robot);
    for (std::size_t i = 0; index && i < steps.size(); ++i) {
      const std::string number = fmt::format("{}", i % in_turn + 1);
      named[model::CommandId{fmt::format("{}-{}", robot.str(), i + 1)}] = {
          fmt::format("C{}{}{}", *index + 1, in_turn > 9 ? "." : "", number), *index, steps[i].motion};
    }
  }
  return named;
}

}  // namespace interlace::reproduce
