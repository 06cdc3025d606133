#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/model/cell.hpp"
#include "planner/core/planner.hpp"

namespace interlace::test {

/// A command that the client of a scenario submits sooner or later; those of one robot in their order.
struct Order {
  std::string id;
  model::RobotIndex robot = 0;
  model::MotionRequest motion;
};

/// What may go one way or another besides when the client submits.
struct Liberties {
  bool late_starts = true;                  ///< a proxy starts at any instant of its window; else at the earliest
  bool late_reports = true;                 ///< reports arrive at any instant within `confirm`; else at once
  bool refusal = false;                     ///< a proxy may refuse one waiting dispatch
  std::string cancelled;                    ///< id of an order that the client may give up once it has submitted it
  std::optional<model::RobotIndex> silent;  ///< robot that may fall silent once, and comes back
};

/// A small cell and all that is asked of it.
struct Scenario {
  std::shared_ptr<const model::Cell> cell;
  core::PlannerOptions options;
  std::vector<Order> orders;
  Liberties liberties;
};

}  // namespace interlace::test
