#pragma once

#include <cstdint>

#include "common/model/cell.hpp"

namespace interlace::app {

/// 64-bit FNV-1a over all values of `cell`, numbers rounded to 1e-9 SI units. Programs that work on one cell compare it: equal values give
/// equal fingerprints whatever the files' units, order of keys and comments. Pure.
[[nodiscard]] std::uint64_t fingerprint(const model::Cell& cell);

}  // namespace interlace::app
