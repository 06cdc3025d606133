#include "common/model/time_law.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "tests/support/seed.hpp"

namespace interlace::test {
namespace {

using model::TimeLaw;

constexpr std::size_t kLaws = 20000;
constexpr std::size_t kSteps = 200;

/// The least time from rest to rest over a distance under both limits.
double shortest(double distance, double velocity, double acceleration) {
  return distance < velocity * velocity / acceleration ? 2 * std::sqrt(distance / acceleration)
                                                       : distance / velocity + velocity / acceleration;
}

double random_magnitude(Seed& seed, double low, double high) {
  return std::pow(10.0, seed.uniform(low, high));
}

TEST(TimeLaw, IsMonotoneExactAtItsEndsAndWithinItsLimits) {
  Seed seed{31};
  for (std::size_t k = 0; k < scaled(kLaws) && !HasFailure(); ++k) {
    const double distance = random_magnitude(seed, -6, 1);
    const double velocity = random_magnitude(seed, -3, 1);
    const double acceleration = random_magnitude(seed, -3, 2);
    TimeLaw law{distance, velocity, acceleration};
    SCOPED_TRACE(::testing::Message() << distance << " at " << velocity << ", " << acceleration);
    EXPECT_NEAR(law.duration(), shortest(distance, velocity, acceleration), 1e-12 * law.duration());
    double factor = 1;
    if (k % 2 == 1) {
      factor = seed.uniform(1, 5);
      law = law.stretched_to(law.duration() * factor);
    }
    EXPECT_EQ(law.at(0), 0);
    EXPECT_EQ(law.at(law.duration()), distance);
    EXPECT_EQ(law.at(-1), 0);
    EXPECT_EQ(law.at(law.duration() + 1), distance);
    const double step = law.duration() / kSteps;
    const double slack = 1e-12 * distance;
    double before = 0;
    for (std::size_t i = 1; i <= kSteps; ++i) {
      const double t = step * static_cast<double>(i);
      const double now = law.at(t);
      EXPECT_GE(now, before - slack);
      EXPECT_LE(now - before, velocity / factor * step * (1 + 1e-9) + slack);
      EXPECT_LE(law.speed(t), velocity / factor * (1 + 1e-9));
      // Differences of the speed see the acceleration; the jump to rest after the last step belongs to no ramp.
      EXPECT_LE(std::abs(law.speed(t) - law.speed(t - step)), acceleration / (factor * factor) * step * (1 + 1e-6) + 1e-12 * velocity);
      before = now;
    }
    // The travelled distance is the integral of the speed; both are piecewise smooth, so the trapezoid rule errs by less than a step's
    // ramp.
    double area = 0;
    for (std::size_t i = 0; i < kSteps; ++i)
      area += (law.speed(step * static_cast<double>(i)) + law.speed(step * static_cast<double>(i + 1))) / 2 * step;
    EXPECT_NEAR(area, distance, acceleration / (factor * factor) * step * step + slack);
  }
}

TEST(TimeLaw, RefusesWhatNoRobotCanDo) {
  EXPECT_THROW((TimeLaw{-1, 1, 1}), std::invalid_argument);
  EXPECT_THROW((TimeLaw{1, 0, 1}), std::invalid_argument);
  EXPECT_THROW((TimeLaw{1, 1, 0}), std::invalid_argument);
  EXPECT_THROW((TimeLaw{std::nan(""), 1, 1}), std::invalid_argument);
  EXPECT_THROW((void)(TimeLaw{1, 1, 1}.stretched_to(1)), std::invalid_argument);
}

TEST(TimeLaw, OfNoDistanceStays) {
  const TimeLaw still = TimeLaw{0, 1, 1}.stretched_to(2);
  EXPECT_EQ(still.duration(), 2);
  EXPECT_EQ(still.at(1), 0);
  EXPECT_EQ(still.speed(1), 0);
}

}  // namespace
}  // namespace interlace::test
