#pragma once

#include <string>
#include <vector>

#include "simulator/reproduce/campaign.hpp"
#include "simulator/reproduce/experiments.hpp"
#include "simulator/reproduce/patterns.hpp"

namespace interlace::reproduce {

/// Everything the results page tells of.
struct Results {
  std::vector<ExperimentRun> experiments;
  std::vector<PatternRun> patterns;
  std::vector<std::string> skipped;  ///< what was not run, and why; one sentence each
  std::vector<Campaign> campaigns;
};

/// A picture and the name of its file.
struct Picture {
  std::string file;  ///< exp-4-2-chart-event.svg
  std::string svg;
};

/// The pictures of an experiment: a command chart per strategy, the distance curves, and the collision map of a delayed command if one was.
[[nodiscard]] std::vector<Picture> pictures(const ExperimentRun& run);

/// The page in Markdown. `pictures_of` says, per experiment, which pictures stand in the folder `results` beside it.
[[nodiscard]] std::string results_page(const Results& results, const std::vector<std::vector<Picture>>& pictures_of);

}  // namespace interlace::reproduce
