#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "common/app/report.hpp"
#include "common/model/cell.hpp"
#include "simulator/status_judge.hpp"
#include "simulator/trace_check.hpp"

namespace interlace::sim {

struct CampaignCell {
  std::string path;  ///< as given by the user, for command lines that run one program again
  std::shared_ptr<const model::Cell> cell;
};

/// How far a campaign has come.
struct CampaignProgress {
  std::size_t programs = 0, programs_in_all = 0;
  std::size_t commands = 0, commands_in_all = 0;  ///< commands of the programs run
  std::size_t failing = 0;                        ///< programs
  std::size_t collisions = 0;
};

struct CampaignOptions {
  std::vector<CampaignCell> cells;  ///< taken in turn, at least one
  std::string strategy = "event";
  std::size_t commands = 100'000;                         ///< programs are run until they have this many in all
  std::size_t per_robot = 10;                             ///< commands of each robot in a program
  std::optional<double> resolution;                       ///< of the collision maps [s], instead of the cells' own
  std::uint64_t seed = 1;                                 ///< of the first program and its controllers; the next has the next one
  std::size_t jobs = 1;                                   ///< threads
  std::function<double()> stopwatch;                      ///< elapsed [s], for statistics only; any thread; may be empty
  std::function<void(const CampaignProgress&)> progress;  ///< about every two seconds, from the calling thread; may be empty
  std::function<bool()> stop;  ///< asked now and then: true ends the campaign after the programs that are running; may be empty
};

/// One program of a campaign.
struct CampaignRun {
  std::size_t cell = 0;  ///< index
  std::uint64_t seed = 0;
  bool done = false;  ///< false: the campaign was stopped before it
  Verdict verdict;
  std::size_t collisions = 0;
  Nearest nearest;
  double virtual_time = 0, real_time = 0;  ///< [s]

  [[nodiscard]] bool good() const { return done && collisions == 0 && verdict.good(); }
};

/// All programs of one cell.
struct CampaignRow {
  std::string cell;
  std::size_t robots = 0, programs = 0, failing = 0;
  Verdict total;  ///< without complaints
  std::size_t collisions = 0;
  Nearest nearest;
  app::DurationStatistics map_build;
  double virtual_time = 0, real_time = 0;  ///< [s]
};

struct CampaignReport {
  std::string strategy;
  std::size_t per_robot = 0;
  std::optional<double> resolution;  ///< [s]
  std::vector<CampaignRow> rows;     ///< in the order of the cells
  std::vector<CampaignRun> failing;  ///< in the order of their seeds
  std::vector<std::string> paths;    ///< of the cells
  double real_time = 0;              ///< [s]
  bool stopped = false;
};

/// Runs generated programs (simulator/generator.hpp) in virtual time and judges each: from the joints every millisecond by TraceCheck,
/// from the statuses by StatusJudge. The result does not depend on `jobs`. Throws std::invalid_argument when the strategy is unknown or
/// there is no cell; a program that cannot be generated is a failing one.
[[nodiscard]] CampaignReport run_campaign(const CampaignOptions& options);

/// The command line that runs one program of a campaign again.
[[nodiscard]] std::string command_line(const CampaignReport& report, const CampaignRun& run);

/// One line per cell, and the failing programs, at most `most` of them.
[[nodiscard]] std::string summary(const CampaignReport& report, std::size_t most);

[[nodiscard]] nlohmann::json to_json(const CampaignReport& report);

}  // namespace interlace::sim
