#include "planner/core/neighbourhood.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "planner/core/clearance.hpp"
#include "planner/core/reach.hpp"
#include "tests/support/motions.hpp"

/// Who can meet whom, and that those said never to meet never do.
namespace interlace::test {
namespace {

using core::Neighbourhood;
using model::RobotIndex;

/// Arms of the experiments along y, all facing +x, the first at the greatest y.
model::Cell row(std::size_t count, double pitch) {
  model::Cell cell;
  for (std::size_t i = 0; i < count; ++i) {
    const double y = pitch * (static_cast<double>(count - 1) / 2 - static_cast<double>(i));
    cell.robots.push_back(experiment_robot("r" + std::to_string(i + 1), {0, y, 0}, pose_mm(450, 1e3 * y, 300)));
  }
  return cell;
}

using Robots = std::vector<RobotIndex>;

TEST(Neighbourhood, OfTwoFarApartIsEmpty) {
  const Neighbourhood far{row(2, 5)};
  EXPECT_FALSE(far.meet(0, 1));
  EXPECT_TRUE(far.of(0).empty());
  EXPECT_TRUE(far.of(1).empty());
}

TEST(Neighbourhood, OfASharedWorkspaceIsEverybodyElse) {
  const Neighbourhood shared{row(3, 0.5)};
  EXPECT_EQ(shared.of(0), (Robots{1, 2}));
  EXPECT_EQ(shared.of(1), (Robots{0, 2}));
  EXPECT_EQ(shared.of(2), (Robots{0, 1}));
  for (RobotIndex i = 0; i < 3; ++i) EXPECT_FALSE(shared.meet(i, i)) << "nobody meets itself";
}

TEST(Neighbourhood, OfARowOfFourAreNotBothEnds) {
  const Neighbourhood overlapped{row(4, 0.5)};
  EXPECT_FALSE(overlapped.meet(0, 3));
  EXPECT_FALSE(overlapped.meet(3, 0));
  EXPECT_EQ(overlapped.of(0), (Robots{1, 2}));
  EXPECT_EQ(overlapped.of(1), (Robots{0, 2, 3}));
  EXPECT_EQ(overlapped.of(3), (Robots{1, 2}));
}

TEST(Neighbourhood, AroundARobotAreItsNeighboursAndTheirs) {
  const Neighbourhood overlapped{row(8, 0.5)};
  EXPECT_EQ(overlapped.around(0), (Robots{0, 1, 2, 3, 4}));
  EXPECT_EQ(overlapped.around(3), (Robots{0, 1, 2, 3, 4, 5, 6, 7}));
  EXPECT_TRUE(overlapped.near(0, 4));
  EXPECT_TRUE(overlapped.near(0, 0));
  EXPECT_FALSE(overlapped.near(0, 5));
}

TEST(Neighbourhood, CountsTheMargin) {
  // The arm reaches 260 + 270 + 90 mm and its hand's radius of 48 mm from the shoulder.
  const double touch = 2 * 0.668;
  EXPECT_TRUE(Neighbourhood{row(2, touch - 1e-6)}.meet(0, 1));
  EXPECT_FALSE(Neighbourhood{row(2, touch + 1e-6)}.meet(0, 1));
  model::Cell careful = row(2, touch + 0.009);
  careful.planning.margin = 0.010;
  EXPECT_TRUE(Neighbourhood{careful}.meet(0, 1));
  careful.planning.margin = 0.008;
  EXPECT_FALSE(Neighbourhood{careful}.meet(0, 1));
}

TEST(Neighbourhood, OfACellWithOneRobotIsEmpty) {
  EXPECT_TRUE(Neighbourhood{row(1, 0.5)}.of(0).empty());
}

/// 400 pairs of random arms just outside each other's reach, 50 pairs of postures each, half of them stretched towards the other:
/// FCL's clearance is above the margin, without any tolerance.
TEST(Neighbourhood, PairsSaidNotToMeetStayApartInEveryPosture) {
  Seed seed{21};
  const std::size_t pairs = std::max<std::size_t>(scaled(400), 40);
  for (std::size_t i = 0; i < pairs; ++i) {
    model::Cell cell;
    cell.planning.margin = seed.uniform(0, 0.05);
    cell.robots.push_back(robot_at("a", random_arm(seed), random_point(seed, 0.5), seed.uniform(-kPi, kPi)));
    cell.robots.push_back(robot_at("b", random_arm(seed), {0, 0, 0}, seed.uniform(-kPi, kPi)));
    const auto a = core::reachable_volume(cell.robots[0]);
    const auto b = core::reachable_volume(cell.robots[1]);
    const model::Vector3 away = random_rotation(seed) * model::Vector3::UnitX();
    cell.robots[1].X_WB.translation() += a.centre - b.centre + (a.radius + b.radius + cell.planning.margin + 1e-6) * away;
    const Neighbourhood neighbourhood{cell};
    ASSERT_FALSE(neighbourhood.meet(0, 1)) << "pair " << i;
    for (int k = 0; k < 50; ++k) {
      std::array<std::vector<core::Body>, 2> bodies;
      for (std::size_t r = 0; r < 2; ++r) {
        const model::Robot& robot = cell.robots[r];
        const double towards = r == 0 ? 1 : -1;
        model::Joints q = random_joints(seed, robot.model);
        std::vector<model::Capsule> capsules;
        for (int trial = 0; trial < (k % 2 == 0 ? 1 : 20); ++trial) {  // the posture that comes nearest of twenty
          const model::Joints other = random_joints(seed, robot.model);
          const auto ahead = [&](const model::Joints& at) {
            model::place_capsules(robot.model, robot.X_WB, at, capsules);
            double most = -1e9;
            for (const auto& c : capsules) most = std::max(most, towards * std::max(c.a.dot(away), c.b.dot(away)) + c.radius);
            return most;
          };
          if (ahead(other) > ahead(q)) q = other;
        }
        model::place_capsules(robot.model, robot.X_WB, q, capsules);
        for (const auto& c : capsules) bodies[r].emplace_back(c);
      }
      for (const auto& x : bodies[0]) {
        for (const auto& y : bodies[1]) ASSERT_GT(core::clearance(x, y), cell.planning.margin) << "pair " << i << ", postures " << k;
      }
    }
  }
}

}  // namespace
}  // namespace interlace::test
