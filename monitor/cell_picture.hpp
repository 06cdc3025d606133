#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/model/cell.hpp"
#include "common/model/messages.hpp"
#include "monitor/alarm_board.hpp"

namespace interlace::monitor {

/// One robot as an observer knows it.
struct RobotPicture {
  const model::Robot* body = nullptr;             ///< with what it holds; without anything as long as it was not heard
  std::optional<model::PostureReported> posture;  ///< the newest, however old
  bool heard = false;                             ///< lately, so that `posture` is where it is now
  bool stranger = false;                          ///< its proxy works with another cell file: nothing it says counts
  std::vector<model::Capsule> capsules;           ///< where the body's are; empty as long as it was not heard
  std::vector<double> clearance;                  ///< of each to the nearest body of another robot or fixture, at most 1 m [m]
  std::optional<model::RobotStatus> status;       ///< as the planner said last
  std::string waiting;                            ///< why it stands although it has work, in one sentence; empty when it does not
};

/// One moment of a cell, for whoever shows it in another way than the page. Refers to the cell and the view it comes from.
struct CellPicture {
  const model::Cell* cell = nullptr;
  std::vector<RobotPicture> robots;  ///< in the order of the cell
  bool planner_heard = false;
  std::optional<model::PlannerState> planner;  ///< as it said last
  std::vector<Alarm> alarms;                   ///< those that hold first; see AlarmBoard
};

}  // namespace interlace::monitor
