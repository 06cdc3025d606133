#pragma once

#include <vector>

#include "common/app/config/field.hpp"
#include "common/model/messages.hpp"
#include "common/model/tools.hpp"

namespace interlace::app {

/// The entries under `tools`: `NAME: {capsules: [{from, to, radius}, …]}`, ends in the flange frame, in the order of the file.
[[nodiscard]] std::vector<model::Tool> read_tools(const Field& field, const Units& units);

/// A list of different names, each one of `tools`.
[[nodiscard]] std::vector<model::ToolName> read_held(const Field& field, const std::vector<model::Tool>& tools);

/// The keys `attach`, `detach` and `when` of a command; empty when it has none of them. Names must be among `tools` unless that is null.
[[nodiscard]] std::optional<model::ToolChange> read_tool_change(const Mapping& command, const std::vector<model::Tool>* tools);

}  // namespace interlace::app
