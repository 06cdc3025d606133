#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "common/model/cell.hpp"
#include "common/model/program.hpp"
#include "common/model/result.hpp"

namespace interlace::sim {

struct OptimumOptions {
  bool confirmed = false;     ///< starts only where the planner sends them: clear of everybody also if nobody else starts any more
  double promise = 0;         ///< with `confirmed`: a start may rely on a departure that follows within so long [s] and relies not on it
  double pair_step = 0.01;    ///< of the lattice for two robots [s]
  double triple_step = 0.02;  ///< of the lattice for three [s]
  std::size_t most_states = 20'000'000;  ///< of the search for three, before it is content with a bound
};

/// The least possible makespan with every robot's commands in their order, on their paths and with their time laws.
struct Optimum {
  std::optional<double> makespan;        ///< [s]; empty: waiting alone never gets everything done, somebody has to go out of the way
  bool exact = true;                     ///< within `step`; else a lower bound
  double step = 0;                       ///< of the lattice [s]
  std::vector<model::RobotName> robots;  ///< whose commands take that long
};

/// Optimum of `program` on `cell` with nothing but waiting at stops, on the planner's certified collision maps: exact for two and three
/// robots, for more the largest of all groups of three, which is a bound. Release times count for each robot alone: with any, it is a bound
/// too. The error says which command is inadmissible. Pure.
[[nodiscard]] model::Result<Optimum, std::string> least_makespan(const model::Cell& cell, const model::Program& program,
                                                                 const OptimumOptions& options);

/// For people.
[[nodiscard]] std::string summary(const Optimum& optimum);

}  // namespace interlace::sim
