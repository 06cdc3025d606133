#include "common/app/config/capsule_section.hpp"

namespace interlace::app {

std::optional<model::Capsule> read_capsule_shape(const Mapping& mapping, const Units& units) {
  const auto from = mapping.require("from");
  const auto to = mapping.require("to");
  const auto radius = mapping.require("radius");
  const auto a = from ? from->vector(coordinate(units)) : std::nullopt;
  const auto b = to ? to->vector(coordinate(units)) : std::nullopt;
  const auto r = radius ? radius->number(positive_length(units)) : std::nullopt;
  if (!a || !b || !r) return std::nullopt;
  return model::Capsule{*a, *b, *r};
}

}  // namespace interlace::app
