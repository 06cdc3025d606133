#include "monitor/scene.hpp"

#include <nlohmann/json.hpp>

#include "monitor/numbers.hpp"

namespace interlace::monitor {

namespace {

nlohmann::json pose_json(const model::Pose& X) {
  const model::Quaternion q{X.rotation()};
  return {{"p", metres(X.translation())}, {"q", {rounded(q.w(), 6), rounded(q.x(), 6), rounded(q.y(), 6), rounded(q.z(), 6)}}};
}

/// The shape by its kind, in the fixture's own frame.
struct ShapeJson {
  nlohmann::json operator()(const model::SphereShape& s) const { return {{"kind", "sphere"}, {"radius", metres(s.radius)}}; }
  nlohmann::json operator()(const model::BoxShape& s) const { return {{"kind", "box"}, {"size", metres(model::Vector3{2 * s.half})}}; }
  nlohmann::json operator()(const model::CylinderShape& s) const {
    return {{"kind", "cylinder"}, {"radius", metres(s.radius)}, {"length", metres(2 * s.half_length)}};
  }
  nlohmann::json operator()(const model::PlaneShape& s) const {
    return {{"kind", "plane"}, {"normal", metres(s.normal)}, {"offset", metres(s.offset)}};
  }
  nlohmann::json operator()(const model::MeshShape& s) const {
    nlohmann::json vertices = nlohmann::json::array(), triangles = nlohmann::json::array();
    for (const auto& p : s.mesh->vertices()) {
      for (int i = 0; i < 3; ++i) vertices.push_back(metres(p[i]));
    }
    for (const auto& t : s.mesh->triangles()) {
      for (const auto corner : t) triangles.push_back(corner);
    }
    return {{"kind", "mesh"}, {"vertices", std::move(vertices)}, {"triangles", std::move(triangles)}};
  }
};

}  // namespace

nlohmann::json bodies_json(const model::Robot& robot) {
  nlohmann::json links = nlohmann::json::array(), radii = nlohmann::json::array();
  for (const auto& capsule : robot.model.capsules) {
    links.push_back(capsule.name);
    radii.push_back(metres(capsule.radius));
  }
  return {{"links", std::move(links)}, {"radii", std::move(radii)}};
}

nlohmann::json scene_json(const model::Cell& cell, const Pairs& pairs) {
  nlohmann::json robots = nlohmann::json::array(), fixtures = nlohmann::json::array(), named = nlohmann::json::array();
  for (const model::Robot& robot : cell.robots) {
    nlohmann::json json = bodies_json(robot);
    json["name"] = robot.name.str();
    json["model"] = robot.model.name;
    json["base"] = pose_json(robot.X_WB);
    robots.push_back(std::move(json));
  }
  for (const model::Fixture& fixture : cell.fixtures) {
    nlohmann::json json = std::visit(ShapeJson{}, fixture.shape);
    json["name"] = fixture.name;
    json["pose"] = pose_json(fixture.X_WO);
    fixtures.push_back(std::move(json));
  }
  for (const auto& [a, b] : pairs) named.push_back({cell.robots[a].name.str(), cell.robots[b].name.str()});
  return {{"cell", cell.name}, {"robots", std::move(robots)}, {"fixtures", std::move(fixtures)}, {"pairs", std::move(named)}};
}

}  // namespace interlace::monitor
