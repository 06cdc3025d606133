#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "common/model/ids.hpp"
#include "common/model/pose.hpp"
#include "common/model/time.hpp"

/// What the processes say to each other, as plain values: the same structs enter the core, the simulator and the wire (idl/README.md).
namespace interlace::model {

struct LinearTarget {
  Pose X_WT = Pose::Identity();  ///< TCP in the world frame; the way there is a straight line
};
struct JointTarget {
  Joints q = Joints::Zero();  ///< [rad]; the way there is synchronised in joint space
};
using Target = std::variant<LinearTarget, JointTarget>;

/// When a robot takes or leaves a tool: standing at the start of a motion, before its first movement, or standing at its end.
enum class ToolTime : std::uint8_t { start, completion };

/// A command may have its robot take a tool, leave one, or both at the same time.
struct ToolChange {
  ToolName attach;  ///< empty: none
  ToolName detach;  ///< empty: none
  ToolTime when = ToolTime::completion;
};

/// A PTP request: where to, and optionally slower than the robot's limits; and what the hand does there.
struct MotionRequest {
  Target target;
  std::optional<double> velocity;                  ///< of the TCP [m/s]; not above the robot's
  std::optional<double> acceleration;              ///< of the TCP [m/s²]; not above the robot's
  std::optional<ToolChange> tools = std::nullopt;  ///< taken or left
};

/// Client → planner. Submitting an id twice is answered twice and executed once.
struct CommandSubmitted {
  CommandId id;
  RobotName robot;
  MotionRequest motion;
  int priority = 0;                               ///< higher goes first among commands of different robots that compete
  std::optional<double> deadline = std::nullopt;  ///< to be completed within this after its submission [s]; it is only reported on
};
/// Client → planner: give up a command that has not started.
struct CommandCancelled {
  CommandId id;
  RobotName robot;
};
/// Client → planner: give up all commands of the robot that have not started; a running motion ends where it was going.
struct StopRequested {
  CommandId id;  ///< id of the request itself
  RobotName robot;
};
/// Client → planner: the robot finishes what it does and then stands, whatever waits for it or for its place, until it is resumed.
struct HoldRequested {
  CommandId id;  ///< id of the request itself
  RobotName robot;
};
/// Client → planner: ends a hold.
struct ResumeRequested {
  CommandId id;  ///< id of the request itself
  RobotName robot;
};
/// Client → planner: `commands` instead of all that waits for the robot, and all of them or none.
struct QueueReplaced {
  CommandId id;  ///< id of the request itself
  RobotName robot;
  std::vector<CommandSubmitted> commands;  ///< for that robot, in their order; their ids are new
};

/// All that a client can ask for.
using ClientRequest = std::variant<CommandSubmitted, CommandCancelled, StopRequested, HoldRequested, ResumeRequested, QueueReplaced>;

enum class CommandState : std::uint8_t {
  queued,     ///< admitted, waits for its turn
  waiting,    ///< its robot is free but it cannot start: see reason and conflicts
  scheduled,  ///< its start is decided
  started,
  completed,  ///< final
  rejected,   ///< final: never admitted, or no longer possible from where the robot is
  cancelled,  ///< final
  failed      ///< final: started and did not arrive
};
[[nodiscard]] constexpr bool is_final(CommandState s) {
  return s >= CommandState::completed;
}
[[nodiscard]] const char* to_string(CommandState s);

enum class Reason : std::uint8_t {
  none,
  bad_request,  ///< a value that no robot could carry out (speed ≤ 0, above the limit, empty id, unknown robot)
  unreachable,  ///< a point of the path is out of reach
  joint_limit,  ///< a joint leaves its limits on the path
  joint_speed,  ///< a joint would have to be faster than its limit
  joint_jump,   ///< the path crosses a singularity or would change the branch
  self_collision,
  base_collision,  ///< the immovable base of a neighbour is in the way
  queue_full,
  blocked,           ///< another robot stands or will stand in the way for good: no start window (deadlock)
  delayed,           ///< starts later to let others pass
  robot_unknown,     ///< a robot that is not heard from, or moves by itself, could be anywhere
  not_ready,         ///< the robot itself is not heard from or not ready
  refused_by_proxy,  ///< start was missed or refused; planned again
  controller_fault,
  on_request,         ///< cancelled or stopped by a client
  unknown_id,         ///< no such command
  escape,             ///< out of the way of the command it serves; or of that command: others are sent out of its way first
  deadlock,           ///< nobody in the way will move by itself and no escape was found: a person is asked for help
  fixture_collision,  ///< a fixture of the cell is in the way
  tool,               ///< a tool that the cell does not know, to be taken although it is held, or to be left although it is not
  priority,           ///< another command goes first: it has a higher priority, or has waited too long
  held,               ///< its robot is held, or one that stands in its way is
  replaced            ///< other commands took the place of the whole queue
};
[[nodiscard]] const char* to_string(Reason r);

/// What can be said of a command's deadline.
enum class DeadlineVerdict : std::uint8_t {
  none,       ///< it has no deadline
  open,       ///< it can still be met
  met,        ///< completed in time
  late,       ///< the deadline passed before its completion
  impossible  ///< no plan could have met it from its submission on; it is carried out all the same
};
[[nodiscard]] const char* to_string(DeadlineVerdict v);

/// Which bodies come too near, when, and by how much: the evidence behind a delay or a refusal (DESIGN section 7).
struct Conflict {
  RobotName blocker;
  std::string own_link;             ///< empty when the blocker could be anywhere
  std::string blocker_link;         ///< empty as well when the blocker holds the shared zone: it need not be near
  Instant from{};                   ///< first start that this conflict forbids
  Instant until = kForever;         ///< starts are free again from here on as far as this blocker goes; kForever: no end is known
  double clearance = 0;             ///< predicted clearance at the conflict's deepest examined point [m]
  Vector3 place = Vector3::Zero();  ///< world point between the two bodies there [m]
};

/// Ways out for a robot that is in the way: along an axis of the world, back where it came from, to its home pose.
enum class EscapeWay : std::uint8_t { plus_x, minus_x, plus_y, minus_y, plus_z, minus_z, retreat, home };
[[nodiscard]] const char* to_string(EscapeWay w);

/// A way out that was looked at and does not help.
struct EscapeRefusal {
  RobotName robot;  ///< that would have had to go
  EscapeWay way = EscapeWay::plus_x;
  std::string text;  ///< why not
};

/// Planner → client: the state of one command and why.
struct CommandStatus {
  CommandId id;
  RobotName robot;
  bool escape = false;  ///< made by the planner, not by a client
  CommandId serves;     ///< of an escape: the command it makes room for, or brings its robot back for
  CommandState state = CommandState::queued;
  Reason reason = Reason::none;
  std::string text;  ///< one sentence for people; empty when there is nothing to explain
  Instant submitted{};
  std::optional<Instant> start;  ///< planned while scheduled, measured once started
  std::optional<Instant> end;    ///< predicted, measured once completed
  double delay = 0;              ///< start minus the time the command could have started [s]
  std::vector<Conflict> conflicts;
  std::vector<EscapeRefusal> refusals;  ///< with reason `deadlock`: what was tried in vain
  std::optional<Instant> deadline;
  DeadlineVerdict verdict = DeadlineVerdict::none;
};

/// Planner → proxy: start `motion` within [earliest, latest] or not at all.
struct Dispatch {
  CommandId id;
  RobotName robot;
  std::uint32_t attempt = 0;  ///< counts new plans of the same command; a proxy answers with it
  MotionRequest motion;
  Joints from = Joints::Zero();  ///< posture the motion was planned from [rad]
  std::vector<ToolName> holds;   ///< what it was planned with in the robot's hand, before any change
  Instant earliest{};
  Instant latest{};
  double duration = 0;  ///< predicted [s]
};
/// Planner → proxy: forget a dispatch that has not started.
struct Withdrawal {
  CommandId id;
  RobotName robot;
  std::uint32_t attempt = 0;
};

enum class ExecutionState : std::uint8_t { accepted, refused, withdrawn, started, completed, failed };
[[nodiscard]] const char* to_string(ExecutionState s);

/// Proxy → planner: what became of a dispatch.
struct ExecutionReported {
  CommandId id;
  RobotName robot;
  std::uint32_t attempt = 0;
  ExecutionState state = ExecutionState::accepted;
  Instant at{};            ///< planner time of the event
  double uncertainty = 0;  ///< of `at` [s]
  Joints joints = Joints::Zero();
  std::string text;             ///< why, when refused or failed
  std::vector<ToolName> holds;  ///< all that the robot may hold at that time
};

/// Proxy → everyone, 100 Hz: where the robot is.
struct PostureReported {
  RobotName robot;
  Instant at{};            ///< planner time
  double uncertainty = 0;  ///< of `at` [s]
  Joints joints = Joints::Zero();
  Pose X_WT = Pose::Identity();
  bool moving = false;
  bool ready = true;            ///< the controller would accept a command
  CommandId motion;             ///< running command, empty when standing
  std::vector<ToolName> holds;  ///< all that the robot may hold
};

enum class RobotMode : std::uint8_t { unknown, standby, commanded, moving };
[[nodiscard]] const char* to_string(RobotMode m);

/// What the planner knows of a robot; part of its 1 Hz state.
struct RobotStatus {
  RobotName name;
  RobotMode mode = RobotMode::unknown;
  std::uint32_t queued = 0;
  CommandId current;
  Reason reason = Reason::none;
  std::string text;
  std::vector<Conflict> conflicts;
  std::vector<EscapeRefusal> refusals;
  CommandId serves;             ///< when `current` is an escape: the command it serves
  std::vector<ToolName> holds;  ///< all that the robot may hold, as the planner knows it
  bool held = false;            ///< it starts nothing until it is resumed
};

/// Planner → everyone: the whole state, so that a late or deaf listener recovers.
struct PlannerState {
  std::string cell;
  std::uint64_t fingerprint = 0;  ///< of the cell description; programs with another one refuse to work together
  std::uint64_t incarnation = 0;  ///< different each time a planner starts
  Instant at{};
  std::string strategy;
  std::vector<RobotStatus> robots;
  std::uint64_t accepted = 0, rejected = 0, completed = 0, refused_samples = 0;
};

}  // namespace interlace::model
