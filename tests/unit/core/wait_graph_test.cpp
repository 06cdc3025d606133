#include "planner/core/wait_graph.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <map>
#include <set>
#include <vector>

#include "tests/support/seed.hpp"

/// Who waits for whom, and who is worth waiting for.
namespace interlace::test {
namespace {

using core::WaitGraph;
using core::WaitNode;
using model::RobotIndex;
using Robots = std::vector<RobotIndex>;

WaitNode moves() {
  return {WaitNode::State::moves, {}};
}
WaitNode idle() {
  return {WaitNode::State::idle, {}};
}
WaitNode unknown() {
  return {WaitNode::State::unknown, {}};
}
WaitNode waits_for(Robots blockers) {
  return {WaitNode::State::waits, std::move(blockers)};
}

TEST(WaitGraph, WhoMovesMovesAndWhoStandsIdleDoesNot) {
  const WaitGraph graph{{moves(), idle(), unknown()}};
  EXPECT_TRUE(graph.moves_by_itself(0));
  EXPECT_FALSE(graph.moves_by_itself(1));
  EXPECT_FALSE(graph.moves_by_itself(2)) << "nobody can say what it will do";
  for (RobotIndex r = 0; r < 3; ++r) {
    EXPECT_FALSE(graph.deadlocked(r)) << r << " waits for nobody";
    EXPECT_TRUE(graph.circle(r).empty());
  }
}

TEST(WaitGraph, AChainMovesWhenItsEndDoes) {
  for (const bool end_moves : {true, false}) {
    const WaitGraph graph{{waits_for({1}), waits_for({2}), waits_for({3}), end_moves ? moves() : idle()}};
    for (RobotIndex r = 0; r < 3; ++r) {
      EXPECT_EQ(graph.moves_by_itself(r), end_moves) << r;
      EXPECT_EQ(graph.deadlocked(r), !end_moves) << r;
    }
  }
}

TEST(WaitGraph, ARobotThatIsNotHeardFromIsNotWaitedFor) {
  const WaitGraph graph{{waits_for({1}), unknown()}};
  EXPECT_FALSE(graph.moves_by_itself(0));
  EXPECT_TRUE(graph.deadlocked(0));
}

TEST(WaitGraph, AllBlockersMustMoveForARobotToMove) {
  const WaitGraph graph{{waits_for({1, 2}), moves(), idle()}};
  EXPECT_FALSE(graph.moves_by_itself(0));
  EXPECT_FALSE(graph.deadlocked(0)) << "one of the two still moves: what is in the way changes by itself";
}

TEST(WaitGraph, ADiamondIsNoCircle) {
  // 3 is asked twice, through 1 and through 2: the second time its answer must not count as "still being asked".
  for (const bool end_moves : {true, false}) {
    const WaitGraph graph{{waits_for({1, 2}), waits_for({3}), waits_for({3}), waits_for({4}), end_moves ? moves() : idle()}};
    for (RobotIndex r = 0; r < 4; ++r) {
      EXPECT_EQ(graph.moves_by_itself(r), end_moves) << r;
      EXPECT_TRUE(graph.circle(r).empty()) << r;
    }
  }
}

TEST(WaitGraph, NobodyInACircleMoves) {
  const WaitGraph graph{{waits_for({1}), waits_for({2}), waits_for({0}), waits_for({0}), moves()}};
  for (RobotIndex r = 0; r < 4; ++r) {
    EXPECT_FALSE(graph.moves_by_itself(r)) << r;
    EXPECT_TRUE(graph.deadlocked(r)) << r;
  }
  EXPECT_EQ(graph.circle(0), (Robots{0, 1, 2}));
  EXPECT_EQ(graph.circle(1), (Robots{1, 2, 0}));
  EXPECT_EQ(graph.circle(2), (Robots{2, 0, 1}));
  EXPECT_TRUE(graph.circle(3).empty()) << "it waits for the circle and is not part of it";
}

TEST(WaitGraph, AMovingRobotDoesNotOpenACircleItIsNotPartOf) {
  // 0 and 1 keep each other; that 2 moves helps neither, but is a reason not to send anybody away yet.
  const WaitGraph graph{{waits_for({1, 2}), waits_for({0}), moves()}};
  EXPECT_FALSE(graph.moves_by_itself(0));
  EXPECT_FALSE(graph.moves_by_itself(1));
  EXPECT_FALSE(graph.deadlocked(0));
  EXPECT_TRUE(graph.deadlocked(1));
}

TEST(WaitGraph, ACircleIsAShortestOne) {
  // From 0: by 1, 2, 3 and by 4; the shorter one although the longer is named first.
  const WaitGraph graph{{waits_for({1, 4}), waits_for({2}), waits_for({3}), waits_for({0}), waits_for({0})}};
  EXPECT_EQ(graph.circle(0), (Robots{0, 4}));
  EXPECT_EQ(graph.circle(4), (Robots{4, 0}));
  EXPECT_EQ(graph.circle(2), (Robots{2, 3, 0, 1}));
}

TEST(WaitGraph, WhoWaitsForNobodyInParticularIsNotDeadlocked) {
  const WaitGraph graph{{waits_for({})}};
  EXPECT_FALSE(graph.deadlocked(0)) << "its own robot is not ready: sending others away would not help";
  EXPECT_FALSE(graph.moves_by_itself(0));
}

/// What the graph must say, by repetition until nothing changes: no recursion, no order of asking.
std::vector<bool> who_moves(const std::vector<WaitNode>& nodes) {
  std::vector<bool> yes(nodes.size(), false);
  for (std::size_t round = 0; round <= nodes.size(); ++round) {
    for (std::size_t r = 0; r < nodes.size(); ++r) {
      const auto& n = nodes[r];
      yes[r] =
          n.state == WaitNode::State::moves || (n.state == WaitNode::State::waits && !n.blockers.empty() &&
                                                std::all_of(n.blockers.begin(), n.blockers.end(), [&](RobotIndex b) { return yes[b]; }));
    }
  }
  return yes;
}

/// Length of a shortest circle through `robot` by all walks of growing length; 0 when there is none.
std::size_t shortest_circle(const std::vector<WaitNode>& nodes, RobotIndex robot) {
  std::set<RobotIndex> at{robot};
  for (std::size_t length = 1; length <= nodes.size(); ++length) {
    std::set<RobotIndex> next;
    for (const RobotIndex r : at) {
      if (nodes[r].state == WaitNode::State::waits) next.insert(nodes[r].blockers.begin(), nodes[r].blockers.end());
    }
    if (next.count(robot) > 0) return length;
    at = std::move(next);
  }
  return 0;
}

TEST(WaitGraph, RandomGraphsAgreeWithAnswersFoundByRepetition) {
  Seed seed{31};
  std::map<std::size_t, int> circles;
  int moving_waiters = 0;
  for (std::size_t trial = 0; trial < scaled(20000); ++trial) {
    std::vector<WaitNode> nodes(2 + seed.below(7));
    for (RobotIndex r = 0; r < nodes.size(); ++r) {
      constexpr std::array states{WaitNode::State::moves, WaitNode::State::idle, WaitNode::State::unknown};
      nodes[r].state = seed.chance(0.7) ? WaitNode::State::waits : states[seed.below(3)];
      if (nodes[r].state != WaitNode::State::waits) continue;
      for (RobotIndex b = 0; b < nodes.size(); ++b) {
        if (b != r && seed.chance(0.3)) nodes[r].blockers.push_back(b);
      }
    }
    const WaitGraph graph{nodes};
    const auto moving = who_moves(nodes);
    for (RobotIndex r = 0; r < nodes.size(); ++r) {
      const bool waits = nodes[r].state == WaitNode::State::waits;
      const auto& blockers = nodes[r].blockers;
      ASSERT_EQ(graph.moves_by_itself(r), moving[r]) << "trial " << trial << ", robot " << r;
      ASSERT_EQ(graph.deadlocked(r),
                waits && !blockers.empty() && std::none_of(blockers.begin(), blockers.end(), [&](RobotIndex b) { return moving[b]; }))
          << "trial " << trial << ", robot " << r;
      const auto circle = graph.circle(r);
      ASSERT_EQ(circle.size(), shortest_circle(nodes, r)) << "trial " << trial << ", robot " << r;
      for (std::size_t i = 0; i < circle.size(); ++i) {
        const auto& next = nodes[circle[i]].blockers;
        ASSERT_TRUE(std::count(next.begin(), next.end(), circle[(i + 1) % circle.size()])) << "trial " << trial << ", robot " << r;
      }
      if (!circle.empty()) {
        ASSERT_EQ(circle.front(), r);
      }
      moving_waiters += waits && moving[r] ? 1 : 0;
      ++circles[circle.size()];
    }
  }
  EXPECT_GT(moving_waiters, 0);
  EXPECT_GT(circles[4], 0) << "the random graphs must hold longer circles too";
}

}  // namespace
}  // namespace interlace::test
