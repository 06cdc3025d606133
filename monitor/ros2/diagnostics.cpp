#include "monitor/ros2/diagnostics.hpp"

#include <algorithm>

namespace interlace::monitor {

namespace {

using Status = ros2::DiagnosticStatus;

const char* yes_or_no(bool b) {
  return b ? "yes" : "no";
}

std::string joined(const std::vector<model::ToolName>& names) {
  std::string text;
  for (const model::ToolName& name : names) text += (text.empty() ? "" : " ") + name.str();
  return text;
}

void judge_robot(const RobotPicture& robot, Status& status) {
  const bool deadlock = robot.status && robot.status->reason == model::Reason::deadlock;
  if (robot.stranger) {
    status.level = Status::kError;
    status.message = "its proxy works with another cell file";
  } else if (!robot.heard) {
    status.level = Status::kStale;
    status.message = robot.posture ? "not heard from: it could be anywhere in its reach" : "never heard from";
  } else if (!robot.posture->ready) {
    status.level = Status::kWarn;
    status.message = "its controller takes no command";
  } else if (deadlock) {
    status.level = Status::kWarn;
    status.message = "deadlock: nobody in its way will move by itself, and no way out helps";
  } else if (robot.posture->moving) {
    status.message = "moves";
  } else {
    status.message = robot.waiting.empty() ? "stands" : robot.waiting;
  }
}

Status of_robot(const std::string& cell, const RobotPicture& robot) {
  Status status;
  const std::string& name = robot.body->name.str();
  status.name = cell + ": " + name;
  status.hardware_id = name;
  judge_robot(robot, status);
  status.values.push_back({"heard", yes_or_no(robot.heard)});
  if (robot.posture) {
    status.values.push_back({"ready", yes_or_no(robot.posture->ready)});
    status.values.push_back({"moving", yes_or_no(robot.posture->moving)});
    status.values.push_back({"motion", robot.posture->motion.str()});
    status.values.push_back({"holds", joined(robot.posture->holds)});
  }
  if (robot.status) {
    status.values.push_back({"mode", model::to_string(robot.status->mode)});
    status.values.push_back({"queued", std::to_string(robot.status->queued)});
    status.values.push_back({"current", robot.status->current.str()});
    status.values.push_back({"reason", model::to_string(robot.status->reason)});
    status.values.push_back({"held", yes_or_no(robot.status->held)});
  }
  return status;
}

Status of_planner(const CellPicture& picture) {
  Status status;
  status.name = picture.cell->name + ": planner";
  status.hardware_id = "planner";
  status.level = picture.planner_heard ? Status::kOk : Status::kStale;
  status.message = picture.planner_heard ? "heard" : "not heard from: no new motion starts, those under way go on";
  if (picture.planner) {
    status.values = {{"strategy", picture.planner->strategy},
                     {"accepted", std::to_string(picture.planner->accepted)},
                     {"completed", std::to_string(picture.planner->completed)},
                     {"rejected", std::to_string(picture.planner->rejected)},
                     {"refused_samples", std::to_string(picture.planner->refused_samples)}};
  }
  return status;
}

/// Only those that hold: what is over is on the page.
Status of_alarms(const CellPicture& picture) {
  Status status;
  status.name = picture.cell->name + ": alarms";
  status.hardware_id = "cell";
  status.message = "none";
  for (const Alarm& alarm : picture.alarms) {
    if (alarm.ended) continue;
    if (status.values.empty()) status.message = alarm.text;
    status.level = Status::kError;
    status.values.push_back({alarm.kind, alarm.text});
  }
  return status;
}

}  // namespace

ros2::DiagnosticArray diagnostics(const CellPicture& picture, ros2::Time stamp) {
  ros2::DiagnosticArray message;
  message.header.stamp = stamp;
  message.status.push_back(of_planner(picture));
  for (const RobotPicture& robot : picture.robots) message.status.push_back(of_robot(picture.cell->name, robot));
  message.status.push_back(of_alarms(picture));
  return message;
}

bool differ_in_level(const ros2::DiagnosticArray& a, const ros2::DiagnosticArray& b) {
  return !std::equal(a.status.begin(), a.status.end(), b.status.begin(), b.status.end(),
                     [](const Status& x, const Status& y) { return x.name == y.name && x.level == y.level; });
}

}  // namespace interlace::monitor
