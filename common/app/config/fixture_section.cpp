#include "common/app/config/fixture_section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>

#include "common/app/config/pose_section.hpp"

namespace interlace::app {

namespace {

using model::Shape;
using model::Vector3;

/// Keys of each type beside `name`, `type` and, for all but planes, `pose`.
const std::map<std::string, std::vector<std::string>>& keys_of_types() {
  static const std::map<std::string, std::vector<std::string>> keys{{"box", {"pose", "size"}},
                                                                    {"cylinder", {"pose", "radius", "length"}},
                                                                    {"mesh", {"pose", "file", "scale", "solid"}},
                                                                    {"plane", {"normal", "offset"}},
                                                                    {"sphere", {"pose", "radius"}}};
  return keys;
}

std::optional<double> required(const Mapping& mapping, const std::string& key, const Quantity& quantity) {
  const auto field = mapping.require(key);
  return field ? field->number(quantity) : std::nullopt;
}

std::optional<Vector3> required_vector(const Mapping& mapping, const std::string& key, const Quantity& quantity) {
  const auto field = mapping.require(key);
  return field ? field->vector(quantity) : std::nullopt;
}

std::optional<Shape> read_plane(const Mapping& mapping, const Units& units) {
  constexpr double kShortest = 1e-6;
  const auto normal = required_vector(mapping, "normal", Quantity{1, "", -1e6, 1e6, false});
  const auto offset = required(mapping, "offset", coordinate(units));
  if (!normal || !offset) return std::nullopt;
  if (normal->norm() < kShortest) {
    mapping.find("normal")->refuse("expected a direction out of the material, such as [0, 0, 1] for a floor");
    return std::nullopt;
  }
  return model::PlaneShape{normal->normalized(), *offset};
}

class FixtureReader {
 public:
  FixtureReader(const Units& units, const std::string& file_name, const MeshReader& meshes)
      : units_(units), folder_(std::filesystem::path(file_name).parent_path()), meshes_(meshes) {}

  std::optional<model::Fixture> read(const Field& field) {
    const auto mapping = field.mapping({"name", "type", "pose", "size", "radius", "length", "normal", "offset", "file", "scale", "solid"});
    if (!mapping) return std::nullopt;
    model::Fixture fixture;
    const bool named = read_name(*mapping, field.key(), fixture);
    const auto type = read_type(*mapping);
    if (!type) return std::nullopt;
    const bool plain = only_keys_of(*type, *mapping);
    bool placed = true;
    if (const auto pose = mapping->find("pose"); pose && *type != "plane") {
      const auto X_WO = read_pose(*pose, units_);
      placed = X_WO.has_value();
      fixture.X_WO = X_WO.value_or(fixture.X_WO);
    }
    const auto shape = read_shape(*type, *mapping);
    if (!named || !plain || !placed || !shape) return std::nullopt;
    fixture.shape = *shape;
    return fixture;
  }

 private:
  bool read_name(const Mapping& mapping, const std::string& key, model::Fixture& fixture) {
    const auto field = mapping.require("name");
    const auto name = field ? field->name() : std::nullopt;
    if (!name) return false;
    fixture.name = *name;
    const auto [entry, fresh] = names_.emplace(*name, key);
    if (!fresh) field->refuse("expected a name of its own: " + entry->second + " has it already");
    return fresh;
  }

  static std::optional<std::string> read_type(const Mapping& mapping) {
    std::vector<std::string> types;
    for (const auto& entry : keys_of_types()) types.push_back(entry.first);
    const auto field = mapping.require("type");
    const auto index = field ? field->one_of(types) : std::nullopt;
    return index ? std::optional{types[*index]} : std::nullopt;
  }

  static bool only_keys_of(const std::string& type, const Mapping& mapping) {
    const auto& keys = keys_of_types().at(type);
    bool good = true;
    for (const auto& [key, field] : mapping.entries()) {
      if (key == "name" || key == "type" || std::find(keys.begin(), keys.end(), key) != keys.end()) continue;
      field.complain(fmt::format("a {} has no {}; it has {}", type, key, fmt::join(keys, ", ")));
      good = false;
    }
    return good;
  }

  std::optional<Shape> read_shape(const std::string& type, const Mapping& mapping) const {
    const Quantity length = positive_length(units_);
    if (type == "plane") return read_plane(mapping, units_);
    if (type == "mesh") return read_mesh(mapping);
    if (type == "box") {
      const auto size = required_vector(mapping, "size", length);
      return size ? std::optional<Shape>{model::BoxShape{*size / 2}} : std::nullopt;
    }
    const auto radius = required(mapping, "radius", length);
    if (type == "sphere") return radius ? std::optional<Shape>{model::SphereShape{*radius}} : std::nullopt;
    const auto whole = required(mapping, "length", length);
    return radius && whole ? std::optional<Shape>{model::CylinderShape{*radius, *whole / 2}} : std::nullopt;
  }

  std::optional<Shape> read_mesh(const Mapping& mapping) const {
    const auto file = mapping.require("file");
    const auto path = file ? file->text() : std::nullopt;
    std::optional<double> scale = 1;
    if (const auto field = mapping.find("scale")) scale = field->number(Quantity{1, "", 1e-6, 1e6, true});
    bool solid = true;
    if (const auto field = mapping.find("solid")) {
      const auto choice = field->one_of({"true", "false"});
      if (!choice) return std::nullopt;
      solid = *choice == 0;
    }
    if (!path || !scale) return std::nullopt;
    const auto mesh = meshes_ ? meshes_((folder_ / *path).string(), *scale / units_.per_metre, solid)
                              : model::unexpected(std::string{"a mesh can only be read together with a cell file on disk"});
    if (!mesh) {
      file->refuse(mesh.error());
      return std::nullopt;
    }
    if ((*mesh)->triangles().size() > kMaxTriangles) {
      file->refuse(fmt::format("expected at most {} triangles, it has {}", kMaxTriangles, (*mesh)->triangles().size()));
      return std::nullopt;
    }
    if (const std::size_t open = solid ? (*mesh)->open_edges() : 0; open > 0) {
      file->refuse(fmt::format(
          "expected a closed surface, but {} of its edges are open: close it, or say solid: false when nothing can be inside", open));
      return std::nullopt;
    }
    return model::MeshShape{*mesh};
  }

  const Units& units_;
  std::filesystem::path folder_;
  const MeshReader& meshes_;
  std::map<std::string, std::string> names_;  // and the keys of the fixtures that have them
};

}  // namespace

std::vector<model::Fixture> read_fixtures(const Field& field, const Units& units, const std::string& file_name, const MeshReader& meshes) {
  std::vector<model::Fixture> fixtures;
  const auto items = field.items("fixtures");
  if (!items) return fixtures;
  if (items->size() > kMaxFixtures) {
    field.refuse(fmt::format("expected at most {} fixtures", kMaxFixtures));
    return fixtures;
  }
  FixtureReader reader{units, file_name, meshes};
  for (const auto& item : *items) {
    auto fixture = reader.read(item);
    if (fixture) fixtures.push_back(std::move(*fixture));
  }
  return fixtures;
}

}  // namespace interlace::app
