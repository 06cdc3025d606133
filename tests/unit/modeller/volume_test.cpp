#include "modeller/volume.hpp"

#include <gtest/gtest.h>

#include "modeller/hull.hpp"
#include "tests/support/shapes.hpp"

namespace interlace::test {
namespace {

using model::Capsule;
using model::kPi;
using modeller::enclosed_volume;
using modeller::hull_of;
using modeller::union_volume;
using modeller::volume_of;

constexpr double kRounding = 1e-12;  // share
constexpr double kMidpoint = 1e-3;   // share; of the rule in union_volume

/// Volume of a prism of `n` sides inscribed in a circle.
double prism(double radius, double height, int n) {
  return n * radius * radius * std::sin(2 * kPi / n) / 2 * height;
}

TEST(EnclosedVolume, IsThatOfTheShape) {
  EXPECT_NEAR(enclosed_volume(box({0.1, 0.2, 0.3})).value(), 0.006, 0.006 * kRounding);
  EXPECT_NEAR(enclosed_volume(cylinder(0.05, 0.4, 24)).value(), prism(0.05, 0.4, 24), 1e-2 * kRounding);
  const double torus = 2 * kPi * 0.2 * kPi * 0.03 * 0.03;
  EXPECT_NEAR(enclosed_volume(bent_pipe(0.2, 0.03, 2 * kPi, 200, 100)).value(), torus, 2e-3 * torus) << "of 200 × 100 facets";
  Mesh inside_out = box({1, 1, 1});
  for (auto& t : inside_out.triangles) std::swap(t[0], t[1]);
  EXPECT_NEAR(enclosed_volume(inside_out).value(), 1, kRounding);
}

TEST(EnclosedVolume, NeedsAClosedSurfaceThatKnowsItsOutside) {
  Mesh open = box({1, 1, 1});
  open.triangles.pop_back();
  EXPECT_FALSE(enclosed_volume(open));
  Mesh twisted = box({1, 1, 1});
  std::swap(twisted.triangles[5][0], twisted.triangles[5][1]);
  EXPECT_FALSE(enclosed_volume(twisted));
  Mesh sliver = box({1, 1, 1});
  sliver.triangles.emplace_back(0, 1, 1);
  EXPECT_TRUE(enclosed_volume(sliver)) << "what has no area closes nothing and opens nothing";
}

TEST(Hull, IsConvexAndThickerThanAPlane) {
  const Mesh pipe = bent_pipe(0.2, 0.03, kPi / 2);
  const auto hull = hull_of(pipe.vertices);
  ASSERT_TRUE(hull);
  EXPECT_GT(hull->volume, enclosed_volume(pipe).value());
  EXPECT_LT(hull->corners.size(), pipe.vertices.size());
  EXPECT_NEAR(hull_of(box({0.1, 0.2, 0.3}).vertices)->volume, 0.006, 0.006 * kRounding);
  EXPECT_FALSE(hull_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 0}}));
  EXPECT_FALSE(hull_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 1}}));
}

TEST(UnionVolume, AgreesWithTheClosedFormWhereThereIsOne) {
  const Capsule a{{0, 0, 0}, {0.1, 0.2, -0.3}, 0.07};
  EXPECT_DOUBLE_EQ(volume_of({{0, 0, 0}, {0, 0, 0}, 1}), 4 * kPi / 3);
  EXPECT_DOUBLE_EQ(union_volume({a}), volume_of(a));
  EXPECT_NEAR(union_volume({a, a}), volume_of(a), kMidpoint * volume_of(a)) << "twice the same";
  for (const Vector3& axis : {Vector3{0.3, 0, 0}, Vector3{0, 0.3, 0}, Vector3{0, 0, 0.3}, Vector3{0, 0.2, 0.2}, Vector3{0, 0, 0}}) {
    const Capsule b{{1, 1, 1}, Vector3{1, 1, 1} + axis, 0.1};
    const double sum = volume_of(a) + volume_of(b);
    EXPECT_NEAR(union_volume({a, b}), sum, 5 * kMidpoint * sum) << "apart, so small against their bounds; axis " << axis.transpose();
  }
}

TEST(UnionVolume, CountsAnOverlapOnce) {
  // Two collinear capsules that share half their length are one longer capsule.
  const Capsule whole{{0, 0, 0}, {0.1, 0.1, 0.3}, 0.05};
  const Capsule low{whole.a, whole.a + 0.7 * (whole.b - whole.a), 0.05};
  const Capsule high{whole.a + 0.3 * (whole.b - whole.a), whole.b, 0.05};
  EXPECT_NEAR(union_volume({low, high}), volume_of(whole), kMidpoint * volume_of(whole));
}

}  // namespace
}  // namespace interlace::test
