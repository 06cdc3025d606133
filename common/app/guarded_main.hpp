#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <exception>

#include "common/app/exit_code.hpp"

namespace interlace::app {

/// What `main` returns: the exit code of `body`, or that of a fault with what it threw told on stderr after the program's name.
template <typename Body>
int guarded_main(const char* program, const Body& body) {
  try {
    return to_int(body());
  } catch (const std::exception& e) {
    fmt::print(stderr, "{}: {}\n", program, e.what());
    return to_int(ExitCode::fault);
  }
}

}  // namespace interlace::app
