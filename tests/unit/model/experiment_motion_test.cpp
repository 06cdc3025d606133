#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/support/motions.hpp"

/// The commands of the dissertation's experiments can be carried out by its arm, in the time its limits give.
namespace interlace::test {
namespace {

/// Trapezoid of a straight line at 100 mm/s and 100 mm/s² [s].
double trapezoid(double metres) {
  return metres < 0.1 ? 2 * std::sqrt(metres / 0.1) : metres / 0.1 + 1;
}

TEST(Experiments, CommandsOfTable44AreReachable) {
  const auto cell = experiment_cell();
  const std::vector<std::vector<model::Pose>> programs{
      {pose_mm(300, 250, 330), pose_mm(350, 0, 200), pose_mm(350, -51, 200), pose_mm(400, 250, 330)},
      {pose_mm(300, -250, 330), pose_mm(350, 0, 200), pose_mm(350, 51, 200), pose_mm(400, -250, 330)}};
  for (std::size_t i = 0; i < programs.size(); ++i) {
    const auto& robot = cell->robots[i];
    model::Joints q = robot.start;
    model::Vector3 p = (robot.X_WB * model::tcp_pose(robot.model, q)).translation();
    for (const auto& X_WT : programs[i]) {
      const auto motion = model::plan_motion(robot, q, line_to(X_WT));
      ASSERT_TRUE(motion) << motion.error().text;
      EXPECT_NEAR(motion->duration(), trapezoid((X_WT.translation() - p).norm()), 1e-6);
      q = motion->to();
      p = X_WT.translation();
    }
  }
}

TEST(Experiments, CommandsOfTable51TurnAboutZWhatTheTableCallsRoll) {
  const auto cell = experiment_cell();
  const auto& robot = cell->robots[0];
  model::Joints q = robot.start;
  for (const auto& X_WT : {pose_mm(300, 250, 300, 0, 0, -90), pose_mm(400, -50, 300, 0, 0, -90), pose_mm(400, -50, 100, 0, 0, -90),
                           pose_mm(400, 400, 100), pose_mm(300, 250, 300)}) {
    const auto motion = model::plan_motion(robot, q, line_to(X_WT));
    ASSERT_TRUE(motion) << motion.error().text;
    q = motion->to();
  }
}

}  // namespace
}  // namespace interlace::test
