#include "common/app/config/model_text.hpp"

#include <fmt/format.h>

#include <sstream>

#include "common/app/config/number_text.hpp"
#include "common/app/config/quantity.hpp"
#include "common/app/config/text_buffer.hpp"

namespace interlace::app {

namespace {

void write_kinematics(TextBuffer& out, const model::OpwParameters& p, const Units& units) {
  const auto length = [&](double value) { return number_text(value, units.per_metre); };
  append(out, "    kinematics: {{type: opw, a1: {}, a2: {}, b: {}, c1: {}, c2: {}, c3: {}, c4: {}", length(p.a1), length(p.a2), length(p.b),
         length(p.c1), length(p.c2), length(p.c3), length(p.c4));
  const model::OpwParameters plain;
  if (p.offsets != plain.offsets) {
    append(out, ", offsets: [{}]", numbers_text(Eigen::Map<const model::Joints>{p.offsets.data()}, units.per_radian));
  }
  if (p.signs != plain.signs) append(out, ", signs: [{}]", fmt::join(p.signs, ", "));
  append(out, "}}\n");
}

void write_joints(TextBuffer& out, const model::JointLimits& limits, const Units& units) {
  append(out, "    joints: {{min: [{}], max: [{}]", numbers_text(limits.min, units.per_radian), numbers_text(limits.max, units.per_radian));
  if (limits.velocity) append(out, ", velocity: [{}]", numbers_text(*limits.velocity, units.per_radian));
  if (limits.acceleration) append(out, ", acceleration: [{}]", numbers_text(*limits.acceleration, units.per_radian));
  append(out, "}}\n");
}

void write_self_pairs(TextBuffer& out, const model::RobotModel& model) {
  std::vector<std::string> pairs;
  for (const auto& [i, j] : model.self_pairs) pairs.push_back(fmt::format("[{}, {}]", model.capsules[i].name, model.capsules[j].name));
  append(out, "    self_collision: [{}]\n", fmt::join(pairs, ", "));
}

}  // namespace

std::string model_text(const model::RobotModel& model, const std::string& comment) {
  const Units units;  // mm and deg
  TextBuffer out;
  std::istringstream lines{comment};
  for (std::string line; std::getline(lines, line);) append(out, "# {}\n", line);
  append(out, "models:  # lengths in {}, angles in {}\n  {}:\n", units.length, units.angle, model.name);
  write_kinematics(out, model.kinematics.parameters(), units);
  write_joints(out, model.joints, units);
  if (!model.X_FT.isApprox(model::Pose::Identity(), 0)) {
    append(out, "    tool: {{xyz: [{}], rpy: [{}]}}\n", numbers_text(model.X_FT.translation(), units.per_metre),
           numbers_text(model::rpy_of(model.X_FT.linear()), units.per_radian));
  }
  append(out, "    capsules:\n");
  for (const model::LinkCapsule& c : model.capsules) {
    append(out, "      - {{name: {}, link: {}, from: [{}], to: [{}], radius: {}}}\n", c.name, c.link, numbers_text(c.a, units.per_metre),
           numbers_text(c.b, units.per_metre), number_text(c.radius, units.per_metre));
  }
  if (model.self_pairs != model::default_self_pairs(model.capsules)) write_self_pairs(out, model);
  return fmt::to_string(out);
}

}  // namespace interlace::app
