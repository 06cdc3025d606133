#include "planner/core/pair_rest.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/support/seed.hpp"

/// What two robots need together for all they have before them.
namespace interlace::test {
namespace {

using core::PairRest;

constexpr double kForever = std::numeric_limits<double>::infinity();

/// A side whose motions nobody forbids, beside one with `others` motions.
PairRest::Side free_side(std::vector<double> takes, std::size_t others) {
  PairRest::Side side;
  side.forbidden.assign(takes.size() - 1, std::vector<PairRest::Forbidden>(others));
  side.takes = std::move(takes);
  return side;
}

TEST(PairRest, TwoThatNeverMeetNeedWhatTheLongerOneNeeds) {
  const PairRest rest(free_side({0, 2, 3}, 2), free_side({2, 4}, 3));
  EXPECT_NEAR(rest(0, 0, 0), 5, 1e-6);
  EXPECT_NEAR(rest(0, 0, 2), 6, 1e-6) << "b is free 2 s later and needs 4";
  EXPECT_NEAR(rest(2, 0, -1.5), 4, 1e-6) << "a is done in 1.5 s, b needs 4 from now";
  EXPECT_NEAR(rest(2, 1, 0), 0, 1e-6);
}

TEST(PairRest, TwoThatNeedTheSameRoomNeedItOneAfterTheOther) {
  // Each one's motion of 3 s may start no less than 3 s after the other's.
  PairRest::Side a = free_side({0, 3}, 2), b = free_side({3, 3}, 2);
  a.forbidden[0][1] = {{-3, 3}};
  b.forbidden[0][1] = {{-3, 3}};
  const PairRest rest(a, b);
  EXPECT_NEAR(rest(0, 0, 0), 6, 1e-6);
  EXPECT_NEAR(rest(0, 0, 3), 6, 1e-6) << "b comes when a has gone";
  EXPECT_NEAR(rest(1, 0, -3), 6, 0.2) << "a has just set out: b has to wait for it";
}

TEST(PairRest, WhoIsBlockedForGoodWaitsForTheOtherToMoveOn) {
  // Where b stands first a cannot pass; where b stands then it can.
  PairRest::Side a = free_side({0, 2}, 2);
  a.forbidden[0][0] = {{-kForever, kForever}};
  a.forbidden[0][1] = {{-kForever, 1}};
  const PairRest rest(a, free_side({0, 4}, 2));
  EXPECT_NEAR(rest(0, 0, 0), 4, 1e-6) << "b goes first and a 1 s after it";
}

TEST(PairRest, WhereNobodyCanGoItIsLongerThanAnyoneNeedsButFinite) {
  PairRest::Side a = free_side({0, 2}, 2), b = free_side({0, 2}, 2);
  for (PairRest::Side* side : {&a, &b}) side->forbidden[0][0] = {{-kForever, kForever}};
  const PairRest rest(a, b);
  EXPECT_GT(rest(0, 0, 0), 2);
  EXPECT_TRUE(std::isfinite(rest(0, 0, 0)));
}

/// The same found forwards, each order tried.
double by_trying(const PairRest::Side& a, const PairRest::Side& b, std::size_t done_a, std::size_t done_b, double start_a, double start_b,
                 double last) {
  const double free_a = start_a + a.takes[done_a], free_b = start_b + b.takes[done_b];
  double best = done_a + 1 == a.takes.size() && done_b + 1 == b.takes.size() ? std::max(free_a, free_b) : kForever;
  const auto next = [](double free, double from, const PairRest::Forbidden& forbidden, double other) {
    double start = std::max(free, from);
    for (const auto& [f, u] : forbidden) {
      if (other + f <= start && start < other + u) start = other + u;
    }
    return start;
  };
  if (done_a + 1 < a.takes.size()) {
    const double start = next(free_a, last, a.forbidden[done_a][done_b], start_b);
    if (std::isfinite(start)) best = std::min(best, by_trying(a, b, done_a + 1, done_b, start, start_b, start));
  }
  if (done_b + 1 < b.takes.size()) {
    const double start = next(free_b, last, b.forbidden[done_b][done_a], start_a);
    if (std::isfinite(start)) best = std::min(best, by_trying(a, b, done_a, done_b + 1, start_a, start, start));
  }
  return best;
}

TEST(PairRest, IsAsLongAsTheBestOfAllOrders) {
  constexpr double kTolerance = 0.5;  // [s] delays are rounded to steps of 0.2 s, a few times one after the other
  Seed seed;
  const auto takes = [&] { return seed.uniform(1, 4); };
  const auto part = [&] { return seed.uniform(0, 1); };
  for (int trial = 0; trial < 200; ++trial) {
    PairRest::Side a = free_side({0, takes(), takes(), takes(), takes()}, 5);
    PairRest::Side b = free_side({0, takes(), takes(), takes(), takes()}, 5);
    for (PairRest::Side* side : {&a, &b}) {
      const PairRest::Side& other = side == &a ? b : a;
      for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t k = 1; k < 5; ++k) {
          if (part() < 0.5) side->forbidden[i][k] = {{-part() * side->takes[i + 1], part() * other.takes[k]}};
        }
      }
    }
    const PairRest rest(a, b);
    EXPECT_NEAR(rest(0, 0, 0), by_trying(a, b, 0, 0, 0, 0, 0), kTolerance) << "trial " << trial;
  }
}

}  // namespace
}  // namespace interlace::test
