#include "modeller/shapes_file.hpp"

#include <filesystem>

#include "common/app/config/document.hpp"
#include "common/app/config/field.hpp"
#include "common/app/config/pose_section.hpp"
#include "common/app/config/preamble.hpp"
#include "modeller/cover.hpp"

namespace interlace::modeller {

namespace {

using app::Field;
using app::Units;

std::optional<Shape> read_shape(const Field& field, const Units& units, const std::filesystem::path& folder) {
  const auto mapping = field.mapping({"link", "mesh", "units", "frame", "capsules"});
  if (!mapping) return std::nullopt;
  const auto link_field = mapping->require("link");
  const auto mesh_field = mapping->require("mesh");
  const auto link = link_field ? link_field->integer(0, model::kJoints) : std::nullopt;
  const auto mesh = mesh_field ? mesh_field->text() : std::nullopt;
  Shape shape;
  shape.scale = 1 / units.per_metre;
  if (const auto own = mapping->find("units")) shape.scale = own->one_of({"mm", "m"}) == 1U ? 1 : 0.001;
  if (const auto frame = mapping->find("frame")) shape.X_LM = app::read_pose(*frame, units).value_or(shape.X_LM);
  if (const auto most = mapping->find("capsules")) {
    if (const auto count = most->integer(1, static_cast<int>(kMostCapsules))) shape.capsules = static_cast<std::size_t>(*count);
  }
  if (!link || !mesh) return std::nullopt;
  shape.link = static_cast<std::size_t>(*link);
  shape.file = (folder / *mesh).string();
  return shape;
}

std::vector<Shape> read_shapes(const Field& file, const std::filesystem::path& folder) {
  std::vector<Shape> shapes;
  const auto mapping = file.mapping({"interlace", "units", "shapes"});
  if (!mapping) return shapes;
  const Units units = app::read_preamble(*mapping);
  const auto list = mapping->require("shapes");
  const auto items = list ? list->items("shapes") : std::nullopt;
  if (!items) return shapes;
  if (items->empty()) list->refuse("expected at least one shape");
  for (const Field& item : *items) {
    if (auto shape = read_shape(item, units, folder)) shapes.push_back(std::move(*shape));
  }
  return shapes;
}

}  // namespace

model::Result<std::vector<Shape>, app::ConfigError> load_shapes(const std::string& path) {
  app::Findings findings{path};
  const auto text = app::read_file(path, findings);
  const auto document = text ? app::parse_document(*text, findings) : std::nullopt;
  if (!document) return model::unexpected{findings.error()};
  auto shapes = read_shapes(Field{*document, "", findings}, std::filesystem::path{path}.parent_path());
  if (!findings.none()) return model::unexpected{findings.error()};
  return shapes;
}

}  // namespace interlace::modeller
