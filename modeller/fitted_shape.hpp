#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "common/mesh/mesh.hpp"
#include "common/model/robot_model.hpp"
#include "modeller/cover.hpp"
#include "modeller/shape.hpp"

namespace interlace::modeller {

/// A shape and the capsules around it, in the frame of its link.
struct FittedShape {
  Shape shape;
  std::size_t vertices = 0, triangles = 0;
  Cover cover;
};

/// Reads the mesh of `shape` and covers it. Of `options`, the shape's own number of capsules goes first.
[[nodiscard]] model::Result<FittedShape, mesh::MeshError> fit(const Shape& shape, CoverOptions options);

/// All capsules as a model has them, called base, link1 … link5 and flange, with numbers where a link has several.
[[nodiscard]] std::vector<model::LinkCapsule> link_capsules(const std::vector<FittedShape>& fitted);

/// One line for people: how well the capsules cover the shape, and what they take up beyond it.
[[nodiscard]] std::string describe(const FittedShape& fitted);

/// The same as a JSON object, in SI units; `excess` is null for a body without volume.
[[nodiscard]] nlohmann::json to_json(const FittedShape& fitted);

}  // namespace interlace::modeller
