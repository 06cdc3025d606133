#pragma once

#include <array>
#include <chrono>
#include <memory>
#include <string>
#include <utility>
#include <vector>

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

/// Three arms around one place, their homes tucked back over their bases; they start, and are to go, where `starts` and `goals` [mm] say.
inline Scenario triangle(const std::array<model::Vector3, 3>& starts, const std::array<model::Vector3, 3>& goals) {
  auto cell = std::make_shared<model::Cell>();
  cell->name = "triangle";
  cell->robots.push_back(experiment_robot("r1", {0, 0.25, 0}, pose_mm(200, 250, 500, 0, -45, 0)));
  cell->robots.push_back(experiment_robot("r2", {0, -0.25, 0}, pose_mm(200, -250, 500, 0, -45, 0)));
  cell->robots.push_back(experiment_robot("r3", {0.6, 0, 0}, pose_mm(400, 0, 500, 0, -45, 180), kPi));
  const auto at = [](const model::Vector3& p, model::RobotIndex i) { return pose_mm(p.x(), p.y(), p.z(), 0, 0, i == 2 ? 180 : 0); };
  std::vector<Order> orders;
  for (model::RobotIndex i = 0; i < 3; ++i) {
    model::Robot& r = cell->robots[i];
    r.start = model::preferred_posture(r.model, r.X_WB.inverse() * at(starts[i], i)).value();
    orders.push_back({std::string(1, static_cast<char>('a' + i)) + "1", i, line_to(at(goals[i], i))});
  }
  return walked(cell, std::move(orders));
}

/// r2 stands in the way of r3, and r3 in the way of r1.
inline Scenario chain() {
  return triangle({{{240, 280, 360}, {430, -140, 290}, {220, 120, 190}}}, {{{310, 230, 310}, {160, -70, 250}, {440, -200, 380}}});
}

/// Both others stand in the way of r2, and one of them in the way of r1.
inline Scenario two_blockers() {
  return triangle({{{240, 30, 300}, {410, -260, 230}, {270, 200, 240}}}, {{{420, 260, 410}, {380, 60, 210}, {490, 300, 330}}});
}

/// Each of three stands where the next wants to pass.
inline Scenario circle_of_three() {
  return triangle({{{340, 130, 390}, {240, -190, 380}, {250, -110, 260}}}, {{{220, -40, 360}, {440, -270, 390}, {310, 220, 360}}});
}

/// r2 alone stands in the way of r1, and can only leave when r3 has gone first.
inline Scenario cascade() {
  return triangle({{{400, 240, 280}, {430, -130, 170}, {370, -290, 380}}}, {{{320, -140, 180}, {430, -250, 350}, {300, -300, 380}}});
}

}  // namespace interlace::test
