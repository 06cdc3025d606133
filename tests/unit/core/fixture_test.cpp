#include <gtest/gtest.h>

#include "planner/core/admission.hpp"
#include "planner/core/escape_goal.hpp"
#include "tests/support/fixtures.hpp"
#include "tests/unit/core/desk.hpp"

/// Fixtures in admission, in the queue and in escapes.
namespace interlace::test {
namespace {

/// Two arms with a fence between them and a mesh table in front of the first.
std::shared_ptr<model::Cell> furnished_cell() {
  auto cell = experiment_cell();
  cell->fixtures.push_back(fixture("fence", model::BoxShape{{0.2, 0.005, 0.3}}, at(0.5, 0, 0.3)));
  cell->fixtures.push_back(fixture("table", model::MeshShape{box_mesh({0.1, 0.1, 0.1})}, at(0.45, 0.3, 0)));
  return cell;
}

TEST(Fixtures, APathThroughOneIsRefusedWithThePlaceAndTheName) {
  const auto cell = furnished_cell();
  const auto through = core::admit(*cell, 0, cell->robots[0], cell->robots[0].start, line_to(pose_mm(450, -50, 300)));
  ASSERT_FALSE(through);
  EXPECT_EQ(through.error().reason, Reason::fixture_collision);
  // The forearm, 100 mm in radius at the wrist, comes to the fence, 5 mm to either side of y = 0, after 145 of its 300 mm.
  EXPECT_NEAR(through.error().progress, 145.0 / 300, 0.01);
  EXPECT_NEAR(through.error().p_WTcp.y(), 0.105, 0.003);
  EXPECT_NE(through.error().text.find("link2 would touch fixture fence after 14"), std::string::npos) << through.error().text;
  EXPECT_NE(through.error().text.find("at 48 % of the path, TCP at (450.0, 10"), std::string::npos) << through.error().text;

  const auto down = core::admit(*cell, 0, cell->robots[0], cell->robots[0].start, line_to(pose_mm(450, 250, 120)));
  ASSERT_FALSE(down);
  EXPECT_NE(down.error().text.find("would touch fixture table"), std::string::npos) << down.error().text;

  EXPECT_TRUE(core::admit(*cell, 0, cell->robots[0], cell->robots[0].start, line_to(pose_mm(400, 300, 330))));
}

TEST(Fixtures, TheMarginOfTheCellIsKept) {
  const auto cell = furnished_cell();
  const auto beside = line_to(pose_mm(450, 112, 300));  // 7 mm between forearm and fence
  EXPECT_TRUE(core::admit(*cell, 0, cell->robots[0], cell->robots[0].start, beside));
  cell->planning.margin = 0.008;
  EXPECT_FALSE(core::admit(*cell, 0, cell->robots[0], cell->robots[0].start, beside));
}

TEST(Fixtures, ABaseMayStandOnOneButNothingElseMayTouchIt) {
  const auto cell = experiment_cell();
  cell->fixtures.push_back(fixture("floor", model::PlaneShape{}));  // the base's capsule ends 112 mm below
  const auto& start = cell->robots[0].start;
  EXPECT_TRUE(core::admit(*cell, 0, cell->robots[0], start, line_to(pose_mm(400, 250, 200))));
  const auto down = core::admit(*cell, 0, cell->robots[0], start, line_to(pose_mm(450, 250, 20)));
  ASSERT_FALSE(down);
  EXPECT_NE(down.error().text.find("fixture floor"), std::string::npos) << down.error().text;
}

TEST(Fixtures, TheClientIsToldAtOnce) {
  Desk desk{furnished_cell()};
  desk.all_stand();
  desk.submit("through", "r1", line_to(pose_mm(450, -50, 300)));
  EXPECT_EQ(desk.status_of("through").state, CommandState::rejected);
  EXPECT_EQ(desk.status_of("through").reason, Reason::fixture_collision);
  EXPECT_LE(desk.status_of("through").text.size(), 256U) << "longer than the wire carries";
  desk.submit("beside", "r1", line_to(pose_mm(400, 300, 330)));
  EXPECT_EQ(desk.status_of("beside").state, CommandState::scheduled);
}

TEST(Fixtures, AReachableGoalOfAnEscapeEndsBeforeThem) {
  const auto cell = furnished_cell();
  for (const model::Vector3& unit : {model::Vector3{0, -1, 0}, model::Vector3{0, 0, -1}}) {
    const auto out = core::to_reachable_goal(*cell, 0, cell->robots[0], cell->robots[0].start, unit);
    ASSERT_TRUE(out.motion) << unit.transpose();
    EXPECT_FALSE(core::path_collision(*out.motion, *cell, 0, cell->planning.margin));
    const model::Motion& m = out.motion->motion();
    const double without = 0.3;  // [m]: it would go farther if nothing stood there
    EXPECT_LT(m.length(m.duration()), without) << unit.transpose();
    EXPECT_GT(m.length(m.duration()), 0.02) << unit.transpose();
  }
}

}  // namespace
}  // namespace interlace::test
