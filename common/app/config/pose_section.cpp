#include "common/app/config/pose_section.hpp"

#include <fmt/format.h>

namespace interlace::app {

namespace {

using model::Branch;
using model::Joints;
using model::Pose;
using model::RobotModel;

std::optional<Pose> pose_in(const Mapping& mapping, const Units& units) {
  const auto xyz = mapping.require("xyz");
  const auto rpy = mapping.require("rpy");
  const auto p = xyz ? xyz->vector(coordinate(units)) : std::nullopt;
  const auto angles = rpy ? rpy->vector(angle(units)) : std::nullopt;
  if (!p || !angles) return std::nullopt;
  return model::make_pose(*p, model::rotation_from_rpy(*angles));
}

/// Which branches a `posture` key lets through.
struct PostureChoice {
  std::optional<Branch::Shoulder> shoulder;
  std::optional<Branch::Elbow> elbow;
  std::optional<Branch::Wrist> wrist;

  [[nodiscard]] bool admits(const Branch& b) const {
    return (!shoulder || *shoulder == b.shoulder) && (!elbow || *elbow == b.elbow) && (!wrist || *wrist == b.wrist);
  }
};

/// False after a complaint.
template <typename Choice>
bool choose(const Mapping& mapping, const std::string& key, const std::string& first, const std::string& second,
            std::optional<Choice>& out) {
  const auto field = mapping.find(key);
  if (!field) return true;
  const auto index = field->one_of({first, second});
  if (index) out = static_cast<Choice>(*index);
  return index.has_value();
}

std::optional<PostureChoice> read_choice(const Field& field) {
  const auto mapping = field.mapping({"shoulder", "elbow", "wrist"});
  if (!mapping) return std::nullopt;
  PostureChoice choice;
  const bool shoulder = choose(*mapping, "shoulder", "front", "back", choice.shoulder);
  const bool elbow = choose(*mapping, "elbow", "up", "down", choice.elbow);
  const bool wrist = choose(*mapping, "wrist", "positive", "negative", choice.wrist);
  if (!shoulder || !elbow || !wrist) return std::nullopt;
  return choice;
}

std::string outside_limits(const RobotModel& model, const Joints& q, const Units& units) {
  const auto joint = model::joint_outside_limits(model.joints, q);
  if (!joint) return "";
  const std::size_t i = *joint;
  const Quantity unit = angle(units);
  return fmt::format("joint {} would be at {}, outside its limits {} to {}", i + 1, show(q[i], unit), show(model.joints.min[i], unit),
                     show(model.joints.max[i], unit));
}

/// Why none of the admitted branches brings the TCP to `X_BT`.
std::string why_unreachable(const RobotModel& model, const Pose& X_BT, const PostureChoice& choice, const Units& units) {
  const Pose X_BF = X_BT * model.X_FT.inverse();
  for (const auto& branch : model::all_branches()) {
    if (!choice.admits(branch)) continue;
    const auto q = model.kinematics.inverse(X_BF, branch);
    if (q) return "outside the joint limits of model " + model.name + " in every posture: at best " + outside_limits(model, *q, units);
  }
  const auto& p = model.kinematics.parameters();
  const double distance = (model.kinematics.wrist_centre(X_BF) - model::Vector3{0, 0, p.c1}).norm();
  return fmt::format("unreachable for model {}: its wrist would be {} from its shoulder, it reaches {}", model.name,
                     show(distance, coordinate(units)), show(std::abs(p.a1) + p.c2 + model.kinematics.forearm_length(), coordinate(units)));
}

}  // namespace

std::optional<Pose> read_pose(const Field& field, const Units& units) {
  const auto mapping = field.mapping({"xyz", "rpy"});
  return mapping ? pose_in(*mapping, units) : std::nullopt;
}

std::optional<Joints> read_posture(const Field& field, const RobotModel& model, const Pose& X_WB, const Units& units) {
  const auto mapping = field.mapping({"xyz", "rpy", "posture", "joints"});
  if (!mapping) return std::nullopt;
  if (const auto joints = mapping->find("joints")) {
    if (mapping->entries().size() > 1) {
      field.refuse("expected either joints or a pose, not both");
      return std::nullopt;
    }
    auto q = joints->joints(angle(units));
    if (!q || !model::joint_outside_limits(model.joints, *q)) return q;
    joints->refuse(outside_limits(model, *q, units));
    return std::nullopt;
  }
  PostureChoice choice;
  if (const auto posture = mapping->find("posture")) {
    const auto read = read_choice(*posture);
    if (!read) return std::nullopt;
    choice = *read;
  }
  const auto X_WT = pose_in(*mapping, units);
  if (!X_WT) return std::nullopt;
  const Pose X_BT = X_WB.inverse() * *X_WT;
  auto q = model::preferred_posture(model, X_BT, [&](const Branch& branch) { return choice.admits(branch); });
  if (!q) field.refuse(why_unreachable(model, X_BT, choice, units));
  return q;
}

}  // namespace interlace::app
