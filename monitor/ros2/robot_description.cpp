#include "monitor/ros2/robot_description.hpp"

#include <fmt/format.h>

#include "monitor/ros2/frames.hpp"

namespace interlace::monitor {

namespace {

// Numbers are written with all their digits: what reads them computes the same poses.

std::string origin(const model::Pose& X) {
  const model::Vector3 p = X.translation();
  const model::Vector3 rpy = model::rpy_of(X.rotation());
  return fmt::format(R"(<origin xyz="{} {} {}" rpy="{} {} {}"/>)", p.x(), p.y(), p.z(), rpy.x(), rpy.y(), rpy.z());
}

/// To be seen and to be collided with.
std::string solid(const model::Pose& X, const std::string& geometry) {
  const std::string inside = origin(X) + "<geometry>" + geometry + "</geometry>";
  return "    <visual>" + inside + "</visual>\n    <collision>" + inside + "</collision>\n";
}

std::string capsule_solids(const model::LinkCapsule& c) {
  const std::string ball = fmt::format(R"(<sphere radius="{}"/>)", c.radius);
  const auto at = [](const model::Vector3& p) { return model::make_pose(p, model::Quaternion::Identity()); };
  const model::Vector3 along = c.b - c.a;
  const double length = along.norm();
  if (length <= 0) return solid(at(c.a), ball);
  const model::Pose X_LC = model::make_pose((c.a + c.b) / 2, model::Quaternion::FromTwoVectors(model::Vector3::UnitZ(), along));
  return solid(X_LC, fmt::format(R"(<cylinder radius="{}" length="{}"/>)", c.radius, length)) + solid(at(c.a), ball) + solid(at(c.b), ball);
}

std::string fixed_joint(const std::string& parent, const std::string& child, const model::Pose& X) {
  return fmt::format(R"(  <joint name="{1}_mount" type="fixed"><parent link="{0}"/><child link="{1}"/>{2}</joint>)"
                     "\n",
                     parent, child, origin(X));
}

/// Axis of each joint, in its own frame as in its parent's.
model::Vector3 axis_of(std::size_t joint) {
  return joint == 1 || joint == 2 || joint == 4 ? model::Vector3::UnitY() : model::Vector3::UnitZ();
}

/// How the links hang together: frames at the angles at which every formula's own angle is zero, turned back by the offset of the joint.
std::string revolute_joint(const model::Robot& robot, std::size_t joint, const model::Vector3& p) {
  const model::OpwParameters& opw = robot.model.kinematics.parameters();
  const model::JointLimits& limits = robot.model.joints;
  const auto i = static_cast<Eigen::Index>(joint);
  const model::Vector3 axis = opw.signs[joint] * axis_of(joint);
  const model::Pose X = model::make_pose(p, model::Quaternion{Eigen::AngleAxisd{-opw.offsets[joint], axis_of(joint)}});
  return fmt::format(R"(  <joint name="{}" type="revolute"><parent link="{}"/><child link="{}"/>{})"
                     R"(<axis xyz="{} {} {}"/><limit lower="{}" upper="{}" effort="0" velocity="{}"/></joint>)"
                     "\n",
                     joint_name(robot.name, joint), link_frame(robot.name, joint), link_frame(robot.name, joint + 1), origin(X), axis.x(),
                     axis.y(), axis.z(), limits.min[i], limits.max[i], limits.velocity ? (*limits.velocity)[i] : 0.0);
}

std::string arm(const model::Robot& robot) {
  const model::OpwParameters& opw = robot.model.kinematics.parameters();
  const std::array<model::Vector3, model::kJoints> places{model::Vector3::Zero(), {opw.a1, 0, opw.c1},    {0, opw.b, opw.c2},
                                                          {opw.a2, 0, opw.c3},    model::Vector3::Zero(), model::Vector3{0, 0, opw.c4}};
  std::string xml;
  for (std::size_t link = 0; link <= model::kJoints; ++link) {
    xml += fmt::format("  <link name=\"{}\">\n", link_frame(robot.name, link));
    for (const model::LinkCapsule& c : robot.model.capsules) {
      if (c.link == link) xml += capsule_solids(c);
    }
    xml += "  </link>\n";
  }
  xml += fmt::format("  <link name=\"{}\"/>\n", tcp_frame(robot.name));
  xml += fixed_joint(kWorldFrame, link_frame(robot.name, 0), robot.X_WB);
  for (std::size_t joint = 0; joint < model::kJoints; ++joint) xml += revolute_joint(robot, joint, places[joint]);
  return xml + fixed_joint(link_frame(robot.name, model::kJoints), tcp_frame(robot.name), robot.model.X_FT);
}

}  // namespace

std::string robot_description(const model::Cell& cell) {
  std::string xml = fmt::format("<?xml version=\"1.0\"?>\n<robot name=\"{}\">\n  <link name=\"{}\"/>\n", cell.name, kWorldFrame);
  for (const model::Robot& robot : cell.robots) xml += arm(robot);
  return xml + "</robot>\n";
}

}  // namespace interlace::monitor
