#pragma once

#include <string>

namespace interlace::app {

/// How every program ends. Scripts rely on the numbers.
enum class ExitCode : int {
  ok = 0,            ///< did what was asked
  unserved = 1,      ///< a command was rejected, failed or left waiting
  bad_input = 2,     ///< options, a cell file or a program file are wrong; nothing was started
  collision = 3,     ///< robots touched
  unavailable = 4,   ///< a process, robot or cell that is needed is not there
  fault = 5,         ///< a failure of the program itself or of the machine under it
  interrupted = 130  ///< stopped by SIGINT or SIGTERM before the work was done
};

[[nodiscard]] constexpr int to_int(ExitCode code) {
  return static_cast<int>(code);
}

/// One phrase for people.
[[nodiscard]] const char* meaning(ExitCode code);

/// All codes with their meanings, for the end of --help.
[[nodiscard]] std::string exit_code_help();

}  // namespace interlace::app
