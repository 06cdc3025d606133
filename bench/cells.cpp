#include "bench/cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tests/support/arms.hpp"

namespace interlace::bench {

namespace {

using model::kPi;
using model::Vector3;

constexpr double kApart = 0.5;     // [m] between neighbours' bases
constexpr double kNearest = 0.35;  // [m] from the centre of a ring

model::Robot arm(std::size_t number, const Vector3& p_WB, double yaw) {
  const model::Pose X_BHome = test::pose_mm(200, 0, 500, 0, -45, 0);
  const model::Pose X_WB = model::make_pose(p_WB, model::rotation_from_rpy({0, 0, yaw}));
  model::Robot robot = test::experiment_robot(fmt::format("r{}", number + 1), p_WB, X_WB * X_BHome, yaw);
  model::Joints rate;
  rate << 90, 90, 90, 180, 180, 180;
  rate *= kPi / 180;
  robot.model.joints.velocity = rate;
  robot.model.joints.acceleration = rate;
  return robot;
}

}  // namespace

std::shared_ptr<const model::Cell> ring(std::size_t count) {
  auto cell = std::make_shared<model::Cell>();
  cell->name = fmt::format("ring-{}", count);
  const double radius = std::max(kNearest, kApart / 2 / std::sin(kPi / static_cast<double>(count)));
  for (std::size_t i = 0; i < count; ++i) {
    const double angle = 2 * kPi * static_cast<double>(i) / static_cast<double>(count);
    cell->robots.push_back(arm(i, {radius * std::cos(angle), radius * std::sin(angle), 0}, angle + kPi));
  }
  return cell;
}

std::shared_ptr<const model::Cell> row(std::size_t count) {
  auto cell = std::make_shared<model::Cell>();
  cell->name = fmt::format("row-{}", count);
  for (std::size_t i = 0; i < count; ++i) cell->robots.push_back(arm(i, {0, -kApart * static_cast<double>(i), 0}, 0));
  return cell;
}

}  // namespace interlace::bench
