#include "common/model/time.hpp"

#include <gtest/gtest.h>

namespace interlace::test {
namespace {

using model::Duration;

TEST(Time, SecondsRoundToTheNearestNanosecond) {
  EXPECT_EQ(model::from_seconds(1.5), Duration{1500000000});
  EXPECT_EQ(model::from_seconds(-1.5), Duration{-1500000000});
  EXPECT_EQ(model::from_seconds(1.4e-9), Duration{1});
  EXPECT_EQ(model::from_seconds(-1.4e-9), Duration{-1});
  EXPECT_EQ(model::from_seconds(0.6e-9), Duration{1});
  EXPECT_EQ(model::from_seconds(0), Duration{0});
}

TEST(Time, SecondsComeBack) {
  for (const double s : {0.0, 0.001, 1.25, -3.5, 86400.0}) {
    EXPECT_NEAR(model::to_seconds(model::from_seconds(s)), s, 1e-9);
    EXPECT_NEAR(model::to_seconds(model::at_seconds(s)), s, 1e-9);
  }
}

}  // namespace
}  // namespace interlace::test
