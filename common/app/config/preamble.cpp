#include "common/app/config/preamble.hpp"

namespace interlace::app {

namespace {

void check_version(const Mapping& file) {
  const auto version = file.require("interlace");
  if (!version) return;
  const auto text = version->text();
  if (text && *text != "1") version->refuse("expected 1, the only version of the format this program knows");
}

}  // namespace

Units read_preamble(const Mapping& file) {
  Units units;
  check_version(file);
  const auto field = file.require("units");
  const auto mapping = field ? field->mapping({"length", "angle"}) : std::nullopt;
  if (!mapping) return units;
  if (const auto length = mapping->require("length")) {
    if (length->one_of({"mm", "m"}) == 1U) {
      units.per_metre = 1;
      units.length = "m";
    }
  }
  if (const auto angle = mapping->require("angle")) {
    if (angle->one_of({"deg", "rad"}) == 1U) {
      units.per_radian = 1;
      units.angle = "rad";
    }
  }
  return units;
}

}  // namespace interlace::app
