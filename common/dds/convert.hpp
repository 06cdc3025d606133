#pragma once

#include <string>

#include "common/dds/envelope.hpp"
#include "common/model/journal.hpp"
#include "common/model/result.hpp"
#include "interlace.h"

/// Message ↔ IDL type. Internal to common/dds. Pure.
namespace interlace::dds {

/// A message, or one sentence that names the field, its value and the rule it breaks.
template <typename Message>
using Converted = model::Result<Message, std::string>;

/// Checks every field of `wire`; `owner` is the robot (the cell, for PlannerState) the topic belongs to.
[[nodiscard]] Converted<CommandMessage> from_wire(const ::interlace::Command& wire, const std::string& owner);
[[nodiscard]] Converted<StatusMessage> from_wire(const ::interlace::CommandStatus& wire, const std::string& owner);
[[nodiscard]] Converted<DispatchMessage> from_wire(const ::interlace::Dispatch& wire, const std::string& owner);
[[nodiscard]] Converted<ExecutionMessage> from_wire(const ::interlace::Execution& wire, const std::string& owner);
[[nodiscard]] Converted<PostureMessage> from_wire(const ::interlace::Posture& wire, const std::string& owner);
[[nodiscard]] Converted<model::PlannerState> from_wire(const ::interlace::PlannerState& wire, const std::string& owner);
[[nodiscard]] Converted<model::PlannerJournal> from_wire(const ::interlace::PlannerJournal& wire, const std::string& owner);

/// Never fails: text is tidied and cut, conflicts beyond kMaxConflicts and refusals beyond kMaxRefusals are left out. Whether a
/// receiver accepts the result, from_wire tells.
[[nodiscard]] ::interlace::Command to_wire(const CommandMessage& message);
[[nodiscard]] ::interlace::CommandStatus to_wire(const StatusMessage& message);
[[nodiscard]] ::interlace::Dispatch to_wire(const DispatchMessage& message);
[[nodiscard]] ::interlace::Execution to_wire(const ExecutionMessage& message);
[[nodiscard]] ::interlace::Posture to_wire(const PostureMessage& message);
[[nodiscard]] ::interlace::PlannerState to_wire(const model::PlannerState& message);
[[nodiscard]] ::interlace::PlannerJournal to_wire(const model::PlannerJournal& message);

}  // namespace interlace::dds
