#pragma once

#include <optional>
#include <vector>

#include "common/mesh/mesh.hpp"
#include "common/model/robot_model.hpp"

namespace interlace::modeller {

/// What `mesh` encloses [m³]; empty when it is not watertight: each edge must be gone along as often in one direction as in the other.
/// Bodies that overlap count twice. Source: divergence theorem, one tetrahedron per triangle.
[[nodiscard]] std::optional<double> enclosed_volume(const mesh::Mesh& mesh);

/// Volume of a capsule [m³].
[[nodiscard]] double volume_of(const model::Capsule& capsule);

/// Volume [m³] of the union of `capsules`: exact along x, midpoint rule with `lines` × `lines` lines across, which is good to 0.1 % with
/// 256 of them. Exact for one capsule.
[[nodiscard]] double union_volume(const std::vector<model::Capsule>& capsules, int lines = 256);

}  // namespace interlace::modeller
