#pragma once

#include <memory>
#include <string>
#include <variant>

#include "common/model/triangle_mesh.hpp"

namespace interlace::model {

// Shapes of things that never move, about the origin of their own frame O. Lengths [m]. All are solid, but for meshes that say otherwise.

struct SphereShape {
  double radius = 0;
};
/// Sides along the axes of O.
struct BoxShape {
  Vector3 half = Vector3::Zero();  ///< half of its size
};
/// About the z axis of O.
struct CylinderShape {
  double radius = 0;
  double half_length = 0;
};
/// The half space n · p ≤ offset: a floor, a wall, a ceiling.
struct PlaneShape {
  Vector3 normal = Vector3::UnitZ();  ///< unit, out of the material
  double offset = 0;
};
struct MeshShape {
  std::shared_ptr<const TriangleMesh> mesh;  ///< never null
};

using Shape = std::variant<SphereShape, BoxShape, CylinderShape, PlaneShape, MeshShape>;

/// Something in the cell that never moves and that no robot may touch. Link 0 of a robot never moves either, and stands on some of them: it
/// is held against none.
struct Fixture {
  std::string name;  ///< unique in the cell
  Pose X_WO = Pose::Identity();
  Shape shape;
};

}  // namespace interlace::model
