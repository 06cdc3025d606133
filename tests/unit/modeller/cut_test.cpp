#include "modeller/cut.hpp"

#include <gtest/gtest.h>

#include "tests/support/arms.hpp"
#include "tests/support/seed.hpp"
#include "tests/support/shapes.hpp"

namespace interlace::test {
namespace {

double area(const Mesh& m) {
  double sum = 0;
  for (const auto& t : m.triangles) {
    sum += (m.vertices[t[1]] - m.vertices[t[0]]).cross(m.vertices[t[2]] - m.vertices[t[0]]).norm() / 2;
  }
  return sum;
}

TEST(Cut, LeavesTheWholeSurfaceEachPartOnItsSide) {
  Seed seed{41};
  constexpr double kRounding = 1e-12;  // [m], share of the area
  for (int i = 0; i < 200; ++i) {
    const Mesh whole = moved(seed.chance(0.5) ? bent_pipe(0.2, 0.05, 2.0, 12, 8) : box({0.3, 0.1, 0.2}),
                             model::make_pose(random_point(seed, 0.5), random_rotation(seed)));
    const Vector3 n = random_point(seed, 1).normalized();
    const double offset = n.dot(whole.vertices[seed.below(whole.vertices.size())]) + (seed.chance(0.3) ? 0.0 : seed.uniform(-0.1, 0.1));
    const auto [below, above] = modeller::cut(whole, n, offset);
    EXPECT_NEAR(area(below) + area(above), area(whole), kRounding * area(whole)) << "seed " << seed.value() << ", cut " << i;
    for (const Vector3& p : below.vertices) EXPECT_LE(n.dot(p), offset + kRounding);
    for (const Vector3& p : above.vertices) EXPECT_GE(n.dot(p), offset - kRounding);
  }
}

TEST(Cut, MissesWhatIsOnOneSide) {
  const Mesh whole = box({1, 1, 1});
  const auto [below, above] = modeller::cut(whole, Vector3::UnitZ(), 0.5);
  EXPECT_EQ(below.triangles.size(), whole.triangles.size()) << "a face in the plane stays with its body";
  EXPECT_EQ(below.vertices.size(), whole.vertices.size());
  EXPECT_TRUE(above.triangles.empty() && above.vertices.empty());
}

}  // namespace
}  // namespace interlace::test
