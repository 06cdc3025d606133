#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "common/app/report.hpp"
#include "recording/replay.hpp"

namespace interlace::recording {

/// What would have come of the requests of `life`, at their times after the first, with this cell and strategy: in virtual time, from the
/// robots' start poses. Throws std::invalid_argument when the strategy is unknown.
[[nodiscard]] app::RunReport what_if(std::shared_ptr<const model::Cell> cell, const PlannerLife& life, const std::string& strategy);

/// Runs side by side, for people: each with the heading of its column.
[[nodiscard]] std::string comparison(const std::vector<std::pair<std::string, app::RunReport>>& runs);

}  // namespace interlace::recording
