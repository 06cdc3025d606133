#include "modeller/fitted_shape.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

namespace interlace::modeller {

namespace {

std::string name_of(std::size_t link) {
  if (link == 0) return "base";
  return link == model::kJoints ? "flange" : fmt::format("link{}", link);
}

std::array<double, 3> numbers(const model::Vector3& p) {
  return {p.x(), p.y(), p.z()};
}

}  // namespace

model::Result<FittedShape, mesh::MeshError> fit(const Shape& shape, CoverOptions options) {
  auto mesh = mesh::read_mesh(shape.file, shape.scale);
  if (!mesh) return model::unexpected{mesh.error()};
  for (model::Vector3& p : mesh->vertices) p = shape.X_LM * p;
  options.capsules = shape.capsules.value_or(options.capsules);
  return FittedShape{shape, mesh->vertices.size(), mesh->triangles.size(), cover(*mesh, options)};
}

std::vector<model::LinkCapsule> link_capsules(const std::vector<FittedShape>& fitted) {
  std::array<std::size_t, model::kJoints + 1> all{};
  for (const FittedShape& f : fitted) all[f.shape.link] += f.cover.capsules.size();
  std::array<std::size_t, model::kJoints + 1> given{};
  std::vector<model::LinkCapsule> capsules;
  for (const FittedShape& f : fitted) {
    const std::size_t link = f.shape.link;
    for (const model::Capsule& c : f.cover.capsules) {
      const std::string name = all[link] == 1 ? name_of(link) : fmt::format("{}-{}", name_of(link), ++given[link]);
      capsules.push_back({name, link, c.a, c.b, c.radius});
    }
  }
  return capsules;
}

std::string describe(const FittedShape& fitted) {
  const Cover& c = fitted.cover;
  const char* body = c.watertight ? "the mesh" : "its convex hull (the mesh is not watertight)";
  const std::string excess = c.body_volume > 0 ? fmt::format("{:.1f} % more volume than {}", 100 * c.excess(), body)
                                               : fmt::format("{:.3g} l around a shape without volume", 1000 * c.volume);
  return fmt::format("{} ({}): {} capsule{}, all {} vertices inside by {:.3g} to {:.3g} mm, {}", name_of(fitted.shape.link),
                     fitted.shape.file, c.capsules.size(), c.capsules.size() == 1 ? "" : "s", fitted.vertices, 1000 * c.least_depth,
                     1000 * c.most_depth, excess);
}

nlohmann::json to_json(const FittedShape& fitted) {
  const Cover& c = fitted.cover;
  auto capsules = nlohmann::json::array();
  for (const model::Capsule& capsule : c.capsules) {
    capsules.push_back({{"from_m", numbers(capsule.a)}, {"to_m", numbers(capsule.b)}, {"radius_m", capsule.radius}});
  }
  return {{"link", fitted.shape.link},       {"mesh", fitted.shape.file},
          {"vertices", fitted.vertices},     {"triangles", fitted.triangles},
          {"capsules", std::move(capsules)}, {"inside_m", {{"least", c.least_depth}, {"most", c.most_depth}}},
          {"volume_m3", c.volume},           {"body", c.watertight ? "mesh" : "convex hull"},
          {"body_volume_m3", c.body_volume}, {"excess", c.body_volume > 0 ? nlohmann::json(c.excess()) : nlohmann::json(nullptr)}};
}

}  // namespace interlace::modeller
