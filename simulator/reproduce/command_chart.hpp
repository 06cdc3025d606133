#pragma once

#include <string>
#include <vector>

#include "simulator/reproduce/experiments.hpp"

namespace interlace::reproduce {

/// The command chart of a run as a picture (dissertation figures 4.6 to 6.18): one row per robot, a box per command from its start to its
/// end, escapes as black boxes, the time in which a robot stood because its next command had to wait hatched. `end` [s] is the right end of
/// the time axis, so that the charts of one experiment can be laid one above the other.
[[nodiscard]] std::string command_chart(const std::string& title, const app::RunReport& report, const model::Cell& cell,
                                        const NamedCommands& named, double end);

/// When the last command of a run ended, or was still waited for [s].
[[nodiscard]] double last_end(const app::RunReport& report);

}  // namespace interlace::reproduce
