#pragma once

#include <chrono>
#include <utility>

#include "tests/model/scenario.hpp"
#include "tests/support/arms.hpp"

/// The scenarios that are walked. The arms are five times as fast as the dissertation's, so that windows and delays of messages are not
/// small beside the motions, and their maps are coarse, which is as safe and makes a walk affordable.
namespace interlace::test {

inline core::PlannerOptions walked_options() {
  using namespace std::chrono_literals;
  core::PlannerOptions o;
  o.lead = 20ms;
  o.start_tolerance = 60ms;
  o.confirm = 40ms;
  return o;
}

inline Scenario walked(std::shared_ptr<model::Cell> cell, std::vector<Order> orders) {
  for (model::Robot& r : cell->robots) {
    r.tcp.velocity = 0.5;
    r.tcp.acceleration = 2;
  }
  cell->planning.resolution = 0.05;
  return {std::move(cell), walked_options(), std::move(orders), {}};
}

/// Where only one arm at a time can be, and a place of its own for each.
inline model::MotionRequest to_middle() {
  return line_to(pose_mm(350, 0, 200));
}
inline model::MotionRequest aside_r1() {
  return line_to(pose_mm(400, 250, 320));
}
inline model::MotionRequest aside_r2() {
  return line_to(pose_mm(420, -250, 320));
}

/// Both want the same place. Whoever comes second finds the other standing there with nothing to do.
inline Scenario idle_blocker() {
  return walked(experiment_cell(), {{"a1", 0, to_middle()}, {"b1", 1, to_middle()}});
}

/// Both want the same place and leave it again: the second waits, or sends the first away when its next command has not come yet.
inline Scenario there_and_back() {
  return walked(experiment_cell(), {{"a1", 0, to_middle()}, {"a2", 0, aside_r1()}, {"b1", 1, to_middle()}, {"b2", 1, aside_r2()}});
}

/// Each stands where the other wants to go.
inline Scenario swapped_places() {
  auto cell = experiment_cell();
  for (model::RobotIndex i = 0; i < 2; ++i) {
    model::Robot& r = cell->robots[i];
    r.start = model::preferred_posture(r.model, r.X_WB.inverse() * pose_mm(350, i == 0 ? 150 : -150, 200)).value();
  }
  return walked(cell, {{"a1", 0, line_to(pose_mm(350, -80, 200))}, {"b1", 1, line_to(pose_mm(350, 80, 200))}});
}

}  // namespace interlace::test
