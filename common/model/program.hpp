#pragma once

#include <map>
#include <vector>

#include "common/model/messages.hpp"

namespace interlace::model {

/// One line of a program file: what to submit and when.
struct ProgramStep {
  MotionRequest motion;
  int priority = 0;
  double at = 0;  ///< release time after the start of the program [s]
};

/// Commands per robot, in the order they are to be submitted, `repeat` already unrolled.
struct Program {
  std::vector<std::pair<RobotName, std::vector<ProgramStep>>> robots;

  [[nodiscard]] std::size_t size() const {
    std::size_t n = 0;
    for (const auto& entry : robots) n += entry.second.size();
    return n;
  }
};

}  // namespace interlace::model
