#pragma once

#include <memory>
#include <string>
#include <vector>

#include "common/model/cell.hpp"
#include "common/model/messages.hpp"
#include "tests/support/seed.hpp"

/// Arms and cells for tests, built in code so that no test of the core needs the file reader.
namespace interlace::test {

using model::kPi;

/// The dissertation's arm: no offsets, four capsules, TCP along its own x.
inline model::RobotModel arm4() {
  model::OpwParameters p;
  p.c1 = 0.290;
  p.c2 = 0.260;
  p.c3 = 0.270;
  p.c4 = 0.090;
  model::RobotModel m;
  m.name = "arm4";
  m.kinematics = model::Kinematics{p};
  m.joints.min << -170, -90, -175, -180, -135, -360;
  m.joints.max << 170, 180, 250, 180, 135, 360;
  m.joints.min *= kPi / 180;
  m.joints.max *= kPi / 180;
  m.X_FT = model::make_pose({0, 0, 0}, model::rotation_from_rpy({0, -kPi / 2, 0}));
  m.capsules = model::chain_capsules(p, m.X_FT, {0.112, 0.117, 0.100, 0.048});
  m.self_pairs = model::default_self_pairs(m.capsules);
  return m;
}

/// An industrial arm with shoulder and elbow offsets, in the proportions of a 12 kg machine, forearm level at joint 3 = 0.
inline model::OpwParameters offset_arm_parameters() {
  model::OpwParameters p;
  p.a1 = 0.100;
  p.a2 = -0.135;
  p.c1 = 0.615;
  p.c2 = 0.705;
  p.c3 = 0.755;
  p.c4 = 0.085;
  p.offsets = {0, 0, -kPi / 2, 0, 0, 0};
  return p;
}

inline model::RobotModel offset_arm() {
  model::RobotModel m;
  m.name = "offset";
  m.kinematics = model::Kinematics{offset_arm_parameters()};
  m.X_FT = model::make_pose({0.05, 0, 0.15}, model::rotation_from_rpy({0, -kPi / 4, 0}));
  m.capsules = {{"base", 0, {0, 0, 0}, {0, 0, 0.4}, 0.20},
                {"turret", 1, {0, 0, 0.5}, {0.1, 0, 0.615}, 0.18},
                {"upper", 2, {0, -0.05, 0}, {0, -0.05, 0.705}, 0.12},
                {"elbow", 3, {-0.3, 0, 0}, {-0.1, 0, 0.1}, 0.12},
                {"forearm", 4, {0, 0, -0.6}, {0, 0, 0}, 0.09},
                {"wrist", 5, {0, -0.03, 0}, {0, 0.03, 0.02}, 0.07},
                {"gripper", 6, {0, 0, 0}, {0.05, 0, 0.15}, 0.05}};
  m.self_pairs = model::default_self_pairs(m.capsules);
  return m;
}

/// Any parameters of an arm that can move: offsets, signs and lateral offset included.
inline model::OpwParameters random_parameters(Seed& seed) {
  model::OpwParameters p;
  p.a1 = seed.uniform(-0.1, 0.2);
  p.a2 = seed.uniform(-0.15, 0.15);
  p.b = seed.chance(0.3) ? 0.0 : seed.uniform(-0.1, 0.1);
  p.c1 = seed.uniform(0.2, 0.7);
  p.c2 = seed.uniform(0.25, 0.8);
  p.c3 = seed.uniform(0.25, 0.8);
  p.c4 = seed.uniform(0.05, 0.2);
  for (std::size_t i = 0; i < model::kJoints; ++i) {
    p.offsets[i] = seed.uniform(-kPi, kPi);
    p.signs[i] = seed.chance(0.5) ? 1 : -1;
  }
  return p;
}

inline model::Vector3 random_point(Seed& seed, double half) {
  return {seed.uniform(-half, half), seed.uniform(-half, half), seed.uniform(-half, half)};
}

inline model::Quaternion random_rotation(Seed& seed) {
  std::normal_distribution<double> normal;
  model::Quaternion q{normal(seed.engine()), normal(seed.engine()), normal(seed.engine()), normal(seed.engine())};
  return q.normalized();
}

/// An arm of random proportions with a capsule off the axis of every link 0 … 6, one of them a sphere, and a random tool.
inline model::RobotModel random_arm(Seed& seed) {
  model::RobotModel m;
  m.name = "random";
  m.kinematics = model::Kinematics{random_parameters(seed)};
  m.X_FT = model::make_pose(random_point(seed, 0.15), random_rotation(seed));
  const std::size_t sphere = seed.below(7);
  for (std::size_t link = 0; link < 7; ++link) {
    const model::Vector3 a = random_point(seed, 0.2);
    const model::Vector3 b = link == sphere ? a : random_point(seed, 0.2);
    m.capsules.push_back({"link" + std::to_string(link), link, a, b, seed.uniform(0.01, 0.08)});
  }
  return m;
}

inline model::Robot robot_at(const std::string& name, const model::RobotModel& m, const model::Vector3& p_WB, double yaw = 0) {
  model::Robot r;
  r.name = model::RobotName{name};
  r.model = m;
  r.X_WB = model::make_pose(p_WB, model::rotation_from_rpy({0, 0, yaw}));
  r.tcp.velocity = 0.1;
  r.tcp.acceleration = 0.1;
  return r;
}

/// The world pose (x, y, z) [mm], rpy [deg], as the experiments' tables read in a cell file.
inline model::Pose pose_mm(double x, double y, double z, double roll = 0, double pitch = 0, double yaw = 0) {
  return model::make_pose({x / 1e3, y / 1e3, z / 1e3}, model::rotation_from_rpy(model::Vector3{roll, pitch, yaw} * kPi / 180));
}

/// A robot of the experiments whose TCP starts (and has its home) at `X_WT`.
inline model::Robot experiment_robot(const std::string& name, const model::Vector3& p_WB, const model::Pose& X_WT, double yaw = 0) {
  model::Robot r = robot_at(name, arm4(), p_WB, yaw);
  r.start = model::preferred_posture(r.model, r.X_WB.inverse() * X_WT).value();
  r.home = r.start;
  return r;
}

/// The cell of experiments 4.1, 4.2 and 5.1: two arms 500 mm apart; with `far` a third one 5 m away that can meet nobody.
inline std::shared_ptr<model::Cell> experiment_cell(bool far = false) {
  auto cell = std::make_shared<model::Cell>();
  cell->name = "experiment";
  cell->robots.push_back(experiment_robot("r1", {0, 0.25, 0}, pose_mm(450, 250, 300)));
  cell->robots.push_back(experiment_robot("r2", {0, -0.25, 0}, pose_mm(450, -250, 300)));
  if (far) cell->robots.push_back(experiment_robot("r3", {0, 5.25, 0}, pose_mm(450, 5250, 300)));
  return cell;
}

inline model::MotionRequest line_to(const model::Pose& X_WT) {
  model::MotionRequest request;
  request.target = model::LinearTarget{X_WT};
  return request;
}

inline model::MotionRequest joints_to(const model::Joints& q) {
  model::MotionRequest request;
  request.target = model::JointTarget{q};
  return request;
}

}  // namespace interlace::test
