#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "common/model/cell.hpp"
#include "common/model/program.hpp"
#include "common/model/result.hpp"

namespace interlace::sim {

/// How far a measurement has come.
struct FlowProgress {
  std::size_t runs = 0, runs_in_all = 0;
};

struct FlowOptions {
  std::shared_ptr<const model::Cell> cell;
  std::vector<std::string> strategies{"zone", "acm", "event"};
  std::vector<double> loads{0.5, 0.8, 0.95};  ///< rates of arrival, as shares of the throughput of `reference`
  std::string reference = "event";
  std::size_t programs = 4;                           ///< random ones, with seeds from `seed` on
  std::size_t per_robot = 50;                         ///< commands of each robot in a program
  std::uint64_t seed = 1;                             ///< of targets, times of arrival and controllers
  std::optional<double> resolution;                   ///< of the collision maps [s], instead of the cell's own
  std::size_t jobs = 1;                               ///< threads; the result does not depend on it
  std::function<void(const FlowProgress&)> progress;  ///< after each run, from any thread, one at a time; may be empty
  std::function<bool()> stop;                         ///< asked before each run: true ends the measurement; may be empty
};

/// One strategy at one load. Times of flow are from submission to completion, of all completed commands of all programs.
struct FlowRow {
  std::string strategy;
  double load = 0;
  double rate = 0;  ///< commands that arrive in all, a second
  std::size_t submitted = 0, completed = 0, collisions = 0;
  double mean = 0, p95 = 0, longest = 0;  ///< [s]
};

struct FlowReport {
  std::string reference;
  double throughput = 0;      ///< of `reference` with all commands there from the start: completed commands a second
  std::vector<FlowRow> rows;  ///< loads in their order, in each the strategies in theirs
  bool stopped = false;       ///< then there are no rows
};

/// `program` with the commands of each robot arriving at random: times between them are exponential, so that arrivals of all robots
/// together are a Poisson process of `rate` [1/s]. The same seed gives the same times on every machine. Pure.
[[nodiscard]] model::Program with_arrivals(model::Program program, double rate, std::uint64_t seed);

/// Measures in virtual time how long commands take from submission to completion when they arrive over time instead of all at once. Every
/// strategy gets the same programs with the same arrivals. The error says which program cannot be made.
[[nodiscard]] model::Result<FlowReport, std::string> measure_flow(const FlowOptions& options);

[[nodiscard]] nlohmann::json to_json(const FlowReport& report);

/// A Markdown table for people: a row for each strategy, two columns for each load.
[[nodiscard]] std::string table(const FlowReport& report);

}  // namespace interlace::sim
