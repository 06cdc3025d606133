#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "common/model/cell.hpp"

namespace interlace::sim {

struct CompareOptions {
  std::size_t programs = 50;   ///< for each cell
  std::size_t per_robot = 10;  ///< commands
  std::uint64_t seed = 1;      ///< of the first program; the next has the next one
  std::string base = "event";
  std::string other = "lookahead";
  std::size_t jobs = 1;  ///< threads
};

/// One cell's programs with both strategies.
struct CompareRow {
  std::string cell;
  std::size_t programs = 0;
  double base_makespan = 0, other_makespan = 0;  ///< mean [s]
  double ratio = 0;                              ///< mean of the programs' ratios, other to base
  double worst = 0;                              ///< largest of them
  std::uint64_t worst_seed = 0;
  std::size_t base_escapes = 0, other_escapes = 0;
  std::size_t unserved = 0, collisions = 0;      ///< of both
  double base_decision = 0, other_decision = 0;  ///< 99th percentile, largest of the programs' [ms]
  double real_time = 0;                          ///< of `other` [s]
};

/// Runs generated programs (simulator/generator.hpp) on `cell` in virtual time with two strategies.
[[nodiscard]] CompareRow compare(const std::shared_ptr<const model::Cell>& cell, const CompareOptions& options);

}  // namespace interlace::sim
