#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "app_client/ledger.hpp"
#include "common/model/messages.hpp"

/// What the command line says, for people (mm, degrees, seconds) and for programs (JSON, SI). Pure.
namespace interlace::client {

/// "completed", "rejected: unreachable: …": the state and, where there is something to explain, why.
[[nodiscard]] std::string describe(const model::CommandStatus& status);

/// Several lines: the planner and a table of its robots with what each waits for and until when.
[[nodiscard]] std::string describe(const model::PlannerState& state, bool alive);

[[nodiscard]] nlohmann::json to_json(const Answer& answer);
[[nodiscard]] nlohmann::json to_json(const model::PlannerState& state, bool alive);

}  // namespace interlace::client
