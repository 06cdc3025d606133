#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <sstream>
#include <string>

#include "common/mesh/mesh.hpp"
#include "common/model/pose.hpp"

/// Shapes that tests make themselves, and the files they come in.
namespace interlace::test {

using mesh::Mesh;
using model::Vector3;

/// `count` × `rows` corners on a closed tube: `place(u, v)` for u = 0 … count − 1 around it and v = 0 … rows − 1 along it; the last ring is
/// joined to the first where `closed`, else both ends get a lid. Faces look outwards when u turns right-handed about the way v goes.
inline Mesh tube(int count, int rows, bool closed, const std::function<Vector3(int u, int v)>& place) {
  Mesh m;
  for (int v = 0; v < rows; ++v) {
    for (int u = 0; u < count; ++u) m.vertices.push_back(place(u, v));
  }
  const auto at = [&](int u, int v) { return (v % rows) * count + u % count; };
  for (int v = 0; v < (closed ? rows : rows - 1); ++v) {
    for (int u = 0; u < count; ++u) {
      m.triangles.emplace_back(at(u, v), at(u + 1, v), at(u + 1, v + 1));
      m.triangles.emplace_back(at(u, v), at(u + 1, v + 1), at(u, v + 1));
    }
  }
  for (int u = 1; !closed && u + 1 < count; ++u) {
    m.triangles.emplace_back(at(0, 0), at(u + 1, 0), at(u, 0));
    m.triangles.emplace_back(at(0, rows - 1), at(u, rows - 1), at(u + 1, rows - 1));
  }
  return m;
}

/// A prism of `count` sides inscribed in a cylinder about z, from z = 0 to `height` [m].
inline Mesh cylinder(double radius, double height, int count = 48) {
  return tube(count, 2, false, [=](int u, int v) {
    const double angle = 2 * model::kPi * u / count;
    return Vector3{radius * std::cos(angle), radius * std::sin(angle), v * height};
  });
}

/// A box of full `size` about the origin [m]: 8 corners, 12 triangles.
inline Mesh box(const Vector3& size) {
  Mesh m = tube(4, 2, false, [&](int u, int v) {
    return Vector3{u == 0 || u == 3 ? -size.x() / 2 : size.x() / 2, u < 2 ? -size.y() / 2 : size.y() / 2, (v - 0.5) * size.z()};
  });
  return m;
}

/// A pipe of `radius` bent with its middle line on a circle of radius `bend` about z, through `turn` [rad]; a whole turn is a torus.
inline Mesh bent_pipe(double bend, double radius, double turn, int rows = 48, int count = 24) {
  const bool closed = turn >= 2 * model::kPi - 1e-9;
  return tube(count, rows, closed, [=](int u, int v) {
    const double along = turn * v / (closed ? rows : rows - 1);
    const double around = 2 * model::kPi * u / count;
    const double r = bend + radius * std::cos(around);
    return Vector3{r * std::cos(along), r * std::sin(along), -radius * std::sin(around)};
  });
}

inline Mesh moved(Mesh m, const model::Pose& X) {
  for (Vector3& p : m.vertices) p = X * p;
  return m;
}

/// Both, as one file with two bodies has them.
inline Mesh together(Mesh a, const Mesh& b) {
  const int offset = static_cast<int>(a.vertices.size());
  a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (const Eigen::Vector3i& t : b.triangles) a.triangles.push_back(t + Eigen::Vector3i::Constant(offset));
  return a;
}

// Files. `per_metre` is how many units of the file make a metre.

inline std::string ascii_stl(const Mesh& m, double per_metre = 1000) {
  std::ostringstream out;
  out.precision(9);
  out << "solid shape\n";
  for (const Eigen::Vector3i& t : m.triangles) {
    out << "facet normal 0 0 0\nouter loop\n";
    for (const int i : {t[0], t[1], t[2]}) out << "vertex " << (per_metre * m.vertices[i]).transpose() << '\n';
    out << "endloop\nendfacet\n";
  }
  out << "endsolid shape\n";
  return out.str();
}

inline std::string binary_stl(const Mesh& m, double per_metre = 1000) {
  std::string out(80, ' ');
  const auto append = [&](const auto& value) {
    out.resize(out.size() + sizeof value);
    std::memcpy(out.data() + out.size() - sizeof value, &value, sizeof value);
  };
  append(static_cast<std::uint32_t>(m.triangles.size()));
  for (const Eigen::Vector3i& t : m.triangles) {
    for (int k = 0; k < 3; ++k) append(0.0F);
    for (const int i : {t[0], t[1], t[2]}) {
      for (int k = 0; k < 3; ++k) append(static_cast<float>(per_metre * m.vertices[i][k]));
    }
    append(std::uint16_t{0});
  }
  return out;
}

inline std::string obj(const Mesh& m, double per_metre = 1000) {
  std::ostringstream out;
  out.precision(9);
  for (const Vector3& p : m.vertices) out << "v " << (per_metre * p).transpose() << '\n';
  for (const Eigen::Vector3i& t : m.triangles) out << "f " << (t + Eigen::Vector3i::Ones()).transpose() << '\n';
  return out.str();
}

}  // namespace interlace::test
