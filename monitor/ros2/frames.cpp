#include "monitor/ros2/frames.hpp"

namespace interlace::monitor {

namespace {

ros2::TransformStamped transform(const std::string& parent, const std::string& child, const model::Pose& X, ros2::Time stamp) {
  const ros2::Pose pose = to_ros2(X);
  return {{stamp, parent}, child, {{pose.position.x, pose.position.y, pose.position.z}, pose.orientation}};
}

}  // namespace

std::string joint_name(const model::RobotName& robot, std::size_t joint) {
  return robot.str() + "_joint" + std::to_string(joint + 1);
}

std::string link_frame(const model::RobotName& robot, std::size_t link) {
  return robot.str() + (link == 0 ? "_base" : "_link" + std::to_string(link));
}

std::string tcp_frame(const model::RobotName& robot) {
  return robot.str() + "_tcp";
}

ros2::Pose to_ros2(const model::Pose& X) {
  const model::Vector3 p = X.translation();
  const model::Quaternion q{X.rotation()};
  return {{p.x(), p.y(), p.z()}, {q.x(), q.y(), q.z(), q.w()}};
}

ros2::Header world_header(ros2::Time stamp) {
  return {stamp, kWorldFrame};
}

ros2::JointState joint_states(const CellPicture& picture, ros2::Time stamp) {
  ros2::JointState message;
  message.header.stamp = stamp;
  for (const RobotPicture& robot : picture.robots) {
    if (!robot.heard || !robot.posture) continue;
    for (std::size_t i = 0; i < model::kJoints; ++i) {
      message.name.push_back(joint_name(robot.body->name, i));
      message.position.push_back(robot.posture->joints[static_cast<Eigen::Index>(i)]);
    }
  }
  return message;
}

ros2::TFMessage moving_frames(const CellPicture& picture, ros2::Time stamp) {
  ros2::TFMessage message;
  for (const RobotPicture& robot : picture.robots) {
    if (!robot.heard || !robot.posture) continue;
    const model::LinkFrames X = robot.body->model.kinematics.forward(robot.posture->joints);
    for (std::size_t i = 1; i < X.size(); ++i) {
      const model::Pose X_parent_child = X[i - 1].inverse() * X[i];
      message.transforms.push_back(transform(link_frame(robot.body->name, i - 1), link_frame(robot.body->name, i), X_parent_child, stamp));
    }
  }
  return message;
}

ros2::TFMessage fixed_frames(const model::Cell& cell, ros2::Time stamp) {
  ros2::TFMessage message;
  for (const model::Robot& robot : cell.robots) {
    message.transforms.push_back(transform(kWorldFrame, link_frame(robot.name, 0), robot.X_WB, stamp));
    message.transforms.push_back(transform(link_frame(robot.name, model::kJoints), tcp_frame(robot.name), robot.model.X_FT, stamp));
  }
  return message;
}

}  // namespace interlace::monitor
