#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "app_client/ledger.hpp"
#include "common/model/messages.hpp"

/// What the command line says, for people (mm, degrees, seconds) and for programs (JSON, SI). Pure.
namespace interlace::client {

/// "completed", "rejected: unreachable: …": the state and, where there is something to explain, why; a line more for each way out of a
/// deadlock that was tried in vain.
[[nodiscard]] std::string describe(const model::CommandStatus& status);

/// "escape ID for COMMAND  started: …".
[[nodiscard]] std::string describe_escape(const model::CommandStatus& status);

/// "r1  commanded  3  ID (escape for COMMAND)", the name `width` wide, and on further lines what it waits for: who, which links, until
/// when, and the ways out of a deadlock that were tried in vain. `now`: of the planner.
[[nodiscard]] std::string describe(const model::RobotStatus& robot, model::Instant now, std::size_t width);

/// Several lines: the planner and a table of its robots with what each waits for and until when.
[[nodiscard]] std::string describe(const model::PlannerState& state, bool alive);

[[nodiscard]] nlohmann::json to_json(const Answer& answer);
[[nodiscard]] nlohmann::json to_json(const model::RobotStatus& robot);
[[nodiscard]] nlohmann::json to_json(const model::PlannerState& state, bool alive);

}  // namespace interlace::client
