#include "common/mesh/mesh.hpp"

#include <assimp/scene.h>

#include <algorithm>
#include <array>
#include <assimp/Importer.hpp>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>

namespace interlace::mesh {

namespace {

using Corner = std::array<float, 3>;

constexpr double kFarthest = 1000;  // [m] as in cell files

/// Collects triangles; corners at the same place become one vertex. Exactly the same: neighbours of a file repeat their numbers, and
/// whatever lies apart, by however little, must not be moved.
class Welder {
 public:
  int vertex(const aiVector3D& p, double scale) {
    const auto [entry, fresh] = indices_.try_emplace(Corner{p.x, p.y, p.z}, static_cast<int>(mesh_.vertices.size()));
    if (fresh) mesh_.vertices.emplace_back(scale * Eigen::Vector3f{p.x, p.y, p.z}.cast<double>());
    return entry->second;
  }
  void triangle(const Eigen::Vector3i& indices) { mesh_.triangles.push_back(indices); }

  [[nodiscard]] Mesh take() { return std::move(mesh_); }

 private:
  std::map<Corner, int> indices_;
  Mesh mesh_;
};

bool is_finite(const aiVector3D& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

/// Why `p` cannot be a corner; empty when it can.
std::string fault_of(const aiVector3D& p, double scale) {
  if (!is_finite(p)) return "a coordinate is not a finite number";
  const double far = scale * std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  return far > kFarthest ? "a coordinate lies beyond 1000 m: are the units right?" : "";
}

/// Adds `face` as a fan about its first corner; tells why it cannot, or nothing. The library's own way of cutting polygons leaves out what
/// it cannot cut; a fan covers any polygon, since whatever the polygon winds around, one of the fan's triangles winds around, too.
std::string add_face(const aiMesh& part, const aiFace& face, double scale, Welder& welder) {
  std::vector<int> corners;
  for (unsigned i = 0; i < face.mNumIndices; ++i) {
    const aiVector3D& p = part.mVertices[face.mIndices[i]];
    if (auto fault = fault_of(p, scale); !fault.empty()) return fault;
    corners.push_back(welder.vertex(p, scale));
  }
  while (!corners.empty() && corners.size() < 3) corners.push_back(corners.back());  // a line or a point
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) welder.triangle({corners[0], corners[i], corners[i + 1]});
  return "";
}

/// "stl" or "obj", from the name of the file; empty for any other.
std::string format_of(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), [](unsigned char c) { return std::tolower(c); });
  return extension == ".stl" || extension == ".obj" ? extension.substr(1) : "";
}

/// Why there is no file to read at `path`; empty when there is.
std::string fault_of_file(const std::filesystem::path& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::not_found) return "no such file";
  if (error) return "cannot be read: " + error.message();
  if (status.type() != std::filesystem::file_type::regular) return "is not a regular file";
  const auto size = std::filesystem::file_size(path, error);
  if (error) return "cannot be read: " + error.message();
  if (size > kMaxFileSize) return "larger than " + std::to_string(kMaxFileSize >> 20U) + " MiB";
  return format_of(path).empty() ? "expected an .stl or .obj file" : "";
}

std::optional<std::vector<char>> bytes_of(const std::filesystem::path& path) {
  std::ifstream file{path, std::ios::binary};
  std::vector<char> bytes{std::istreambuf_iterator<char>{file}, {}};
  if (!file && !file.eof()) return std::nullopt;
  return bytes;
}

}  // namespace

std::string to_string(const MeshError& error) {
  return error.file + ": " + error.rule;
}

model::Result<Mesh, MeshError> read_mesh(const std::string& path, double scale) {
  const auto refuse = [&](std::string rule) { return model::unexpected{MeshError{path, std::move(rule)}}; };
  if (auto fault = fault_of_file(path); !fault.empty()) return refuse(std::move(fault));
  const auto bytes = bytes_of(path);
  if (!bytes) return refuse("cannot be read");

  // From memory: a file must not make the library open others, such as the material library that an OBJ file names.
  Assimp::Importer importer;
  const std::string format = format_of(path);
  const aiScene* scene = importer.ReadFileFromMemory(bytes->data(), bytes->size(), 0, format.c_str());
  if (scene == nullptr) return refuse("cannot be read as ." + format + ": " + importer.GetErrorString());

  Welder welder;
  for (const aiMesh* part : std::vector<aiMesh*>(scene->mMeshes, scene->mMeshes + scene->mNumMeshes)) {
    for (unsigned k = 0; k < part->mNumFaces; ++k) {
      if (auto fault = add_face(*part, part->mFaces[k], scale, welder); !fault.empty()) return refuse(std::move(fault));
    }
  }
  Mesh mesh = welder.take();
  if (mesh.triangles.empty()) return refuse("holds no triangles, expected a surface");
  return mesh;
}

}  // namespace interlace::mesh
