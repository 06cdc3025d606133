#pragma once

#include <string>
#include <vector>

#include "simulator/reproduce/campaign.hpp"
#include "simulator/reproduce/experiments.hpp"

namespace interlace::reproduce {

/// One of the fifteen experiments of the dissertation's table 6.3.
struct PatternExperiment {
  std::string folder;  ///< pattern-triangle-3
  int robots = 0;
  std::string pattern;                    ///< triangle
  int number = 1;                         ///< of its program: program-1.yaml …
  double low = 0, high = 0, average = 0;  ///< the dissertation's map building times [ms]
};
[[nodiscard]] const std::vector<PatternExperiment>& pattern_experiments();

/// A pattern's program run with one strategy, times measured. The programs are ours: the dissertation does not print its own.
struct PatternRun {
  PatternExperiment experiment;
  app::RunReport report;
};

/// Table 6.3: time to build collision maps. Measured, so different each time and on each machine. Markdown.
[[nodiscard]] std::string map_time_table(const std::vector<PatternRun>& runs);

/// How the fifteen programs went, per strategy. Markdown.
[[nodiscard]] std::string pattern_outcome_table(const std::vector<PatternRun>& runs);

/// Table 6.4: local minima per pattern as warnings, of the campaigns when they have rows for that pattern, else of `runs`. Markdown.
[[nodiscard]] std::string local_minima_table(const std::vector<PatternRun>& runs, const std::vector<Campaign>& campaigns);

}  // namespace interlace::reproduce
