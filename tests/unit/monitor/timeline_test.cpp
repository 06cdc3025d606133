#include "monitor/timeline.hpp"

#include <gtest/gtest.h>

namespace interlace::monitor {
namespace {

using namespace std::chrono_literals;
using model::at_seconds;

const Timeline::LocalTime kOrigin{1h};

TEST(Timeline, KeepsTheDistancesOfPlannerTimeWhateverTheTransportDoes) {
  Timeline line{kOrigin};
  EXPECT_NEAR(line.place(7, at_seconds(100), kOrigin + 2s), 2, 1e-9);
  EXPECT_NEAR(line.place(7, at_seconds(100.010), kOrigin + 2500ms), 2.010, 1e-9) << "late, but not moved";
  EXPECT_NEAR(line.place(7, at_seconds(99.995), kOrigin + 2501ms), 1.995, 1e-9);
}

TEST(Timeline, GoesOnWhenAnotherPlannerStartsItsTimeAtZero) {
  Timeline line{kOrigin};
  EXPECT_NEAR(line.place(7, at_seconds(100), kOrigin + 2s), 2, 1e-9);
  EXPECT_NEAR(line.place(8, at_seconds(0.1), kOrigin + 5s), 5, 1e-9);
  EXPECT_NEAR(line.place(8, at_seconds(1.1), kOrigin + 9s), 6, 1e-9);
}

TEST(Timeline, KnowsTheZeroOfThePlannersItHasHeard) {
  Timeline line{kOrigin};
  EXPECT_FALSE(line.zero_of(7));
  (void)line.place(7, at_seconds(100), kOrigin + 2s);
  EXPECT_NEAR(line.zero_of(7).value(), -98, 1e-9);
}

TEST(Timeline, WithoutAPlannerTheTimeOfReceptionCounts) {
  Timeline line{kOrigin};
  EXPECT_NEAR(line.place(0, at_seconds(77), kOrigin + 3s), 3, 1e-9);
  EXPECT_NEAR(line.place(0, at_seconds(77), kOrigin + 4s), 4, 1e-9);
}

}  // namespace
}  // namespace interlace::monitor
