#include "modeller/cover.hpp"

#include <gtest/gtest.h>

#include "modeller/capsule_fit.hpp"
#include "modeller/volume.hpp"
#include "tests/support/arm_shapes.hpp"
#include "tests/support/arms.hpp"
#include "tests/support/seed.hpp"
#include "tests/support/shapes.hpp"

namespace interlace::test {
namespace {

using model::kPi;
using modeller::Cover;
using modeller::cover;
using modeller::CoverOptions;

/// Points of the surface outside all capsules, of `count` drawn from random triangles; corners and middles of edges among them.
std::size_t points_outside(const Cover& c, const Mesh& mesh, Seed& seed, std::size_t count) {
  std::size_t outside = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const auto& t = mesh.triangles[seed.below(mesh.triangles.size())];
    double u = seed.chance(0.1) ? 0.0 : seed.uniform(0, 1);
    double v = seed.chance(0.1) ? 0.5 : seed.uniform(0, 1);
    if (u + v > 1) {
      u = 1 - u;
      v = 1 - v;
    }
    const Vector3 p = (1 - u - v) * mesh.vertices[t[0]] + u * mesh.vertices[t[1]] + v * mesh.vertices[t[2]];
    const bool held =
        std::any_of(c.capsules.begin(), c.capsules.end(), [&](const auto& capsule) { return modeller::depth_in(capsule, p) >= 0; });
    if (!held) ++outside;
  }
  return outside;
}

struct Shape {
  const char* name;
  Mesh mesh;
  std::size_t capsules;  // at most
  double most_excess;    // [share of the body's volume]
};

void expect_covered(const Shape& shape) {
  Seed seed{45};
  const Cover c = cover(shape.mesh, {shape.capsules, {}});
  std::printf("%-24s %2zu capsules, %5zu vertices inside by %.3f to %.3f mm, volume excess %.1f %% of the %s\n", shape.name,
              c.capsules.size(), shape.mesh.vertices.size(), 1e3 * c.least_depth, 1e3 * c.most_depth, 1e2 * c.excess(),
              c.watertight ? "mesh" : "hull");
  EXPECT_LE(c.capsules.size(), shape.capsules) << shape.name;
  EXPECT_GT(c.least_depth, 0) << shape.name;
  EXPECT_LE(c.least_depth, c.most_depth) << shape.name;
  EXPECT_LT(c.excess(), shape.most_excess) << shape.name;
  EXPECT_EQ(points_outside(c, shape.mesh, seed, 20000), 0U) << shape.name << ", seed " << seed.value();
}

TEST(CoverOf, ABoxACylinderAndABentPipe) {
  for (const auto& shape : std::vector<Shape>{{"box", box({0.1, 0.15, 0.4}), 1, 1.5},
                                              {"box", box({0.1, 0.15, 0.4}), 4, 1.5},
                                              {"cylinder", cylinder(0.06, 0.3), 1, 0.3},
                                              {"torus", bent_pipe(0.2, 0.03, 2 * kPi), 1, 14},
                                              {"torus", bent_pipe(0.2, 0.03, 2 * kPi), 8, 0.6},
                                              {"bent pipe", bent_pipe(0.2, 0.03, kPi / 2), 1, 2.5},
                                              {"bent pipe", bent_pipe(0.2, 0.03, kPi / 2), 4, 0.3}}) {
    expect_covered(shape);
  }
}

TEST(CoverOf, ARealArmsLinks) {
  const auto links = small_arm_shapes();
  for (const std::size_t capsules : {1, 3}) {
    double body = 0;
    double around = 0;
    for (const auto& [link, mesh] : links) {
      expect_covered({("arm, link " + std::to_string(link)).c_str(), mesh, capsules, capsules == 1 ? 2.4 : 1.6});
      const Cover c = cover(mesh, {capsules, {}});
      body += c.body_volume;
      around += c.volume;
    }
    EXPECT_LT(around / body - 1, capsules == 1 ? 1.5 : 0.9);
    std::printf("whole arm: %.1f %% excess with at most %zu capsules a link\n", 1e2 * (around / body - 1), capsules);
  }
}

/// Shapes of every kind: clouds as triangles from nowhere to nowhere, flat, without area, in any pose.
Mesh random_mesh(Seed& seed) {
  const Vector3 size{std::pow(10, seed.uniform(-3, 0)), std::pow(10, seed.uniform(-3, 0)), std::pow(10, seed.uniform(-3, 0))};
  const bool flat = seed.chance(0.2);
  Mesh m;
  const std::size_t count = 1 + seed.below(40);
  for (std::size_t i = 0; i < count + 2; ++i) {
    Vector3 p = random_point(seed, 1).array() * size.array();
    if (flat) p.z() = 0;
    m.vertices.push_back(p);
  }
  for (std::size_t i = 0; i < count; ++i) {
    const auto pick = [&] { return static_cast<int>(seed.below(m.vertices.size())); };
    m.triangles.emplace_back(static_cast<int>(i), pick(), static_cast<int>(i + 2));
  }
  return moved(m, model::make_pose(random_point(seed, 1), random_rotation(seed)));
}

TEST(Cover, HoldsTheWholeSurfaceOfAnyMeshAndIsTheSameTwice) {
  Seed seed{46};
  const std::size_t cases = scaled(25);
  for (std::size_t i = 0; i < cases; ++i) {
    const Mesh mesh = random_mesh(seed);
    const CoverOptions options{1 + seed.below(6), {}};
    const Cover c = cover(mesh, options);
    ASSERT_EQ(points_outside(c, mesh, seed, 2000), 0U) << "seed " << seed.value() << ", mesh " << i;
    ASSERT_GT(c.least_depth, 0) << "seed " << seed.value() << ", mesh " << i;
    ASSERT_LE(c.capsules.size(), options.capsules);
    const Cover again = cover(mesh, options);
    ASSERT_EQ(again.capsules.size(), c.capsules.size());
    for (std::size_t k = 0; k < c.capsules.size(); ++k) {
      ASSERT_TRUE(c.capsules[k].a == again.capsules[k].a && c.capsules[k].b == again.capsules[k].b) << "seed " << seed.value();
      ASSERT_EQ(c.capsules[k].radius, again.capsules[k].radius);
    }
  }
}

TEST(Cover, StopsWhereItIsTightEnoughOrNothingPays) {
  const Mesh pipe = bent_pipe(0.2, 0.03, kPi / 2);
  const Cover loose = cover(pipe, {16, 1.0});
  EXPECT_LE(loose.excess(), 1.0);
  EXPECT_LT(loose.capsules.size(), cover(pipe, {16, 0.3}).capsules.size());
  EXPECT_EQ(cover(cylinder(0.05, 0.5), {16, {}}).capsules.size(), 1U) << "a cylinder is no better off in two";
}

TEST(Cover, ComparesWithTheHullWhereTheMeshIsOpen) {
  Mesh open = bent_pipe(0.2, 0.03, kPi / 2);
  const Cover closed = cover(open, {});
  open.triangles.pop_back();
  const Cover c = cover(open, {});
  EXPECT_TRUE(closed.watertight);
  EXPECT_FALSE(c.watertight);
  EXPECT_GT(c.body_volume, closed.body_volume) << "the hull fills the bend";
  EXPECT_NEAR(c.volume, closed.volume, 1e-9);
}

}  // namespace
}  // namespace interlace::test
