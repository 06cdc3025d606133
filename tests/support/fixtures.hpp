#pragma once

#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "common/model/fixture.hpp"
#include "tests/support/arms.hpp"

/// Fixtures for tests: known ones, and random ones of every type.
namespace interlace::test {

using Triangles = std::vector<model::TriangleMesh::Triangle>;

inline std::shared_ptr<const model::TriangleMesh> mesh_of(std::vector<model::Vector3> vertices, Triangles triangles, bool solid = true) {
  return std::make_shared<const model::TriangleMesh>(std::move(vertices), std::move(triangles), solid);
}

/// A closed box about the origin, twelve triangles that face outwards.
inline std::shared_ptr<const model::TriangleMesh> box_mesh(const model::Vector3& half, bool solid = true) {
  std::vector<model::Vector3> v;
  for (int i = 0; i < 8; ++i) {
    v.push_back(half.cwiseProduct(model::Vector3{(i & 1) != 0 ? 1.0 : -1.0, (i & 2) != 0 ? 1.0 : -1.0, (i & 4) != 0 ? 1.0 : -1.0}));
  }
  return mesh_of(
      std::move(v),
      {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4}, {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}},
      solid);
}

/// A closed ball of `rings` × 2 `rings` patches with random bumps, not convex, about the origin; facing outwards.
inline std::shared_ptr<const model::TriangleMesh> bumpy_mesh(Seed& seed, double radius, std::uint32_t rings, bool solid = true) {
  const std::uint32_t around = 2 * rings;
  std::vector<model::Vector3> v{{0, 0, -radius}};
  for (std::uint32_t i = 1; i < rings; ++i) {
    for (std::uint32_t k = 0; k < around; ++k) {
      const double up = kPi * i / rings;
      const double turn = 2 * kPi * k / around;
      const double r = radius * seed.uniform(0.5, 1.0);
      v.emplace_back(r * std::sin(up) * std::cos(turn), r * std::sin(up) * std::sin(turn), -r * std::cos(up));
    }
  }
  v.emplace_back(0, 0, radius);
  const auto at = [&](std::uint32_t i, std::uint32_t k) { return 1 + (i - 1) * around + k % around; };
  const auto top = static_cast<std::uint32_t>(v.size() - 1);
  Triangles t;
  for (std::uint32_t k = 0; k < around; ++k) {
    t.push_back({0, at(1, k + 1), at(1, k)});
    for (std::uint32_t i = 1; i + 1 < rings; ++i) {
      t.push_back({at(i, k), at(i, k + 1), at(i + 1, k)});
      t.push_back({at(i, k + 1), at(i + 1, k + 1), at(i + 1, k)});
    }
    t.push_back({at(rings - 1, k), at(rings - 1, k + 1), top});
  }
  return mesh_of(std::move(v), std::move(t), solid);
}

inline model::Fixture fixture(std::string name, model::Shape shape, const model::Pose& X_WO = model::Pose::Identity()) {
  return {std::move(name), X_WO, std::move(shape)};
}

inline model::Pose at(double x, double y, double z) {
  return model::make_pose({x, y, z}, model::Quaternion::Identity());
}

constexpr int kFixtureTypes = 6;

/// Type 0 … 5: sphere, box, cylinder, plane, solid mesh, mesh that is a surface only. Some 0.1 to 0.6 m large, within `half` of the origin.
inline model::Fixture random_fixture(Seed& seed, int type, double half) {
  model::Fixture f;
  f.name = "f";
  f.X_WO = model::make_pose(random_point(seed, half), random_rotation(seed));
  const auto size = [&] { return seed.uniform(0.05, 0.3); };
  switch (type) {
    case 0: f.shape = model::SphereShape{size()}; break;
    case 1: f.shape = model::BoxShape{{size(), seed.chance(0.3) ? 0.002 : size(), size()}}; break;
    case 2: f.shape = model::CylinderShape{size(), seed.chance(0.3) ? 0.002 : size()}; break;
    case 3:
      f.X_WO = model::Pose::Identity();
      f.shape = model::PlaneShape{random_rotation(seed) * model::Vector3::UnitZ(), -seed.uniform(0.1, half)};
      break;
    case 4: f.shape = model::MeshShape{seed.chance(0.5) ? box_mesh({size(), size(), size()}) : bumpy_mesh(seed, size(), 5)}; break;
    default: f.shape = model::MeshShape{bumpy_mesh(seed, size(), 4, false)}; break;
  }
  return f;
}

}  // namespace interlace::test
