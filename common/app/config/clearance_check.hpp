#pragma once

#include <vector>

#include "common/app/config/field.hpp"
#include "common/model/cell.hpp"

namespace interlace::app {

/// A robot of the cell being read, with the fields its poses come from.
struct PlacedRobot {
  model::Robot robot;
  Field start;
  Field home;  ///< the start's when the file gives no home
};

/// Complains about robots that touch themselves, or each other or a fixture by `margin` [m], when all stand at their start and when all
/// stand at home, with what of `tools` they hold at first.
void check_clearances(const std::vector<PlacedRobot>& robots, const std::vector<model::Tool>& tools,
                      const std::vector<model::Fixture>& fixtures, double margin, const Units& units);

}  // namespace interlace::app
