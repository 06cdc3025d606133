#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/model/pose.hpp"

namespace interlace::model {

/// A surface of triangles, with a tree of boxes over them so that questions about a place look at few of them. Immutable; thread-safe.
class TriangleMesh {
 public:
  using Triangle = std::array<std::uint32_t, 3>;  ///< indices of the corners

  /// Corners [m]; `solid`: what the surface encloses is material too, which makes sense for a closed one only (see open_edges).
  /// Throws std::invalid_argument without triangles, or when one has a corner that is not there.
  TriangleMesh(std::vector<Vector3> vertices, std::vector<Triangle> triangles, bool solid);

  [[nodiscard]] const std::vector<Vector3>& vertices() const { return vertices_; }
  [[nodiscard]] const std::vector<Triangle>& triangles() const { return triangles_; }
  [[nodiscard]] bool solid() const { return solid_; }
  [[nodiscard]] std::array<Vector3, 3> corners(std::size_t triangle) const {
    const Triangle& t = triangles_[triangle];
    return {vertices_[t[0]], vertices_[t[1]], vertices_[t[2]]};
  }

  /// Edges that an odd number of triangles share; none: the surface is closed. Corners at the same place count as one.
  [[nodiscard]] std::size_t open_edges() const;

  /// Axis-aligned, in the mesh's own frame [m].
  struct Bounds {
    Vector3 min, max;
  };
  [[nodiscard]] const Bounds& bounds() const { return nodes_.front().bounds; }

  /// Calls `look` with the index of each triangle in boxes that `may_matter` lets through.
  template <typename MayMatter, typename Look>
  void visit(const MayMatter& may_matter, const Look& look) const {
    visit(0, may_matter, look);
  }

 private:
  struct Node {
    Bounds bounds;
    std::uint32_t first = 0, last = 0;  // of a leaf: its triangles in `order_`
    std::uint32_t right = 0;            // else: its second half; the first one follows it. 0 in a leaf
  };

  std::uint32_t build(std::uint32_t first, std::uint32_t last);

  template <typename MayMatter, typename Look>
  void visit(std::uint32_t at, const MayMatter& may_matter, const Look& look) const {
    const Node& node = nodes_[at];
    if (!may_matter(node.bounds)) return;
    if (node.right == 0) {
      for (std::uint32_t i = node.first; i < node.last; ++i) look(static_cast<std::size_t>(order_[i]));
      return;
    }
    visit(at + 1, may_matter, look);
    visit(node.right, may_matter, look);
  }

  std::vector<Vector3> vertices_;
  std::vector<Triangle> triangles_;
  bool solid_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace interlace::model
