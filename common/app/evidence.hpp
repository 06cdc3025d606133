#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "common/model/messages.hpp"

/// Why a robot waits and what was tried in vain, in words and as JSON: the same in logs, reports and on the command line. Pure.
namespace interlace::app {

/// "r2 cannot go -y: r3 stands there".
[[nodiscard]] std::string describe(const model::EscapeRefusal& refusal);

/// "r2's eef in the way of link2, 12.0 mm deep, free in 1.20 s"; `now` is on the clock of the conflict.
[[nodiscard]] std::string describe(const model::Conflict& conflict, model::Instant now);

/// [{robot, way, explanation}].
[[nodiscard]] nlohmann::json to_json(const std::vector<model::EscapeRefusal>& refusals);

/// [{blocker, link, blocker_link, clearance_m, place_m, open_ended, until_s}]; until_s is null when no end is known.
[[nodiscard]] nlohmann::json to_json(const std::vector<model::Conflict>& conflicts);

/// The text, or null when the name is empty.
[[nodiscard]] nlohmann::json name_or_null(const std::string& name);

}  // namespace interlace::app
