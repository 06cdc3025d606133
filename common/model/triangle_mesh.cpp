#include "common/model/triangle_mesh.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace interlace::model {

namespace {

constexpr std::uint32_t kLeaf = 4;  // triangles

}  // namespace

TriangleMesh::TriangleMesh(std::vector<Vector3> vertices, std::vector<Triangle> triangles, bool solid)
    : vertices_(std::move(vertices)), triangles_(std::move(triangles)), solid_(solid), order_(triangles_.size()) {
  if (triangles_.empty()) throw std::invalid_argument("a mesh needs triangles");
  for (const Triangle& t : triangles_) {
    for (const std::uint32_t corner : t) {
      if (corner >= vertices_.size()) throw std::invalid_argument("a triangle has a corner that is not there");
    }
  }
  std::iota(order_.begin(), order_.end(), 0U);
  (void)build(0, static_cast<std::uint32_t>(order_.size()));
}

/// Halves the triangles along the longest side of their box, and so on.
std::uint32_t TriangleMesh::build(std::uint32_t first, std::uint32_t last) {
  const auto at = static_cast<std::uint32_t>(nodes_.size());
  nodes_.emplace_back();
  Bounds box{vertices_[triangles_[order_[first]][0]], vertices_[triangles_[order_[first]][0]]};
  for (std::uint32_t i = first; i < last; ++i) {
    for (const Vector3& p : corners(order_[i])) {
      box.min = box.min.cwiseMin(p);
      box.max = box.max.cwiseMax(p);
    }
  }
  nodes_[at].bounds = box;
  if (last - first <= kLeaf) {
    nodes_[at].first = first;
    nodes_[at].last = last;
    return at;
  }
  Eigen::Index axis = 0;
  (void)(box.max - box.min).maxCoeff(&axis);
  const auto place = [&](std::uint32_t t) {
    const auto c = corners(t);
    return c[0][axis] + c[1][axis] + c[2][axis];
  };
  const std::uint32_t middle = first + (last - first) / 2;
  std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + last,
                   [&](std::uint32_t a, std::uint32_t b) { return place(a) < place(b); });
  (void)build(first, middle);
  const std::uint32_t right = build(middle, last);
  nodes_[at].right = right;
  return at;
}

std::size_t TriangleMesh::open_edges() const {
  std::map<std::array<double, 3>, std::size_t> known;  // places of corners
  const auto place = [&](std::uint32_t corner) {
    const Vector3& p = vertices_[corner];
    return known.emplace(std::array<double, 3>{p.x(), p.y(), p.z()}, known.size()).first->second;
  };
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> shared;
  for (const Triangle& t : triangles_) {
    const std::array<std::size_t, 3> at{place(t[0]), place(t[1]), place(t[2])};
    for (std::size_t i = 0; i < 3; ++i) {
      const auto ends = std::minmax(at[i], at[(i + 1) % 3]);
      if (ends.first != ends.second) ++shared[{ends.first, ends.second}];
    }
  }
  return static_cast<std::size_t>(std::count_if(shared.begin(), shared.end(), [](const auto& edge) { return edge.second % 2 != 0; }));
}

}  // namespace interlace::model
