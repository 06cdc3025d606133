#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "common/model/result.hpp"

namespace interlace::mesh {

inline constexpr std::size_t kMaxFileSize = 256U << 20U;  ///< [bytes] beyond it a shape is not meant for planning

/// Surface of triangles. Corners at the same place are one vertex, every vertex belongs to a triangle.
struct Mesh {
  std::vector<Eigen::Vector3d> vertices;   ///< in the file's frame [m]
  std::vector<Eigen::Vector3i> triangles;  ///< indices into `vertices`; may be without area
};

/// Why a mesh was refused, told so that a person can mend it.
struct MeshError {
  std::string file;
  std::string rule;  ///< what was found and what was expected
};

/// `arm/link2.stl: holds no triangles, …`
[[nodiscard]] std::string to_string(const MeshError& error);

/// Reads the STL (ascii or binary) or OBJ file at `path`; `scale` metres are one unit of the file (0.001 for mm). Nothing of the file's
/// shape is left out: polygons become fans of triangles, lines and points triangles without area. Coordinates have single
/// precision: off by 6e-8 of their size at most.
/// Refused: no such file, a directory, larger than kMaxFileSize, another format, not readable as what its name says, no triangles, a
/// coordinate that is not a finite number or lies beyond 1000 m. Blocks as the file system does; any thread.
[[nodiscard]] model::Result<Mesh, MeshError> read_mesh(const std::string& path, double scale);

}  // namespace interlace::mesh
