#include "modeller/hull.hpp"

#include <libqhullcpp/Qhull.h>
#include <libqhullcpp/QhullVertexSet.h>

namespace interlace::modeller {

std::optional<Hull> hull_of(const std::vector<model::Vector3>& points) {
  static_assert(sizeof(model::Vector3) == 3 * sizeof(double), "Qhull takes the coordinates one after the other");
  if (points.size() < 4) return std::nullopt;
  try {
    orgQhull::Qhull qhull;
    qhull.runQhull("", 3, static_cast<int>(points.size()), points.front().data(), "Pp");
    Hull hull;
    hull.volume = qhull.volume();
    for (const orgQhull::QhullVertex& vertex : qhull.vertexList()) hull.corners.push_back(points[vertex.point().id()]);
    return hull;
  } catch (const orgQhull::QhullError&) {
    return std::nullopt;  // what Qhull has no hull for
  }
}

}  // namespace interlace::modeller
