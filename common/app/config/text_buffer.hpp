#pragma once

#include <fmt/format.h>

#include <iterator>
#include <utility>

namespace interlace::app {

/// Text of a file that grows piece by piece.
using TextBuffer = fmt::memory_buffer;

template <typename... Args>
void append(TextBuffer& out, fmt::format_string<Args...> format, Args&&... args) {
  fmt::format_to(std::back_inserter(out), format, std::forward<Args>(args)...);
}

}  // namespace interlace::app
