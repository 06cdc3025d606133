#pragma once

#include <chrono>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "tests/support/process.hpp"

namespace interlace::test {

using namespace std::chrono_literals;

/// Longest time a step may take on a busy machine before a test gives up; nothing takes this long when all is well.
inline constexpr std::chrono::milliseconds kPatience = 20s;

// The real programs, as built.
inline const std::string kPlanner = INTERLACE_BIN_DIR "/interlace-planner";
inline const std::string kProxy = INTERLACE_BIN_DIR "/interlace-proxy";
inline const std::string kSim = INTERLACE_BIN_DIR "/interlace-sim";
inline const std::string kClient = INTERLACE_BIN_DIR "/interlace";
inline const std::string kMonitor = INTERLACE_BIN_DIR "/interlace-monitor";

/// A file of deploy/cells, such as exp-4-2/cell.yaml.
inline std::string deployed(const std::string& file) {
  return INTERLACE_CELLS_DIR "/" + file;
}

/// How a program ended and what it said.
struct Outcome {
  std::optional<int> exit_code;  ///< empty: it did not end in time and was killed
  std::string output, errors;
  [[nodiscard]] bool says(const std::string& text) const {
    return output.find(text) != std::string::npos || errors.find(text) != std::string::npos;
  }
  friend std::ostream& operator<<(std::ostream& out, const Outcome& o) {
    return out << "exit code " << (o.exit_code ? std::to_string(*o.exit_code) : "none") << "\nstdout:\n"
               << o.output.substr(0, 4000) << "\nstderr:\n"
               << o.errors.substr(0, 4000);
  }
};

/// Waits for the end of `process`.
inline Outcome outcome(Process& process, std::chrono::milliseconds patience = kPatience) {
  const auto exit_code = process.wait(patience);
  return {exit_code, process.output(), process.errors()};
}

/// Runs a program to its end.
inline Outcome run(std::vector<std::string> arguments, std::chrono::milliseconds patience = kPatience) {
  Process process{std::move(arguments), true};
  return outcome(process, patience);
}

}  // namespace interlace::test
