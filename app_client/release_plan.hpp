#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "common/model/program.hpp"

namespace interlace::client {

/// One command of a program, ready to submit.
struct PlannedCommand {
  model::CommandSubmitted command;
  double release = 0;       ///< after the start of the program [s]
  std::size_t ordinal = 0;  ///< 1 … of: its place among the commands of its robot
  std::size_t of = 0;
};

/// All commands of `program` in the order they are to be submitted, robots in turn where several come at once. A robot's commands keep the
/// order of the file: one is released no earlier than the one before it. Ids are `<run>.<number>`; `run` leaves seven bytes for that. Pure.
[[nodiscard]] std::vector<PlannedCommand> release_plan(const model::Program& program, const std::string& run);

}  // namespace interlace::client
