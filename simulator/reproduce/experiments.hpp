#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/app/report.hpp"
#include "common/model/program.hpp"
#include "common/model/result.hpp"
#include "simulator/optimum.hpp"
#include "simulator/reproduce/postures.hpp"

namespace interlace::reproduce {

/// An experiment of the dissertation: which folder of cells holds it, and where the dissertation shows its results.
struct Experiment {
  std::string folder;  ///< exp-4-2
  std::string number;  ///< 4.2
  std::string chart;   ///< figure of the command charts
  std::string curves;  ///< tables of the distance curves; empty when there are none
};

/// 4.1, 4.2, 5.1, 5.2, 6.1 and 6.2.
[[nodiscard]] const std::vector<Experiment>& experiments();

/// A cell with a program for it, as read from files.
struct Case {
  std::shared_ptr<const model::Cell> cell;
  model::Program program;
};

/// Reads both files; what is wrong with them, with file names, otherwise.
[[nodiscard]] model::Result<Case, std::string> load_case(const std::string& cell_file, const std::string& program_file);

/// What one strategy made of a case.
struct StrategyRun {
  app::RunReport report;
  std::vector<Frame> frames;  ///< every 10 ms
};

/// Least makespans of a case, waiting at stops and nothing else.
struct LeastTimes {
  sim::Optimum waiting;    ///< of all starts
  sim::Optimum confirmed;  ///< of those that rely on no departure that is still to come, as those of `event`
  sim::Optimum promised;   ///< of those that rely on promised ones within `promise`, as those of `lookahead`
  double promise = 0;      ///< [s]
};

struct ExperimentRun {
  Experiment experiment;
  Case input;
  std::vector<StrategyRun> runs;                   ///< in the order of core::strategy_names()
  std::optional<LeastTimes> least = std::nullopt;  ///< empty: not worked out
};

/// Runs `input` in virtual time. Deterministic; without `stopwatch` (elapsed seconds) the report holds no measured times.
[[nodiscard]] StrategyRun run_strategy(const Case& input, const std::string& strategy, bool with_frames,
                                       const std::function<double()>& stopwatch = nullptr);

/// Takes seconds for two robots and up to a minute for more. Empty when a command of the case is inadmissible.
[[nodiscard]] std::optional<LeastTimes> least_times(const Case& input);

/// The run of `strategy`; null when there is none.
[[nodiscard]] const StrategyRun* find_run(const ExperimentRun& run, const std::string& strategy);

/// A command of a program: which robot's, and its request.
struct NamedCommand {
  std::string label;  ///< the dissertation's: C12 is the second command of the first robot, in each repetition of its list
  model::RobotIndex robot = 0;
  model::MotionRequest request;
};
using NamedCommands = std::map<model::CommandId, NamedCommand>;

/// The commands of a program under the ids that run_virtual gives them.
[[nodiscard]] NamedCommands named_commands(const Case& input);

}  // namespace interlace::reproduce
