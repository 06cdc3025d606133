#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include "common/model/segment_distance.hpp"
#include "tests/model/scenarios.hpp"
#include "tests/model/walker.hpp"

/// Small scenarios walked through every order of their events against the real planner: robots never touch, and nothing ever stays undone.
namespace interlace::test {
namespace {

using namespace std::chrono_literals;

double least_clearance(const model::Robot& a, const model::Joints& qa, const model::Robot& b, const model::Joints& qb) {
  std::vector<model::Capsule> of_a, of_b;
  model::place_capsules(a.model, a.X_WB, qa, of_a);
  model::place_capsules(b.model, b.X_WB, qb, of_b);
  double least = std::numeric_limits<double>::infinity();
  for (const auto& c : of_a) {
    for (const auto& d : of_b) least = std::min(least, model::segment_distance(c.a, c.b, d.a, d.b) - c.radius - d.radius);
  }
  return least;
}

/// Least clearance of a motion from a robot that stands at `q`, every 10 ms.
double least_clearance(const model::Motion& motion, const model::Robot& other, const model::Joints& q) {
  double least = std::numeric_limits<double>::infinity();
  for (double t = 0; t < motion.duration() + 0.01; t += 0.01) {
    least = std::min(least, least_clearance(motion.robot(), motion.joints(t), other, q));
  }
  return least;
}

/// Who stands in whose way at the start, as "1<3": robot 3 in that of the first order of robot 1. Fails the test when an order would not be
/// clear with all others at home: no planner can promise to serve that.
std::set<std::string> in_the_way(const Scenario& scenario) {
  const auto& robots = scenario.cell->robots;
  std::set<std::string> result;
  std::vector<model::Joints> stands;
  for (const auto& r : robots) stands.push_back(r.start);
  std::set<model::RobotIndex> first;
  for (const Order& o : scenario.orders) {
    const model::Motion motion = model::plan_motion(robots[o.robot], stands[o.robot], o.motion).value();
    stands[o.robot] = motion.to();
    const bool is_first = first.insert(o.robot).second;
    for (model::RobotIndex other = 0; other < robots.size(); ++other) {
      if (other == o.robot) continue;
      EXPECT_GT(least_clearance(motion, robots[other], robots[other].home), 0.001) << o.id << " is not well-formed";
      if (is_first && least_clearance(motion, robots[other], robots[other].start) <= 0) {
        result.insert(std::to_string(o.robot + 1) + "<" + std::to_string(other + 1));
      }
    }
  }
  return result;
}

/// More than any of these scenarios has; with INTERLACE_PROPERTY_SCALE=0.01 a walk ends before it is whole.
constexpr std::size_t kMostStates = 200'000;

/// What a walk must at least have seen, so that it cannot become empty unnoticed.
struct AtLeast {
  std::size_t states = 0, branches = 0, depth = 0;
  std::size_t escapes = 1;  ///< carried out in one branch
};

std::size_t limit() {
  return scaled(kMostStates);
}

Walk expect_sound(const Scenario& scenario, const AtLeast& expected) {
  Walker walker{scenario, limit()};
  Walk walk = walker.walk();
  std::printf("%zu states, %zu branches, depth %zu, %.3g interleavings with %zu ends; least clearance %.4f m\n", walk.states, walk.branches,
              walk.depth, walk.interleavings, walk.ends, walk.least);
  EXPECT_EQ(walk.fault, "");
  for (std::size_t i = 0; i < walk.samples.size(); ++i) {
    EXPECT_EQ(walker.replay(walk.samples[i]).signature(), walk.sample_ends[i]) << "a copy of the planner is not the planner";
  }
  if (limit() < kMostStates) return walk;
  EXPECT_TRUE(walk.whole);
  EXPECT_GE(walk.states, expected.states);
  EXPECT_GE(walk.branches, expected.branches);
  EXPECT_GE(walk.depth, expected.depth);
  EXPECT_GE(walk.most_escapes, expected.escapes);
  return walk;
}

TEST(Interleavings, OfTwoWhoWantOnePlace) {
  expect_sound(idle_blocker(), {500, 250, 25});
}

TEST(Interleavings, OfTwoWhoWantOnePlaceAndOneRefuses) {
  Scenario s = idle_blocker();
  s.liberties.refusal = true;
  expect_sound(s, {1800, 1000, 30});
}

TEST(Interleavings, OfTwoWhoWantOnePlaceAndOneIsCancelled) {
  Scenario s = idle_blocker();
  s.liberties.cancelled = "b1";
  expect_sound(s, {1200, 900, 25});
}

TEST(Interleavings, OfTwoWhoComeAndGo) {
  const Walk walk = expect_sound(there_and_back(), {7000, 7000, 40});
  EXPECT_TRUE(walk.delays > 0 || !walk.whole);
}

TEST(Interleavings, OfTwoWhoComeAndGoAndOneRefuses) {
  Scenario s = there_and_back();
  s.liberties.refusal = true;
  expect_sound(s, {30'000, 35'000, 45});
}

TEST(Interleavings, OfTwoWhoComeAndGoWhileACommandIsCancelled) {
  for (const char* cancelled : {"a1", "a2"}) {
    Scenario s = there_and_back();
    s.liberties.cancelled = cancelled;
    const Walk walk = expect_sound(s, {15'000, 20'000, 40});
    EXPECT_TRUE(walk.cancels > 0 || !walk.whole);
  }
}

TEST(Interleavings, OfTwoWhoSwapPlaces) {
  Scenario s = swapped_places();
  s.liberties.refusal = true;
  expect_sound(s, {4000, 3000, 35});
}

TEST(Interleavings, OfTwoOfWhomOneFallsSilent) {
  Scenario s = idle_blocker();
  s.options.posture_timeout = 400ms;
  s.liberties.silent = 0;
  expect_sound(s, {15'000, 13'000, 40});
}

TEST(Interleavings, OfThreeInAChain) {
  const Scenario s = chain();
  EXPECT_EQ(in_the_way(s), (std::set<std::string>{"1<3", "3<2"}));
  expect_sound(s, {100'000, 80'000, 55, 2});
}

TEST(Interleavings, OfThreeOfWhomTwoStandInTheWay) {
  const Scenario s = two_blockers();
  EXPECT_EQ(in_the_way(s), (std::set<std::string>{"1<3", "2<1", "2<3"}));
  expect_sound(s, {60'000, 50'000, 50, 2});
}

TEST(Interleavings, OfThreeInACircle) {
  const Scenario s = circle_of_three();
  EXPECT_EQ(in_the_way(s), (std::set<std::string>{"1<2", "2<3", "3<1"}));
  expect_sound(s, {75'000, 55'000, 50, 2});
}

TEST(Interleavings, OfThreeOfWhomOneCanLeaveOnlyAfterAnother) {
  Scenario s = cascade();
  EXPECT_EQ(in_the_way(s), (std::set<std::string>{"1<2", "2<3", "3<2"}));
  expect_sound(s, {65'000, 50'000, 55});
  s.orders.resize(1);  // with nothing else to do, somebody must go for r1
  expect_sound(s, {100, 50, 15});
}

TEST(Interleavings, OfThreeInAChainAndOneRefuses) {
  Scenario s = chain();
  s.liberties.late_starts = false;
  s.liberties.late_reports = false;
  s.liberties.refusal = true;
  expect_sound(s, {8000, 3000, 50, 2});
}

TEST(Interleavings, OfThreeInACircleWhileACommandIsCancelled) {
  Scenario s = circle_of_three();
  s.liberties.late_starts = false;
  s.liberties.late_reports = false;
  s.liberties.cancelled = "b1";
  expect_sound(s, {3000, 2000, 45, 2});
}

TEST(AWalk, FindsTheCollisionOfAPlannerThatLooksAtNothing) {
  Scenario s = idle_blocker();
  s.options.strategy = "direct";
  const Walk walk = Walker{s, kMostStates}.walk();
  EXPECT_NE(walk.fault.find("r1 and r2 touch, after:"), std::string::npos) << walk.fault;
}

TEST(AWalk, FindsTheCommandOfAPlannerThatSendsNobodyAway) {
  Scenario s = idle_blocker();
  s.options.escapes = false;
  const Walk walk = Walker{s, kMostStates}.walk();
  EXPECT_NE(walk.fault.find("nothing moves and"), std::string::npos) << walk.fault;
}

}  // namespace
}  // namespace interlace::test
