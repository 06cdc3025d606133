#pragma once

#include <map>
#include <vector>

#include "common/model/messages.hpp"

namespace interlace::model {

/// One line of a program file: what to submit and when.
struct ProgramStep {
  MotionRequest motion;
  int priority = 0;
  double at = 0;                                  ///< release time after the start of the program [s]
  std::optional<double> deadline = std::nullopt;  ///< after its release [s]
};

/// Something other than a command that happens while a program runs.
struct ProgramEvent {
  enum class What { hold, resume, cancel, replace };
  What what = What::hold;
  double at = 0;  ///< after the start of the program [s]
  RobotName robot;
  std::size_t command = 0;            ///< of `cancel`: which of the robot's commands, from 1
  std::vector<ProgramStep> commands;  ///< of `replace`: what takes the queue's place
};

/// Commands per robot, in the order they are to be submitted, `repeat` already unrolled.
struct Program {
  std::vector<std::pair<RobotName, std::vector<ProgramStep>>> robots;
  std::vector<ProgramEvent> events;  ///< in the order of their time

  [[nodiscard]] std::size_t size() const {
    std::size_t n = 0;
    for (const auto& entry : robots) n += entry.second.size();
    return n;
  }
};

}  // namespace interlace::model
