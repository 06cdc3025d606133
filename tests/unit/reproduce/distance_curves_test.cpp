#include "simulator/reproduce/distance_curves.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "simulator/trace.hpp"
#include "tests/support/arms.hpp"
#include "tests/unit/reproduce/pictures.hpp"

namespace interlace::reproduce {
namespace {

/// Arms that stand upright side by side, 500 mm apart.
model::Cell upright(std::size_t robots) {
  model::Cell cell;
  for (std::size_t i = 0; i < robots; ++i) {
    model::Robot robot;
    robot.name = model::RobotName{"r" + std::to_string(i + 1)};
    robot.model = test::arm4();
    robot.X_WB.translation() = model::Vector3{0, 0.5 * static_cast<double>(i), 0};
    cell.robots.push_back(robot);
  }
  return cell;
}

Frame standing(double t, std::size_t robots) {
  return {t, std::vector<model::Joints>(robots, model::Joints::Zero())};
}

TEST(DistanceCurves, OfUprightArmsAreThoseComputedByHand) {
  const auto all = link_distances(upright(2), {standing(0, 2), standing(0.01, 2)}, 0, 1);
  ASSERT_EQ(all.size(), 16U);
  for (const LinkDistance& d : all) {
    ASSERT_EQ(d.distance.size(), 2U);
    // Axes stacked from the floor: 0 to 290, to 550, to 820, to 910 mm.
    const double low[] = {0, 0.29, 0.55, 0.82}, high[] = {0.29, 0.55, 0.82, 0.91};
    const double gap = std::max({0.0, low[d.link_a] - high[d.link_b], low[d.link_b] - high[d.link_a]});
    EXPECT_NEAR(d.distance[0], std::hypot(0.5, gap), 1e-12) << d.link_a << " " << d.link_b;
    EXPECT_EQ(d.distance[1], d.distance[0]);
  }
  EXPECT_NEAR(all[0].prohibited, 0.224, 1e-12);
  EXPECT_NEAR(all[5].prohibited, 0.234, 1e-12);
  const auto least = least_clearance(all);
  ASSERT_EQ(least.size(), 2U);
  EXPECT_NEAR(least[0], 0.5 - 0.234, 1e-12) << "the thickest links, link1 to link1";
}

TEST(DistanceCurves, TwoRobotsHaveAGraphPerPairOfLinks) {
  const std::vector<Frame> frames{standing(0, 2), standing(1, 2)};
  const std::string svg = distance_picture("a & b", upright(2), {{"before", &frames}, {"after", &frames}});
  EXPECT_EQ(test::fault_in_xml(svg), "");
  EXPECT_EQ(test::count_of(svg, "class=\"limit\""), 16U);
  EXPECT_EQ(test::count_of(svg, "class=\"curve\""), 32U);
  EXPECT_EQ(test::count_of(svg, "class=\"contact\""), 0U);
}

TEST(DistanceCurves, MoreRobotsHaveAGraphPerPairOfRobots) {
  model::Cell cell = upright(3);
  cell.robots[2].X_WB.translation().y() = 0.6;  // touches the second
  const std::vector<Frame> frames{standing(0, 3), standing(1, 3)};
  const std::string svg = distance_picture("title", cell, {{"before", &frames}});
  EXPECT_EQ(test::fault_in_xml(svg), "");
  EXPECT_EQ(test::count_of(svg, "class=\"limit\""), 3U);
  EXPECT_EQ(test::count_of(svg, "class=\"contact\""), 1U);
}

TEST(Postures, AreThoseOfTheTrace) {
  const model::Cell cell = upright(2);
  std::ostringstream csv;
  sim::TraceWriter trace{csv};
  model::Joints q;
  q << 0.1, -0.2, 0.3, -0.4, 0.5, -0.6;
  for (const double t : {0.0, 0.01}) {
    trace.row(t, cell.robots[0], q * (1 + t), "r1-1");
    trace.row(t, cell.robots[1], -q, "");
  }
  const auto frames = parse_trace(csv.str(), cell);
  ASSERT_EQ(frames.size(), 2U);
  EXPECT_NEAR(frames[1].t, 0.01, 1e-12);
  EXPECT_LT((frames[1].joints[0] - q * 1.01).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_LT((frames[1].joints[1] + q).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_EQ(&frame_at(frames, -1), &frames[0]);
  EXPECT_EQ(&frame_at(frames, 0.009), &frames[0]);
  EXPECT_EQ(&frame_at(frames, 5), &frames[1]);
}

TEST(Postures, ABrokenTraceIsRefusedWithItsLine) {
  const model::Cell cell = upright(1);
  for (const std::string line : {"0.0,r1,1,2", "0.0,r9,1,2,3,4,5,6,7,1,2,3,4,5,6,", "x,r1,1,2,3,4,5,6,7,1,2,3,4,5,6,"}) {
    try {
      (void)parse_trace("header\n" + line + "\n", cell);
      ADD_FAILURE() << line;
    } catch (const std::runtime_error& e) {
      EXPECT_EQ(std::string{e.what()}.rfind("trace:2:", 0), 0U) << e.what();
    }
  }
}

}  // namespace
}  // namespace interlace::reproduce
