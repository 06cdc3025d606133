#include "common/model/triangle_mesh.hpp"

#include <gtest/gtest.h>

#include <set>

#include "tests/support/fixtures.hpp"

namespace interlace::test {
namespace {

using model::TriangleMesh;
using model::Vector3;

TEST(TriangleMesh, NeedsTrianglesWhoseCornersAreThere) {
  EXPECT_THROW(TriangleMesh({}, {}, false), std::invalid_argument);
  EXPECT_THROW(TriangleMesh({Vector3::Zero(), Vector3::UnitX()}, {{0, 1, 2}}, false), std::invalid_argument);
}

TEST(TriangleMesh, TellsWhetherItIsClosed) {
  const auto box = box_mesh({1, 1, 1});
  EXPECT_EQ(box->open_edges(), 0U);
  auto triangles = box->triangles();
  triangles.pop_back();
  EXPECT_EQ(TriangleMesh(box->vertices(), triangles, false).open_edges(), 3U);
  // Corners of their own for each triangle, as STL files have them, change nothing.
  std::vector<Vector3> apart;
  Triangles each;
  for (std::size_t i = 0; i < box->triangles().size(); ++i) {
    const auto first = static_cast<std::uint32_t>(apart.size());
    for (const Vector3& corner : box->corners(i)) apart.push_back(corner);
    each.push_back({first, first + 1, first + 2});
  }
  EXPECT_EQ(TriangleMesh(apart, each, true).open_edges(), 0U);
}

TEST(TriangleMesh, ItsTreeLeavesOutNoTriangleThatMatters) {
  Seed seed{75};
  for (std::size_t n = 0; n < scaled(200); ++n) {
    const auto mesh = bumpy_mesh(seed, 0.3, 3 + static_cast<std::uint32_t>(seed.below(6)));
    const Vector3 p = random_point(seed, 0.4);
    const double radius = seed.uniform(0, 0.3);
    std::set<std::size_t> seen;
    mesh->visit([&](const TriangleMesh::Bounds& box) { return (p - p.cwiseMax(box.min).cwiseMin(box.max)).norm() <= radius; },
                [&](std::size_t i) { EXPECT_TRUE(seen.insert(i).second) << "twice"; });
    for (std::size_t i = 0; i < mesh->triangles().size(); ++i) {
      for (const Vector3& corner : mesh->corners(i)) {
        EXPECT_TRUE((corner - p).norm() > radius || seen.count(i) == 1);
      }
    }
    EXPECT_TRUE(radius > 0.05 || seen.size() < mesh->triangles().size()) << "nothing was left out";
  }
}

}  // namespace
}  // namespace interlace::test
