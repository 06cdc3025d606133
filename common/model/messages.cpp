#include "common/model/messages.hpp"

namespace interlace::model {

const char* to_string(CommandState s) {
  switch (s) {
    case CommandState::queued: return "queued";
    case CommandState::waiting: return "waiting";
    case CommandState::scheduled: return "scheduled";
    case CommandState::started: return "started";
    case CommandState::completed: return "completed";
    case CommandState::rejected: return "rejected";
    case CommandState::cancelled: return "cancelled";
    case CommandState::failed: return "failed";
  }
  return "?";
}

const char* to_string(Reason r) {
  switch (r) {
    case Reason::none: return "none";
    case Reason::bad_request: return "bad_request";
    case Reason::unreachable: return "unreachable";
    case Reason::joint_limit: return "joint_limit";
    case Reason::joint_speed: return "joint_speed";
    case Reason::joint_jump: return "joint_jump";
    case Reason::self_collision: return "self_collision";
    case Reason::base_collision: return "base_collision";
    case Reason::queue_full: return "queue_full";
    case Reason::blocked: return "blocked";
    case Reason::delayed: return "delayed";
    case Reason::robot_unknown: return "robot_unknown";
    case Reason::not_ready: return "not_ready";
    case Reason::refused_by_proxy: return "refused_by_proxy";
    case Reason::controller_fault: return "controller_fault";
    case Reason::on_request: return "on_request";
    case Reason::unknown_id: return "unknown_id";
    case Reason::escape: return "escape";
    case Reason::deadlock: return "deadlock";
    case Reason::fixture_collision: return "fixture_collision";
    case Reason::tool: return "tool";
    case Reason::priority: return "priority";
    case Reason::held: return "held";
    case Reason::replaced: return "replaced";
  }
  return "?";
}

const char* to_string(DeadlineVerdict v) {
  switch (v) {
    case DeadlineVerdict::none: return "none";
    case DeadlineVerdict::open: return "open";
    case DeadlineVerdict::met: return "met";
    case DeadlineVerdict::late: return "late";
    case DeadlineVerdict::impossible: return "impossible";
  }
  return "?";
}

const char* to_string(EscapeWay w) {
  switch (w) {
    case EscapeWay::plus_x: return "+x";
    case EscapeWay::minus_x: return "-x";
    case EscapeWay::plus_y: return "+y";
    case EscapeWay::minus_y: return "-y";
    case EscapeWay::plus_z: return "+z";
    case EscapeWay::minus_z: return "-z";
    case EscapeWay::retreat: return "retreat";
    case EscapeWay::home: return "home";
  }
  return "?";
}

const char* to_string(ExecutionState s) {
  switch (s) {
    case ExecutionState::accepted: return "accepted";
    case ExecutionState::refused: return "refused";
    case ExecutionState::withdrawn: return "withdrawn";
    case ExecutionState::started: return "started";
    case ExecutionState::completed: return "completed";
    case ExecutionState::failed: return "failed";
  }
  return "?";
}

const char* to_string(RobotMode m) {
  switch (m) {
    case RobotMode::unknown: return "unknown";
    case RobotMode::standby: return "standby";
    case RobotMode::commanded: return "commanded";
    case RobotMode::moving: return "moving";
  }
  return "?";
}

}  // namespace interlace::model
