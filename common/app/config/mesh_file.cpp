#include "common/app/config/mesh_file.hpp"

#include "common/mesh/mesh.hpp"

namespace interlace::app {

model::Result<std::shared_ptr<const model::TriangleMesh>, std::string> read_mesh_file(const std::string& path, double scale, bool solid) {
  auto mesh = mesh::read_mesh(path, scale);
  if (!mesh) return model::unexpected(mesh::to_string(mesh.error()));
  std::vector<model::TriangleMesh::Triangle> triangles;
  triangles.reserve(mesh->triangles.size());
  for (const auto& t : mesh->triangles) {
    triangles.push_back({static_cast<std::uint32_t>(t.x()), static_cast<std::uint32_t>(t.y()), static_cast<std::uint32_t>(t.z())});
  }
  return std::make_shared<const model::TriangleMesh>(std::move(mesh->vertices), std::move(triangles), solid);
}

}  // namespace interlace::app
