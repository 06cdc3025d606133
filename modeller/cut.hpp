#pragma once

#include <utility>

#include "common/mesh/mesh.hpp"
#include "common/model/pose.hpp"

namespace interlace::modeller {

/// The parts of `mesh` below and above the plane n·p = `offset`. Triangles that the plane crosses are cut along it, so that the two
/// surfaces together are the whole surface and meet in the same vertices. Either may be empty.
[[nodiscard]] std::pair<mesh::Mesh, mesh::Mesh> cut(const mesh::Mesh& mesh, const model::Vector3& n, double offset);

}  // namespace interlace::modeller
