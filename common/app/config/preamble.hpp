#pragma once

#include "common/app/config/field.hpp"
#include "common/app/config/quantity.hpp"

namespace interlace::app {

/// Reads what every file of ours starts with: `interlace: 1` and `units: {length: mm|m, angle: deg|rad}`. Where the units are missing or
/// unknown that is a finding, and the rest is read as mm and deg to find what else is wrong.
[[nodiscard]] Units read_preamble(const Mapping& file);

}  // namespace interlace::app
