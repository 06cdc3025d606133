#pragma once

#include <string>
#include <vector>

#include "simulator/reproduce/experiments.hpp"

namespace interlace::reproduce {

/// How every strategy finished an experiment: time, and that by the least possible one when it is given, commands, escapes, warnings,
/// collisions, least clearance. Markdown.
[[nodiscard]] std::string outcome_table(const std::vector<StrategyRun>& runs, const std::optional<LeastTimes>& least = std::nullopt);

/// The least possible times in words. Markdown list.
[[nodiscard]] std::string optimum_notes(const LeastTimes& least);

/// What is to be said about an outcome table: collisions and commands that were never served, from the numbers. Markdown list; empty when
/// there is nothing.
[[nodiscard]] std::string outcome_notes(const std::vector<StrategyRun>& runs);

/// Tables 4.7 and 5.7 of the dissertation in one: time to finish experiment 2, their methods beside ours, with what differs and why. `runs`
/// may hold other experiments too. Markdown.
[[nodiscard]] std::string finish_time_table(const std::vector<ExperimentRun>& runs);

}  // namespace interlace::reproduce
