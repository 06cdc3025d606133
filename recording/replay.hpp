#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/app/config/cell_file.hpp"
#include "common/app/report.hpp"
#include "common/model/journal.hpp"
#include "common/model/result.hpp"

/// A recording made to happen again: the planner is told the same and must decide the same.
namespace interlace::recording {

/// All that one planner was told, from its first call on and without a gap.
struct PlannerLife {
  std::uint64_t fingerprint = 0, incarnation = 0;
  model::PlannerSettings settings;
  std::vector<model::PlannerCall> calls;
};

/// What a replay needs of a recording.
struct Recorded {
  app::LoadedCell cell;
  std::vector<PlannerLife> lives;        ///< one for each planner that was heard, in their order; at least one
  app::RunReport report;                 ///< of the first life, as its statuses and postures say
  bool has_cell_file = false;            ///< its own, `cell` is from it
  std::optional<std::uint64_t> cut_off;  ///< the recorder was killed: where the file stops being whole [bytes], the end may be missing
};

/// Reads the recording at `path`. `cell_file` stands in for the cell file that is not in it; empty: there is none. An error is one
/// sentence, and says how to record when the recording is not complete.
[[nodiscard]] model::Result<Recorded, std::string> read_recorded(const std::string& path, const std::string& cell_file);

/// The first decision that came out differently.
struct Difference {
  std::uint64_t call = 0;  ///< its number
  model::Instant now{};
  std::string told;  ///< what the planner was told
  model::DecisionDigest recorded, replayed;
  std::string decided;  ///< what it decides now, for people
};

/// How a replay went.
struct Replay {
  std::uint64_t calls = 0, decisions = 0;  ///< compared; a decision is a dispatch, a withdrawal or a status
  std::optional<Difference> difference;
};

/// Tells a new planner what the one of `life` was told, and compares all that it decides.
/// Throws std::invalid_argument when this program does not know the strategy.
[[nodiscard]] Replay replay(const std::shared_ptr<const model::Cell>& cell, const PlannerLife& life);

}  // namespace interlace::recording
