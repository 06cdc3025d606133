#pragma once

#include <string>
#include <string_view>

#include "common/model/ids.hpp"

namespace interlace::client {

/// Longest prefix make_id takes [bytes].
inline constexpr std::size_t kMaxIdPrefix = model::kMaxNameLength - 20;

/// `prefix`, '-' and twelve random letters and digits (60 bits from the system's random source): unique over processes, machines and
/// restarts. Leaves room for a suffix of seven bytes. Throws std::invalid_argument when the prefix is no valid name or too long. Any
/// thread.
[[nodiscard]] std::string make_id(std::string_view prefix);

}  // namespace interlace::client
