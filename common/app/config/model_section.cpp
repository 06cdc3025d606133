#include "common/app/config/model_section.hpp"

#include <algorithm>
#include <cmath>

#include "common/app/config/capsule_section.hpp"
#include "common/app/config/pose_section.hpp"

namespace interlace::app {

namespace {

using model::kJoints;
using model::LinkCapsule;
using model::OpwParameters;

std::optional<std::array<int, kJoints>> read_signs(const Field& field) {
  const auto items = field.items("6 signs, each 1 or -1");
  if (!items) return std::nullopt;
  if (items->size() != kJoints) {
    field.refuse("expected a list of 6 signs, each 1 or -1");
    return std::nullopt;
  }
  std::array<int, kJoints> signs{};
  for (std::size_t i = 0; i < kJoints; ++i) {
    const auto index = (*items)[i].one_of({"1", "-1"});
    if (!index) return std::nullopt;
    signs[i] = *index == 0 ? 1 : -1;
  }
  return signs;
}

std::optional<OpwParameters> read_kinematics(const Field& field, const Units& units) {
  const auto mapping = field.mapping({"type", "a1", "a2", "b", "c1", "c2", "c3", "c4", "offsets", "signs"});
  if (!mapping) return std::nullopt;
  OpwParameters p;
  bool good = true;
  const auto type = mapping->require("type");
  good = type && type->one_of({"opw"}).has_value() && good;
  const auto number = [&](const char* key, const Quantity& quantity, double& out) {
    const auto value = mapping->require(key);
    const auto read = value ? value->number(quantity) : std::nullopt;
    good = good && read.has_value();
    out = read.value_or(0);
  };
  number("a1", coordinate(units), p.a1);
  number("a2", coordinate(units), p.a2);
  number("b", coordinate(units), p.b);
  number("c1", length(units), p.c1);
  number("c2", positive_length(units), p.c2);
  number("c3", positive_length(units), p.c3);
  number("c4", length(units), p.c4);
  if (const auto offsets = mapping->find("offsets")) {
    const auto q = offsets->joints(angle(units));
    good = good && q.has_value();
    for (std::size_t i = 0; q && i < kJoints; ++i) p.offsets[i] = (*q)[i];
  }
  if (const auto signs = mapping->find("signs")) {
    const auto read = read_signs(*signs);
    good = good && read.has_value();
    p.signs = read.value_or(p.signs);
  }
  return good ? std::optional{p} : std::nullopt;
}

/// Reads the rates of `key` [per second or per second²], all > 0.
bool read_rates(const Mapping& mapping, const std::string& key, const Quantity& quantity, std::optional<model::Joints>& out) {
  const auto field = mapping.find(key);
  if (!field) return true;
  out = field->joints(quantity);
  return out.has_value();
}

std::optional<model::JointLimits> read_joints(const Field& field, const Units& units) {
  const auto mapping = field.mapping({"min", "max", "velocity", "acceleration"});
  if (!mapping) return std::nullopt;
  model::JointLimits limits;
  const bool velocity = read_rates(*mapping, "velocity", angular_speed(units), limits.velocity);
  const bool acceleration = read_rates(*mapping, "acceleration", angular_acceleration(units), limits.acceleration);
  const auto min = mapping->find("min");
  const auto max = mapping->find("max");
  if (min.has_value() != max.has_value()) {
    field.complain_missing(min ? "max" : "min");
    return std::nullopt;
  }
  if (min) {
    const auto low = min->joints(angle(units));
    const auto high = max->joints(angle(units));
    if (!low || !high) return std::nullopt;
    for (std::size_t i = 0; i < kJoints; ++i) {
      if ((*low)[i] < (*high)[i]) continue;
      min->refuse("expected min < max, but joint " + std::to_string(i + 1) + " has " + show((*low)[i], angle(units)) + " and " +
                  show((*high)[i], angle(units)));
      return std::nullopt;
    }
    limits.min = *low;
    limits.max = *high;
  }
  return velocity && acceleration ? std::optional{limits} : std::nullopt;
}

std::optional<std::vector<LinkCapsule>> read_chain(const Field& field, const OpwParameters& p, const model::Pose& X_FT,
                                                   const Units& units) {
  const auto radii = field.numbers(4, positive_length(units));
  if (!radii) return std::nullopt;
  if (p.a1 != 0 || p.a2 != 0 || p.b != 0) {
    field.refuse("a chain needs an arm without offsets (a1 = a2 = b = 0); list the capsules with link, from, to and radius");
    return std::nullopt;
  }
  return model::chain_capsules(p, X_FT, {(*radii)[0], (*radii)[1], (*radii)[2], (*radii)[3]});
}

std::optional<LinkCapsule> read_capsule(const Field& field, const Units& units) {
  const auto mapping = field.mapping({"name", "link", "from", "to", "radius"});
  if (!mapping) return std::nullopt;
  const auto name = mapping->require("name");
  const auto link = mapping->require("link");
  const auto shape = read_capsule_shape(*mapping, units);
  const auto text = name ? name->name() : std::nullopt;
  const auto number = link ? link->integer(0, 6) : std::nullopt;
  if (!text || !number || !shape) return std::nullopt;
  return LinkCapsule{*text, static_cast<std::size_t>(*number), shape->a, shape->b, shape->radius};
}

std::optional<std::vector<LinkCapsule>> read_capsule_list(const Field& field, const Units& units) {
  const auto items = field.items("capsules");
  if (!items) return std::nullopt;
  if (items->empty() || items->size() > kMaxCapsules) {
    field.refuse("expected 1 to " + std::to_string(kMaxCapsules) + " capsules");
    return std::nullopt;
  }
  std::vector<LinkCapsule> capsules;
  for (const auto& item : *items) {
    auto capsule = read_capsule(item, units);
    if (!capsule) continue;
    const bool taken = std::any_of(capsules.begin(), capsules.end(), [&](const LinkCapsule& other) { return other.name == capsule->name; });
    if (taken) item.complain("expected a name of its own: there is another capsule \"" + capsule->name + "\"");
    if (!taken) capsules.push_back(std::move(*capsule));
  }
  return capsules.size() == items->size() ? std::optional{capsules} : std::nullopt;
}

std::optional<std::vector<LinkCapsule>> read_capsules(const Field& field, const OpwParameters& p, const model::Pose& X_FT,
                                                      const Units& units) {
  if (field.is_list()) return read_capsule_list(field, units);
  if (!field.is_mapping()) {
    field.refuse("expected {chain: [4 radii]} or a list of capsules");
    return std::nullopt;
  }
  const auto mapping = field.mapping({"chain"});
  const auto chain = mapping ? mapping->require("chain") : std::nullopt;
  return chain ? read_chain(*chain, p, X_FT, units) : std::nullopt;
}

using SelfPairs = std::vector<std::pair<std::size_t, std::size_t>>;

std::optional<SelfPairs> read_self_pairs(const Field& field, const std::vector<LinkCapsule>& capsules) {
  const auto items = field.items("pairs of capsule names");
  if (!items) return std::nullopt;
  std::vector<std::string> names;
  names.reserve(capsules.size());
  for (const auto& capsule : capsules) names.push_back(capsule.name);
  SelfPairs pairs;
  for (const auto& item : *items) {
    const auto pair = item.items("two capsule names");
    if (!pair) continue;
    if (pair->size() != 2) {
      item.refuse("expected a list of two capsule names");
      continue;
    }
    const auto first = (*pair)[0].one_of(names);
    const auto second = (*pair)[1].one_of(names);
    if (!first || !second) continue;
    if (*first == *second) {
      item.refuse("expected two different capsules");
      continue;
    }
    pairs.emplace_back(std::min(*first, *second), std::max(*first, *second));
  }
  if (pairs.size() != items->size()) return std::nullopt;
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

}  // namespace

std::optional<model::RobotModel> read_model(const std::string& name, const Field& field, const Units& units) {
  const auto mapping = field.mapping({"kinematics", "joints", "tool", "capsules", "self_collision"});
  if (!mapping) return std::nullopt;
  model::RobotModel model;
  model.name = name;

  const auto kinematics = mapping->require("kinematics");
  const auto parameters = kinematics ? read_kinematics(*kinematics, units) : std::nullopt;
  bool good = parameters.has_value();
  if (parameters) model.kinematics = model::Kinematics{*parameters};

  if (const auto joints = mapping->find("joints")) {
    const auto limits = read_joints(*joints, units);
    good = good && limits.has_value();
    model.joints = limits.value_or(model.joints);
  }
  if (const auto tool = mapping->find("tool")) {
    const auto X_FT = read_pose(*tool, units);
    good = good && X_FT.has_value();
    model.X_FT = X_FT.value_or(model.X_FT);
  }
  const auto capsules_field = mapping->require("capsules");
  const auto capsules =
      capsules_field ? read_capsules(*capsules_field, parameters.value_or(OpwParameters{}), model.X_FT, units) : std::nullopt;
  if (!capsules) return std::nullopt;
  model.capsules = *capsules;
  model.self_pairs = model::default_self_pairs(model.capsules);
  if (const auto self_collision = mapping->find("self_collision")) {
    const auto pairs = read_self_pairs(*self_collision, model.capsules);
    good = good && pairs.has_value();
    model.self_pairs = pairs.value_or(model.self_pairs);
  }
  return good ? std::optional{model} : std::nullopt;
}

}  // namespace interlace::app
