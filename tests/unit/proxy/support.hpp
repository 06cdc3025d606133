#pragma once

#include <string>

#include "common/model/messages.hpp"
#include "common/model/motion.hpp"
#include "robot_proxy/executor.hpp"

namespace interlace::proxy::test {

/// The dissertation's arm at the origin, TCP at (0.45, 0, 0.3) m, 0.1 m/s and 0.1 m/s², joints 20 rad/s and 100 rad/s².
inline model::Robot arm() {
  model::OpwParameters p;
  p.c1 = 0.29;
  p.c2 = 0.26;
  p.c3 = 0.27;
  p.c4 = 0.09;
  model::Robot robot;
  robot.name = model::RobotName{"r1"};
  robot.model.name = "arm4";
  robot.model.kinematics = model::Kinematics{p};
  robot.model.joints.velocity = model::Joints::Constant(20);
  robot.model.joints.acceleration = model::Joints::Constant(100);
  robot.model.X_FT = model::make_pose({0, 0, 0}, model::rotation_from_rpy({0, -model::kPi / 2, 0}));
  robot.start = *model::preferred_posture(robot.model, model::make_pose({0.45, 0, 0.3}, model::Quaternion::Identity()));
  robot.home = robot.start;
  robot.tcp.velocity = 0.1;
  robot.tcp.acceleration = 0.1;
  return robot;
}

/// A straight move of the TCP to `p_WT` [m], hand pointing along x.
inline model::MotionRequest line_to(const model::Vector3& p_WT) {
  model::MotionRequest request;
  request.target = model::LinearTarget{model::make_pose(p_WT, model::Quaternion::Identity())};
  return request;
}

inline model::MotionRequest joints_to(const model::Joints& q) {
  model::MotionRequest request;
  request.target = model::JointTarget{q};
  return request;
}

inline LocalTime local(double s) {
  return LocalTime{model::from_seconds(s)};
}

}  // namespace interlace::proxy::test
