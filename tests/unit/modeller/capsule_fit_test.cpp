#include "modeller/capsule_fit.hpp"

#include <gtest/gtest.h>

#include "modeller/volume.hpp"
#include "tests/support/arms.hpp"
#include "tests/support/seed.hpp"
#include "tests/support/shapes.hpp"

namespace interlace::test {
namespace {

using model::Capsule;
using modeller::depth_in;
using modeller::Effort;
using modeller::kGrain;
using modeller::tightest_capsule;
using modeller::volume_of;

double least_depth(const Capsule& c, const std::vector<Vector3>& points) {
  double least = 1e9;
  for (const Vector3& p : points) least = std::min(least, depth_in(c, p));
  return least;
}

/// A cloud of one of several kinds, sizes from 1 mm to 1 m.
std::vector<Vector3> random_cloud(Seed& seed) {
  const Vector3 size{std::pow(10, seed.uniform(-3, 0)), std::pow(10, seed.uniform(-3, 0)), std::pow(10, seed.uniform(-3, 0))};
  const model::Pose X = model::make_pose(random_point(seed, 1), random_rotation(seed));
  const std::size_t count = 1 + seed.below(200);
  const std::size_t flat = seed.below(6);  // 0, 1, 2: no extent along that axis
  const bool dots = seed.chance(0.2);      // on a coarse grid, so that many coincide or lie in a line
  std::vector<Vector3> points;
  for (std::size_t i = 0; i < count; ++i) {
    Vector3 p = random_point(seed, 1);
    if (dots) p = p.array().round();
    if (flat < 3) p[static_cast<Eigen::Index>(flat)] = 0;
    points.push_back(X * Vector3{p.array() * size.array()});
  }
  return points;
}

TEST(TightestCapsule, HoldsEveryPointOfAnyCloudAndIsTheSameTwice) {
  Seed seed{42};
  const std::size_t cases = scaled(200);
  for (std::size_t i = 0; i < cases; ++i) {
    const auto points = random_cloud(seed);
    const Capsule c = tightest_capsule(points);
    ASSERT_GT(least_depth(c, points), 0) << "seed " << seed.value() << ", cloud " << i << " of " << points.size() << " points";
    const Capsule again = tightest_capsule(points);
    ASSERT_TRUE(c.a == again.a && c.b == again.b && c.radius == again.radius) << "seed " << seed.value() << ", cloud " << i;
  }
}

TEST(TightestCapsule, IsNoLargerThanSimpleOnes) {
  Seed seed{43};
  const std::size_t cases = scaled(100);
  for (std::size_t i = 0; i < cases; ++i) {
    const auto points = random_cloud(seed);
    const Capsule c = tightest_capsule(points);
    Eigen::AlignedBox3d bounds;
    for (const Vector3& p : points) bounds.extend(p);
    Capsule ball{bounds.center(), bounds.center(), 0};
    ball.radius = std::max(kGrain, -least_depth(ball, points));
    Capsule beam = ball;  // along the longest side of the bounds
    Eigen::Index longest = 0;
    bounds.sizes().maxCoeff(&longest);
    beam.a[longest] = bounds.min()[longest];
    beam.b[longest] = bounds.max()[longest];
    beam.radius = 0;
    beam.radius = std::max(kGrain, -least_depth(beam, points));
    const double rounding = 3 * kGrain / c.radius;  // of ends and radius
    EXPECT_LT(volume_of(c), (1.001 + 3 * rounding) * std::min(volume_of(ball), volume_of(beam)))
        << "seed " << seed.value() << ", cloud " << i << " of " << points.size() << " points";
  }
}

TEST(TightestCapsule, FindsACapsuleAgain) {
  Seed seed{44};
  const std::size_t cases = scaled(20);
  double worst = 0;
  for (std::size_t i = 0; i < cases; ++i) {
    const Capsule hidden{random_point(seed, 0.5), random_point(seed, 0.5), seed.uniform(0.03, 0.3)};
    const Vector3 d = hidden.b - hidden.a;
    const model::Pose X = model::make_pose(hidden.a, model::Quaternion::FromTwoVectors(Vector3::UnitZ(), d));
    std::vector<Vector3> points;
    for (int k = 0; k < 1000; ++k) {  // on its surface: both balls' outer halves and the rings between
      const Vector3 n = random_point(seed, 1).normalized() * hidden.radius;
      points.push_back(X * Vector3{n + Vector3{0, 0, n.z() > 0 ? d.norm() : 0.0}});
    }
    const Capsule found = tightest_capsule(points);
    const double ratio = volume_of(found) / volume_of(hidden);
    worst = std::max(worst, ratio);
    EXPECT_LT(ratio, 1.005) << "seed " << seed.value() << ", case " << i;
  }
  std::printf("volume of the found over that of the hidden capsule, worst: %.5f\n", worst);
}

TEST(TightestCapsule, TakesABallWhereThatIsSmaller) {
  const Capsule cube = tightest_capsule(box({0.1, 0.1, 0.1}).vertices);
  EXPECT_LT(volume_of(cube), volume_of({{0, 0, 0}, {0, 0, 0}, 0.05 * std::sqrt(3.0)}))
      << "a short capsule is better than a ball for a cube";
  const Capsule ring = tightest_capsule(cylinder(0.1, 0.001).vertices);
  EXPECT_LT((ring.b - ring.a).norm(), 0.001);
}

TEST(TightestCapsule, HoldsWhatHasNoVolume) {
  for (const auto& points : std::vector<std::vector<Vector3>>{{{0.1, 0.2, 0.3}},
                                                              {{0.1, 0.2, 0.3}, {0.1, 0.2, 0.3}},
                                                              {{0, 0, 0}, {0.3, 0.1, 0}},
                                                              {{0, 0, 0}, {0.1, 0.1, 0.1}, {0.2, 0.2, 0.2}, {0.3, 0.3, 0.3}},
                                                              {{0, 0, 0}, {0.1, 0, 0}, {0.1, 0.1, 0}, {0, 0.1, 0}}}) {
    const Capsule c = tightest_capsule(points);
    EXPECT_GT(least_depth(c, points), 0);
    EXPECT_GE(c.radius, kGrain);
  }
}

TEST(TightestCapsule, IsWrittenInMicrometres) {
  const Capsule c = tightest_capsule(cylinder(0.0512345, 0.3).vertices);
  for (const double x : {c.a.x(), c.a.z(), c.b.y(), c.b.z(), c.radius}) EXPECT_NEAR(x / kGrain, std::round(x / kGrain), 1e-6);
}

}  // namespace
}  // namespace interlace::test
