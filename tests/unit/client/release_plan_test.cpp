#include "app_client/release_plan.hpp"

#include <gtest/gtest.h>

namespace interlace::client {
namespace {

model::ProgramStep at(double seconds) {
  model::ProgramStep step;
  step.at = seconds;
  return step;
}

model::Program program(const std::vector<model::ProgramStep>& r1, const std::vector<model::ProgramStep>& r2) {
  model::Program p;
  p.robots.emplace_back(model::RobotName{"r1"}, r1);
  p.robots.emplace_back(model::RobotName{"r2"}, r2);
  return p;
}

TEST(ReleasePlan, RobotsTakeTurnsAndIdsCount) {
  const auto plan = release_plan(program({at(0), at(0)}, {at(0)}), "run-x");
  ASSERT_EQ(plan.size(), 3u);
  EXPECT_EQ(plan[0].command.robot.str(), "r1");
  EXPECT_EQ(plan[1].command.robot.str(), "r2");
  EXPECT_EQ(plan[2].command.robot.str(), "r1");
  EXPECT_EQ(plan[0].command.id.str(), "run-x.1");
  EXPECT_EQ(plan[2].command.id.str(), "run-x.3");
  EXPECT_EQ(plan[2].ordinal, 2u);
  EXPECT_EQ(plan[2].of, 2u);
}

TEST(ReleasePlan, ARobotsCommandsKeepTheirOrderWhateverTheirReleaseTimes) {
  const auto plan = release_plan(program({at(0), at(5), at(0), at(7)}, {at(6)}), "run-x");  // as with `repeat`
  std::vector<std::pair<std::size_t, double>> r1;
  double last = 0;
  for (const auto& p : plan) {
    EXPECT_GE(p.release, last);
    last = p.release;
    if (p.command.robot.str() == "r1") r1.emplace_back(p.ordinal, p.release);
  }
  EXPECT_EQ(r1, (std::vector<std::pair<std::size_t, double>>{{1, 0}, {2, 5}, {3, 5}, {4, 7}}));
}

TEST(ReleasePlan, OfAnEmptyProgramIsEmpty) {
  EXPECT_TRUE(release_plan({}, "run-x").empty());
}

}  // namespace
}  // namespace interlace::client
