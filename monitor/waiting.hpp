#pragma once

#include <optional>
#include <string>

#include "monitor/command_book.hpp"

namespace interlace::monitor {

/// "r2 starts in 1.2 s, 1.8 s later than it could: r3's eef in the way of link2, 24.0 mm deep, free in 1.2 s": why the robot of `record`
/// stands although it has work, in one sentence. `now` [s] on the observer's line, on which the planner's zero lies at `zero`. Pure.
[[nodiscard]] std::string waiting_sentence(const CommandRecord& record, double zero, double now);

}  // namespace interlace::monitor
