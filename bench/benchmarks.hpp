#pragma once

#include <string>

namespace interlace::bench {

/// Collision maps and their peers. `cells`: folder of the ready-made cells.
void register_map_benchmarks(const std::string& cells);

/// Decisions in rings and rows.
void register_decision_benchmarks();

}  // namespace interlace::bench
