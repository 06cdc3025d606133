#pragma once

#include <optional>
#include <vector>

#include "common/mesh/mesh.hpp"
#include "common/model/robot_model.hpp"

namespace interlace::modeller {

inline constexpr std::size_t kMostCapsules = 16;  ///< for one mesh

struct CoverOptions {
  std::size_t capsules = 1;      ///< at most; fewer where another one does not pay
  std::optional<double> excess;  ///< stop as soon as the volume exceeds the body's by this share or less (0.2 = 20 %)
};

/// Capsules around a mesh, and how well they fit.
struct Cover {
  std::vector<model::Capsule> capsules;  ///< in the frame of the mesh [m]
  double least_depth = 0;                ///< of the vertices of the mesh inside the capsules [m], > 0
  double most_depth = 0;                 ///< [m]
  double volume = 0;                     ///< of the union of the capsules [m³]
  double body_volume = 0;                ///< of the body they are compared with [m³]
  bool watertight = false;               ///< that body is what the mesh encloses; else its convex hull, which is more

  /// By what share the capsules take more room than the body; infinite for a flat one.
  [[nodiscard]] double excess() const { return volume / body_volume - 1; }
};

/// Covers `mesh`, which holds at least one triangle: the whole surface lies inside the union of the capsules.
/// Proof: the mesh is cut by planes into parts that together are the whole surface, and each part gets a capsule with all of the part's
/// vertices inside. A capsule is convex, so with three vertices of a triangle it holds the triangle; so it holds the part, and the capsules
/// hold the surface. One capsule even holds the convex hull; of several, a hollow may stay
/// deep inside a thick body, where nothing gets but through the surface. Where a cut crosses an edge its point is rounded, by far less than
/// every vertex is inside. A part is cut where the capsules of its halves take the least room, and of all parts the one whose cut leaves
/// the least, as long as that is 1 % less than before. Throws std::logic_error should a vertex of a part ever lie outside. Deterministic.
/// Pure; any thread.
[[nodiscard]] Cover cover(const mesh::Mesh& mesh, const CoverOptions& options);

}  // namespace interlace::modeller
