#pragma once

#include <tl/expected.hpp>

namespace interlace::model {

/// Value or reason. One enum or struct of reasons per operation; see the operation's own header.
template <typename T, typename E>
using Result = tl::expected<T, E>;

using tl::unexpected;

}  // namespace interlace::model
