#pragma once

#include "common/app/config/fixture_section.hpp"

namespace interlace::app {

/// The MeshReader of cell files on disk: STL and OBJ files, see common/mesh/mesh.hpp.
[[nodiscard]] model::Result<std::shared_ptr<const model::TriangleMesh>, std::string> read_mesh_file(const std::string& path, double scale,
                                                                                                    bool solid);

}  // namespace interlace::app
