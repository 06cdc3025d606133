#pragma once

#include <string>

#include "common/dds/envelope.hpp"

/// One good message of each kind, with every field away from its default.
namespace interlace::test {

inline const model::RobotName kRobot{"r1"};

inline model::Joints joints(double first) {
  model::Joints q;
  for (Eigen::Index i = 0; i < q.size(); ++i) q[i] = first + 0.1 * static_cast<double>(i);
  return q;
}

inline model::Pose pose() {
  return model::make_pose({0.45, -0.25, 0.3}, model::rotation_from_rpy({0.1, -0.4, 1.2}));
}

inline model::Instant at(double seconds) {
  return model::at_seconds(seconds);
}

inline std::vector<model::ToolName> tools() {
  return {model::ToolName{"long"}, model::ToolName{"box-1"}};
}

inline dds::CommandMessage linear_command(const std::string& id = "c-1") {
  model::CommandSubmitted c;
  c.id = model::CommandId{id};
  c.robot = kRobot;
  c.motion = {model::LinearTarget{pose()}, 0.05, 0.2,
              model::ToolChange{model::ToolName{"long"}, model::ToolName{}, model::ToolTime::completion}};
  c.priority = -3;
  c.deadline = 12.5;
  return {c, "tester"};
}

inline dds::CommandMessage joint_command() {
  model::CommandSubmitted c;
  c.id = model::CommandId{"c-2"};
  c.robot = kRobot;
  c.motion.target = model::JointTarget{joints(-0.2)};
  return {c, "tester"};
}

inline dds::CommandMessage cancel_command() {
  return {model::CommandCancelled{model::CommandId{"c-1"}, kRobot}, "tester"};
}

inline dds::CommandMessage stop_command() {
  return {model::StopRequested{model::CommandId{"s-1"}, kRobot}, "tester"};
}

inline dds::CommandMessage hold_command() {
  return {model::HoldRequested{model::CommandId{"h-1"}, kRobot}, "tester"};
}

inline dds::CommandMessage resume_command() {
  return {model::ResumeRequested{model::CommandId{"h-2"}, kRobot}, "tester"};
}

inline dds::CommandMessage replace_command() {
  return {model::QueueReplaced{model::CommandId{"q-1"},
                               kRobot,
                               {std::get<model::CommandSubmitted>(linear_command("c-3").request),
                                std::get<model::CommandSubmitted>(joint_command().request)}},
          "tester"};
}

inline model::Conflict conflict() {
  return {model::RobotName{"r2"}, "link2", "eef", at(1.5), model::kForever, -0.012, model::Vector3{0.3, 0, 0.2}};
}

inline std::vector<model::EscapeRefusal> refusals() {
  return {{model::RobotName{"r2"}, model::EscapeWay::minus_y, "r3 stands there — 12 mm"},
          {model::RobotName{"r3"}, model::EscapeWay::home, ""}};
}

inline dds::StatusMessage status() {
  model::CommandStatus s;
  s.id = model::CommandId{"c-1"};
  s.robot = kRobot;
  s.escape = true;
  s.serves = model::CommandId{"c-0"};
  s.state = model::CommandState::scheduled;
  s.reason = model::Reason::delayed;
  s.text = "waits for r2 — 1.2 s";
  s.submitted = at(1);
  s.start = at(2.25);
  s.end = at(4.75);
  s.delay = 1.25;
  s.conflicts = {conflict(), conflict()};
  s.refusals = refusals();
  s.verdict = model::DeadlineVerdict::late;
  s.deadline = at(3.5);
  return {42, s};
}

inline dds::DispatchMessage execute() {
  model::Dispatch d;
  d.id = model::CommandId{"c-1"};
  d.robot = kRobot;
  d.attempt = 7;
  d.motion = {model::JointTarget{joints(0.3)}, 0.1, std::nullopt,
              model::ToolChange{model::ToolName{"short"}, model::ToolName{"long"}, model::ToolTime::start}};
  d.from = joints(-0.5);
  d.holds = tools();
  d.earliest = at(2.25);
  d.latest = at(2.27);
  d.duration = 2.5;
  return {42, 0xFEEDFACECAFEBEEF, d};
}

inline dds::DispatchMessage withdrawal() {
  return {42, 0xFEEDFACECAFEBEEF, model::Withdrawal{model::CommandId{"c-1"}, kRobot, 7}};
}

inline dds::DispatchMessage heartbeat() {
  return {42, 0xFEEDFACECAFEBEEF, dds::Heartbeat{kRobot, 99, model::Duration{123'456'789'012}, at(3.1), at(3.2), true}};
}

inline dds::ExecutionMessage execution() {
  return {42,
          99,
          {model::CommandId{"c-1"}, kRobot, 7, model::ExecutionState::refused, at(2.3), 1e-4, joints(1), "start window missed", tools()}};
}

inline dds::PostureMessage posture(const model::RobotName& robot = kRobot) {
  model::PostureReported p;
  p.robot = robot;
  p.at = at(5.5);
  p.uncertainty = 2e-4;
  p.joints = joints(0.7);
  p.X_WT = pose();
  p.moving = true;
  p.ready = false;
  p.motion = model::CommandId{"c-1"};
  p.holds = tools();
  return {0xFEEDFACECAFEBEEF, 99, 42, model::Duration{123'456'789'012}, p, true};
}

inline model::RobotStatus robot_status(const std::string& name) {
  return {model::RobotName{name},
          model::RobotMode::commanded,
          3,
          model::CommandId{"c-1"},
          model::Reason::blocked,
          "r2 stands there",
          {conflict()},
          refusals(),
          model::CommandId{"c-0"},
          tools(),
          true};
}

inline model::PlannerState planner_state(const std::string& cell) {
  return {cell, 0xFEEDFACECAFEBEEF, 42, at(6), "event", {robot_status("r1"), robot_status("r2")}, 16, 1, 15, 2};
}

}  // namespace interlace::test
