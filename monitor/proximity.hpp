#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "common/model/cell.hpp"

namespace interlace::monitor {

/// A robot as it stands or passes now; null or empty `bodies`: nobody knows where it is.
struct PlacedRobot {
  const model::Robot* robot = nullptr;  ///< with what it holds
  std::vector<model::Capsule> bodies;   ///< in the order of its model's capsules

  [[nodiscard]] bool known() const { return robot != nullptr && !bodies.empty(); }
};

/// How near everything is to everything else at one moment [m].
struct Proximity {
  std::vector<std::vector<double>> capsules;    ///< of each robot's capsules: to the nearest body of another robot or fixture
  std::vector<std::optional<double>> pairs;     ///< of each pair of robots, in the order asked for; empty when one is not known
  std::vector<std::optional<double>> fixtures;  ///< of each robot: to the nearest fixture; link 0 left out
};

/// Nothing farther than this is told apart [m].
inline constexpr double kFar = 1.0;

/// Clearances of `robots`, one per robot of `cell`, for pictures: beyond kFar a lower bound stands for the value. Measured with the
/// observers' distance routines, not the planner's. Pure.
[[nodiscard]] Proximity measure(const model::Cell& cell, const std::vector<std::pair<model::RobotIndex, model::RobotIndex>>& pairs,
                                const std::vector<PlacedRobot>& robots);

}  // namespace interlace::monitor
