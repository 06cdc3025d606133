#pragma once

#include <optional>
#include <vector>

#include "common/model/pose.hpp"

namespace interlace::modeller {

/// Convex hull of a set of points.
struct Hull {
  double volume = 0;                    ///< [m³]
  std::vector<model::Vector3> corners;  ///< [m]
};

/// The hull of `points`; empty when they all lie in one plane, as far as double precision can tell. Qhull's. Pure; any thread.
[[nodiscard]] std::optional<Hull> hull_of(const std::vector<model::Vector3>& points);

}  // namespace interlace::modeller
