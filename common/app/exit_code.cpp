#include "common/app/exit_code.hpp"

#include <fmt/format.h>

namespace interlace::app {

const char* meaning(ExitCode code) {
  switch (code) {
    case ExitCode::ok: return "did what was asked";
    case ExitCode::unserved: return "a command was rejected, failed or left waiting; a replay decided differently";
    case ExitCode::bad_input: return "options, a cell file or a program file are wrong; nothing was started";
    case ExitCode::collision: return "robots touched";
    case ExitCode::unavailable: return "a process, robot or cell that is needed is not there";
    case ExitCode::fault: return "a failure of the program or of the machine under it";
    case ExitCode::interrupted: return "stopped by SIGINT or SIGTERM before the work was done";
  }
  return "?";
}

std::string exit_code_help() {
  std::string text = "Exit codes:";
  for (const auto code : {ExitCode::ok, ExitCode::unserved, ExitCode::bad_input, ExitCode::collision, ExitCode::unavailable,
                          ExitCode::fault, ExitCode::interrupted}) {
    text += fmt::format("\n  {:>3}  {}", to_int(code), meaning(code));
  }
  return text;
}

}  // namespace interlace::app
