#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <string>

#include "tests/model/scenarios.hpp"
#include "tests/model/walker.hpp"

/// Small scenarios walked through every order of their events against the real planner: robots never touch, and nothing ever stays undone.
namespace interlace::test {
namespace {

using namespace std::chrono_literals;

/// More than any of these scenarios has; fewer with INTERLACE_PROPERTY_SCALE, where a walk ends before it is whole.
constexpr std::size_t kMostStates = 1'000'000;

/// What a walk must at least have seen, so that it cannot become empty unnoticed.
struct AtLeast {
  std::size_t states = 0, branches = 0, depth = 0;
  std::size_t ends = 1;
};

std::size_t limit() {
  return std::max<std::size_t>(200, std::min(kMostStates, scaled(50'000)) == 50'000 ? kMostStates : scaled(50'000));
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
  EXPECT_GE(walk.ends, expected.ends);
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
  expect_sound(there_and_back(), {7000, 7000, 40});
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
    expect_sound(s, {15'000, 20'000, 40});
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
