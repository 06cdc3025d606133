#include "modeller/cut.hpp"

#include <map>

namespace interlace::modeller {

namespace {

using mesh::Mesh;

/// Where a corner of a cut triangle comes from: a vertex (i, i), or the point where the plane crosses the edge i–j, i < j.
using Origin = std::pair<int, int>;

class CutPart {
 public:
  /// Adds the convex polygon `corners` as a fan; nothing when it has fewer than three.
  void add(const std::vector<std::pair<Origin, model::Vector3>>& corners) {
    std::vector<int> indices;
    for (std::size_t k = 0; corners.size() >= 3 && k < corners.size(); ++k) {
      const auto [entry, fresh] = indices_.try_emplace(corners[k].first, static_cast<int>(mesh.vertices.size()));
      if (fresh) mesh.vertices.push_back(corners[k].second);
      indices.push_back(entry->second);
    }
    for (std::size_t k = 1; k + 1 < indices.size(); ++k) mesh.triangles.emplace_back(indices[0], indices[k], indices[k + 1]);
  }

  Mesh mesh;

 private:
  std::map<Origin, int> indices_;
};

}  // namespace

std::pair<Mesh, Mesh> cut(const Mesh& mesh, const model::Vector3& n, double offset) {
  std::vector<double> height;  // above the plane
  height.reserve(mesh.vertices.size());
  for (const auto& p : mesh.vertices) height.push_back(n.dot(p) - offset);

  CutPart below;
  CutPart above;
  for (const Eigen::Vector3i& t : mesh.triangles) {
    std::vector<std::pair<Origin, model::Vector3>> low;
    std::vector<std::pair<Origin, model::Vector3>> high;
    for (int k = 0; k < 3; ++k) {
      const int i = t[k];
      const int j = t[(k + 1) % 3];
      if (height[i] <= 0) low.push_back({{i, i}, mesh.vertices[i]});
      if (height[i] > 0) high.push_back({{i, i}, mesh.vertices[i]});
      if ((height[i] <= 0) == (height[j] <= 0)) continue;
      const auto [from, to] = std::minmax(i, j);  // the same point for both triangles of the edge
      const double s = height[from] / (height[from] - height[to]);
      const model::Vector3 p = mesh.vertices[from] + s * (mesh.vertices[to] - mesh.vertices[from]);
      low.push_back({{from, to}, p});
      high.push_back({{from, to}, p});
    }
    below.add(low);
    above.add(high);
  }
  return {std::move(below.mesh), std::move(above.mesh)};
}

}  // namespace interlace::modeller
