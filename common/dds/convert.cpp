#include "common/dds/convert.hpp"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "common/dds/limits.hpp"
#include "common/dds/validate.hpp"

namespace interlace::dds {
namespace {

namespace wire = ::interlace;

using WireJoints = std::array<double, model::kJoints>;

// The enums of the IDL list the same values in the same order as the model's; these hold both to it.
static_assert(wire::STATE_FAILED == static_cast<int>(model::CommandState::failed));
static_assert(wire::STATE_COMPLETED == static_cast<int>(model::CommandState::completed));
static_assert(wire::REASON_BLOCKED == static_cast<int>(model::Reason::blocked));
static_assert(wire::REASON_UNKNOWN_ID == static_cast<int>(model::Reason::unknown_id));
static_assert(wire::REASON_DEADLOCK == static_cast<int>(model::Reason::deadlock));
static_assert(wire::REASON_FIXTURE_COLLISION == static_cast<int>(model::Reason::fixture_collision));
static_assert(wire::REASON_TOOL == static_cast<int>(model::Reason::tool));
static_assert(wire::REASON_REPLACED == static_cast<int>(model::Reason::replaced));
static_assert(wire::DEADLINE_IMPOSSIBLE == static_cast<int>(model::DeadlineVerdict::impossible));
static_assert(wire::AT_COMPLETION == static_cast<int>(model::ToolTime::completion));
static_assert(wire::WAY_PLUS_Z == static_cast<int>(model::EscapeWay::plus_z));
static_assert(wire::WAY_HOME == static_cast<int>(model::EscapeWay::home));
static_assert(wire::EXECUTION_FAILED == static_cast<int>(model::ExecutionState::failed));
static_assert(wire::MODE_MOVING == static_cast<int>(model::RobotMode::moving));

template <typename WireEnum, typename ModelEnum>
WireEnum same_value(ModelEnum value) {
  return static_cast<WireEnum>(value);
}

std::int64_t nanoseconds(model::Instant t) {
  return t.time_since_epoch().count();
}

/// A value whose presence the wire tells apart, such as has_velocity and velocity.
template <typename Value, typename Read>
std::optional<Value> if_present(bool present, Read&& read) {
  return present ? std::optional<Value>{read()} : std::nullopt;
}

// ---- from the wire ----

void check_version(Validator& v, std::uint32_t version) {
  v.require(version != 0, [] { return std::string{"sample: malformed, or version 0"}; });
  v.require(version == wire::PROTOCOL_VERSION,
            [&] { return "version: " + std::to_string(version) + ", this program speaks " + std::to_string(wire::PROTOCOL_VERSION); });
}

std::string check_owner(Validator& v, const char* field, std::string found, const std::string& owner) {
  std::string name = v.name(field, std::move(found));
  v.require(name == owner, [&] { return std::string{field} + ": '" + name + "' on the topic of '" + owner + "'"; });
  return name;
}

model::Joints read_joints(Validator& v, const char* field, const WireJoints& q) {
  model::Joints joints;
  for (std::size_t i = 0; i < model::kJoints; ++i) {
    joints[static_cast<Eigen::Index>(i)] = v.number(std::string{field} + "[" + std::to_string(i) + "]", q[i], kMaxAngle);
  }
  return joints;
}

model::Vector3 read_point(Validator& v, const char* field, const wire::Point& p) {
  const std::string name{field};
  return {v.number(name + ".x", p.x(), kMaxLength), v.number(name + ".y", p.y(), kMaxLength), v.number(name + ".z", p.z(), kMaxLength)};
}

model::Pose read_pose(Validator& v, const char* position, const wire::Point& p, const char* orientation, const wire::Quaternion& q) {
  return model::make_pose(read_point(v, position, p), v.unit_quaternion(orientation, q.w(), q.x(), q.y(), q.z()));
}

model::MotionRequest read_motion(Validator& v, const wire::Goal& goal, bool linear) {
  model::MotionRequest motion;
  if (linear) {
    motion.target = model::LinearTarget{read_pose(v, "motion.position", goal.position(), "motion.orientation", goal.orientation())};
  } else {
    motion.target = model::JointTarget{read_joints(v, "motion.joints", goal.joints())};
  }
  // Zero and negative rates pass: the planner rejects them with a reason, which is a better answer than none.
  motion.velocity = if_present<double>(goal.has_velocity(), [&] { return v.number("motion.velocity", goal.velocity(), kMaxRate); });
  motion.acceleration =
      if_present<double>(goal.has_acceleration(), [&] { return v.number("motion.acceleration", goal.acceleration(), kMaxRate); });
  model::ToolChange change;
  change.attach = model::ToolName{v.name_or_empty("motion.attach", goal.attach().to_string())};
  change.detach = model::ToolName{v.name_or_empty("motion.detach", goal.detach().to_string())};
  if (change.attach.empty() && change.detach.empty()) return motion;
  change.when = v.known("motion.tool_time", goal.tool_time(), model::ToolTime::completion);
  motion.tools = change;
  return motion;
}

/// Of a Command or a QueueEntry: both have the same members for it.
template <typename Wire>
model::CommandSubmitted read_command(Validator& v, const Wire& w, const model::CommandId& id, const model::RobotName& robot, bool linear) {
  model::CommandSubmitted command{id, robot, read_motion(v, w.motion(), linear), w.priority()};
  command.deadline = if_present<double>(w.has_deadline(), [&] { return v.non_negative("deadline", w.deadline(), kMaxSeconds); });
  return command;
}

std::vector<model::CommandSubmitted> read_queue(Validator& v, const std::vector<wire::QueueEntry>& found, const model::RobotName& robot) {
  v.require(found.size() <= kMaxReplacement, [&] { return "queue: " + std::to_string(found.size()) + " are too many"; });
  std::vector<model::CommandSubmitted> commands;
  for (const wire::QueueEntry& entry : found) {
    if (!v.ok()) break;
    const auto kind = v.known("queue.kind", entry.kind(), wire::COMMAND_JOINT);  // of the kinds only these two are motions
    commands.push_back(
        read_command(v, entry, model::CommandId{v.name("queue.id", entry.id().to_string())}, robot, kind == wire::COMMAND_LINEAR));
  }
  return commands;
}

std::vector<model::ToolName> read_tools(Validator& v, const char* field, const wire::Tools& found) {
  v.require(found.size() <= kMaxTools, [&] { return std::string{field} + ": " + std::to_string(found.size()) + " are too many"; });
  std::vector<model::ToolName> tools;
  if (!v.ok()) return tools;
  tools.reserve(found.size());
  for (const auto& name : found) tools.emplace_back(v.name(field, name.to_string()));
  return tools;
}

std::vector<model::Conflict> read_conflicts(Validator& v, const std::vector<wire::Conflict>& found) {
  v.require(found.size() <= kMaxConflicts, [&] { return "conflicts: " + std::to_string(found.size()) + " are too many"; });
  std::vector<model::Conflict> conflicts;
  if (!v.ok()) return conflicts;
  conflicts.reserve(found.size());
  for (const wire::Conflict& c : found) {
    conflicts.push_back({model::RobotName{v.name("conflicts.blocker", c.blocker().to_string())},
                         v.text("conflicts.own_link", c.own_link().to_string(), model::kMaxNameLength),
                         v.text("conflicts.blocker_link", c.blocker_link().to_string(), model::kMaxNameLength),
                         v.bound("conflicts.from", c.from()), v.bound("conflicts.until", c.until()),
                         v.number("conflicts.clearance", c.clearance(), kMaxLength), read_point(v, "conflicts.place", c.place())});
  }
  return conflicts;
}

std::vector<model::EscapeRefusal> read_refusals(Validator& v, const std::vector<wire::EscapeRefusal>& found) {
  v.require(found.size() <= kMaxRefusals, [&] { return "refusals: " + std::to_string(found.size()) + " are too many"; });
  std::vector<model::EscapeRefusal> refusals;
  if (!v.ok()) return refusals;
  refusals.reserve(found.size());
  for (const wire::EscapeRefusal& r : found) {
    refusals.push_back({model::RobotName{v.name("refusals.robot", r.robot().to_string())},
                        v.known("refusals.way", r.way(), model::EscapeWay::home), v.text("refusals.text", r.text().to_string(), kMaxText)});
  }
  return refusals;
}

template <typename Message>
Converted<Message> result(const Validator& v, Message message) {
  if (!v.ok()) return model::unexpected<std::string>{v.refusal()};
  return message;
}

// ---- to the wire ----

wire::Point to_point(const model::Vector3& p) {
  wire::Point point;
  point.x(p.x());
  point.y(p.y());
  point.z(p.z());
  return point;
}

wire::Quaternion to_quaternion(const model::Quaternion& q) {
  wire::Quaternion quaternion;
  quaternion.w(q.w());
  quaternion.x(q.x());
  quaternion.y(q.y());
  quaternion.z(q.z());
  return quaternion;
}

WireJoints to_joints(const model::Joints& q) {
  WireJoints joints{};
  std::copy(q.begin(), q.end(), joints.begin());
  return joints;
}

wire::Goal no_goal() {
  wire::Goal goal;
  goal.orientation(to_quaternion(model::Quaternion::Identity()));
  return goal;
}

bool is_linear(const model::MotionRequest& motion) {
  return std::holds_alternative<model::LinearTarget>(motion.target);
}

wire::Goal to_goal(const model::MotionRequest& motion) {
  wire::Goal goal = no_goal();
  if (const auto* linear = std::get_if<model::LinearTarget>(&motion.target)) {
    goal.position(to_point(linear->X_WT.translation()));
    goal.orientation(to_quaternion(model::Quaternion{linear->X_WT.linear()}));
  } else if (const auto* joint = std::get_if<model::JointTarget>(&motion.target)) {
    goal.joints(to_joints(joint->q));
  }
  goal.has_velocity(motion.velocity.has_value());
  goal.velocity(motion.velocity.value_or(0));
  goal.has_acceleration(motion.acceleration.has_value());
  goal.acceleration(motion.acceleration.value_or(0));
  if (motion.tools) {
    goal.attach(motion.tools->attach.str());
    goal.detach(motion.tools->detach.str());
    goal.tool_time(same_value<wire::ToolTime>(motion.tools->when));
  }
  return goal;
}

wire::Tools to_tools(const std::vector<model::ToolName>& tools) {
  wire::Tools sent;
  sent.reserve(tools.size());
  for (const model::ToolName& tool : tools) sent.emplace_back(tool.str());
  return sent;
}

std::vector<wire::Conflict> to_conflicts(const std::vector<model::Conflict>& conflicts) {
  std::vector<wire::Conflict> sent(std::min(conflicts.size(), kMaxConflicts));
  for (std::size_t i = 0; i < sent.size(); ++i) {
    const model::Conflict& c = conflicts[i];
    sent[i].blocker(c.blocker.str());
    sent[i].own_link(tidy(c.own_link, model::kMaxNameLength));
    sent[i].blocker_link(tidy(c.blocker_link, model::kMaxNameLength));
    sent[i].from(nanoseconds(c.from));
    sent[i].until(nanoseconds(c.until));
    sent[i].clearance(c.clearance);
    sent[i].place(to_point(c.place));
  }
  return sent;
}

std::vector<wire::EscapeRefusal> to_refusals(const std::vector<model::EscapeRefusal>& refusals) {
  std::vector<wire::EscapeRefusal> sent(std::min(refusals.size(), kMaxRefusals));
  for (std::size_t i = 0; i < sent.size(); ++i) {
    sent[i].robot(refusals[i].robot.str());
    sent[i].way(same_value<wire::EscapeWay>(refusals[i].way));
    sent[i].text(tidy(refusals[i].text, kMaxText));
  }
  return sent;
}

/// Fills `wire` from the alternative it is called with.
struct FillCommand {
  wire::Command& command;

  void head(const model::CommandId& id, const model::RobotName& robot, wire::CommandKind kind) const {
    command.kind(kind);
    command.id(id.str());
    command.robot(robot.str());
    command.motion(no_goal());
  }
  /// Into a Command or a QueueEntry: both have the same members for it.
  template <typename Wire>
  static void fill(Wire& w, const model::CommandSubmitted& c) {
    w.id(c.id.str());
    w.kind(is_linear(c.motion) ? wire::COMMAND_LINEAR : wire::COMMAND_JOINT);
    w.motion(to_goal(c.motion));
    w.priority(c.priority);
    w.has_deadline(c.deadline.has_value());
    w.deadline(c.deadline.value_or(0));
  }
  void operator()(const model::CommandSubmitted& c) const {
    command.robot(c.robot.str());
    fill(command, c);
  }
  void operator()(const model::CommandCancelled& c) const { head(c.id, c.robot, wire::COMMAND_CANCEL); }
  void operator()(const model::StopRequested& c) const { head(c.id, c.robot, wire::COMMAND_STOP); }
  void operator()(const model::HoldRequested& c) const { head(c.id, c.robot, wire::COMMAND_HOLD); }
  void operator()(const model::ResumeRequested& c) const { head(c.id, c.robot, wire::COMMAND_RESUME); }
  void operator()(const model::QueueReplaced& c) const {
    head(c.id, c.robot, wire::COMMAND_REPLACE);
    command.queue().resize(c.commands.size());
    for (std::size_t i = 0; i < c.commands.size(); ++i) fill(command.queue()[i], c.commands[i]);
  }
};

struct FillDispatch {
  wire::Dispatch& dispatch;

  void head(const model::RobotName& robot, wire::DispatchKind kind) const {
    dispatch.kind(kind);
    dispatch.robot(robot.str());
    dispatch.motion(no_goal());
  }
  void operator()(const model::Dispatch& d) const {
    head(d.robot, wire::DISPATCH_EXECUTE);
    dispatch.id(d.id.str());
    dispatch.attempt(d.attempt);
    dispatch.motion_kind(is_linear(d.motion) ? wire::MOTION_LINEAR : wire::MOTION_JOINT);
    dispatch.motion(to_goal(d.motion));
    dispatch.from(to_joints(d.from));
    dispatch.holds(to_tools(d.holds));
    dispatch.earliest(nanoseconds(d.earliest));
    dispatch.latest(nanoseconds(d.latest));
    dispatch.duration(d.duration);
  }
  void operator()(const model::Withdrawal& w) const {
    head(w.robot, wire::DISPATCH_WITHDRAW);
    dispatch.id(w.id.str());
    dispatch.attempt(w.attempt);
  }
  void operator()(const Heartbeat& h) const {
    dispatch.held(h.held);
    head(h.robot, wire::DISPATCH_HEARTBEAT);
    dispatch.echo_proxy_incarnation(h.proxy_incarnation);
    dispatch.echo_proxy_sent(h.proxy_sent.count());
    dispatch.planner_received(nanoseconds(h.planner_received));
    dispatch.planner_sent(nanoseconds(h.planner_sent));
  }
};

}  // namespace

Converted<CommandMessage> from_wire(const wire::Command& w, const std::string& owner) {
  Validator v;
  check_version(v, w.version());
  const model::RobotName robot{check_owner(v, "robot", w.robot().to_string(), owner)};
  const model::CommandId id{v.name("id", w.id().to_string())};
  CommandMessage message;
  message.client = v.name("client", w.client().to_string());
  switch (v.known("kind", w.kind(), wire::COMMAND_REPLACE)) {
    case wire::COMMAND_LINEAR: message.request = read_command(v, w, id, robot, true); break;
    case wire::COMMAND_JOINT: message.request = read_command(v, w, id, robot, false); break;
    case wire::COMMAND_CANCEL: message.request = model::CommandCancelled{id, robot}; break;
    case wire::COMMAND_STOP: message.request = model::StopRequested{id, robot}; break;
    case wire::COMMAND_HOLD: message.request = model::HoldRequested{id, robot}; break;
    case wire::COMMAND_RESUME: message.request = model::ResumeRequested{id, robot}; break;
    case wire::COMMAND_REPLACE: message.request = model::QueueReplaced{id, robot, read_queue(v, w.queue(), robot)}; break;
  }
  return result(v, std::move(message));
}

Converted<StatusMessage> from_wire(const wire::CommandStatus& w, const std::string& owner) {
  Validator v;
  check_version(v, w.version());
  StatusMessage message;
  message.planner_incarnation = w.planner_incarnation();
  model::CommandStatus& status = message.status;
  status.id = model::CommandId{v.name("id", w.id().to_string())};
  status.robot = model::RobotName{check_owner(v, "robot", w.robot().to_string(), owner)};
  status.escape = w.escape();
  status.serves = model::CommandId{v.name_or_empty("serves", w.serves().to_string())};
  status.state = v.known("state", w.state(), model::CommandState::failed);
  status.reason = v.known("reason", w.reason(), model::Reason::replaced);
  status.text = v.text("text", w.text().to_string(), kMaxText);
  status.submitted = v.stamp("submitted", w.submitted());
  status.start = if_present<model::Instant>(w.has_start(), [&] { return v.stamp("start", w.start()); });
  status.end = if_present<model::Instant>(w.has_end(), [&] { return v.stamp("end", w.end()); });
  status.delay = v.number("delay", w.delay(), kMaxSeconds);
  status.conflicts = read_conflicts(v, w.conflicts());
  status.refusals = read_refusals(v, w.refusals());
  status.verdict = v.known("verdict", w.verdict(), model::DeadlineVerdict::impossible);
  status.deadline =
      if_present<model::Instant>(status.verdict != model::DeadlineVerdict::none, [&] { return v.stamp("deadline", w.deadline()); });
  return result(v, std::move(message));
}

Converted<DispatchMessage> from_wire(const wire::Dispatch& w, const std::string& owner) {
  Validator v;
  check_version(v, w.version());
  const model::RobotName robot{check_owner(v, "robot", w.robot().to_string(), owner)};
  DispatchMessage message;
  message.planner_incarnation = w.planner_incarnation();
  message.fingerprint = w.fingerprint();
  v.require(w.planner_incarnation() != 0, [] { return std::string{"planner_incarnation: 0 means no planner"}; });
  const auto read_id = [&] { return model::CommandId{v.name("id", w.id().to_string())}; };
  switch (v.known("kind", w.kind(), wire::DISPATCH_HEARTBEAT)) {
    case wire::DISPATCH_EXECUTE: {
      model::Dispatch d;
      d.id = read_id();
      d.robot = robot;
      d.attempt = w.attempt();
      d.motion = read_motion(v, w.motion(), v.known("motion_kind", w.motion_kind(), wire::MOTION_JOINT) == wire::MOTION_LINEAR);
      d.from = read_joints(v, "from", w.from());
      d.holds = read_tools(v, "holds", w.holds());
      d.earliest = v.stamp("earliest", w.earliest());
      d.latest = v.stamp("latest", w.latest());
      v.require(d.earliest <= d.latest, [] { return std::string{"latest: before earliest, the start window is empty"}; });
      d.duration = v.non_negative("duration", w.duration(), kMaxSeconds);
      message.order = std::move(d);
      break;
    }
    case wire::DISPATCH_WITHDRAW: message.order = model::Withdrawal{read_id(), robot, w.attempt()}; break;
    case wire::DISPATCH_HEARTBEAT:
      message.order = Heartbeat{robot,
                                w.echo_proxy_incarnation(),
                                v.stamp("echo_proxy_sent", w.echo_proxy_sent()).time_since_epoch(),
                                v.stamp("planner_received", w.planner_received()),
                                v.stamp("planner_sent", w.planner_sent()),
                                w.held()};
      break;
  }
  return result(v, std::move(message));
}

Converted<ExecutionMessage> from_wire(const wire::Execution& w, const std::string& owner) {
  Validator v;
  check_version(v, w.version());
  ExecutionMessage message;
  message.planner_incarnation = w.planner_incarnation();
  message.proxy_incarnation = w.proxy_incarnation();
  model::ExecutionReported& report = message.report;
  report.id = model::CommandId{v.name("id", w.id().to_string())};
  report.robot = model::RobotName{check_owner(v, "robot", w.robot().to_string(), owner)};
  report.attempt = w.attempt();
  report.state = v.known("state", w.state(), model::ExecutionState::failed);
  report.at = v.stamp("at", w.at());
  report.uncertainty = v.non_negative("uncertainty", w.uncertainty(), kMaxSeconds);
  report.joints = read_joints(v, "joints", w.joints());
  report.text = v.text("text", w.text().to_string(), kMaxText);
  report.holds = read_tools(v, "holds", w.holds());
  return result(v, std::move(message));
}

Converted<PostureMessage> from_wire(const wire::Posture& w, const std::string& owner) {
  Validator v;
  check_version(v, w.version());
  PostureMessage message;
  message.fingerprint = w.fingerprint();
  message.proxy_incarnation = w.proxy_incarnation();
  message.planner_incarnation = w.planner_incarnation();
  v.require(w.proxy_incarnation() != 0, [] { return std::string{"proxy_incarnation: 0 means no proxy"}; });
  message.proxy_sent = v.stamp("proxy_sent", w.proxy_sent()).time_since_epoch();
  model::PostureReported& posture = message.posture;
  posture.robot = model::RobotName{check_owner(v, "robot", w.robot().to_string(), owner)};
  posture.at = v.stamp("at", w.at());
  posture.uncertainty = v.non_negative("uncertainty", w.uncertainty(), kMaxSeconds);
  posture.joints = read_joints(v, "joints", w.joints());
  posture.X_WT = read_pose(v, "position", w.position(), "orientation", w.orientation());
  posture.moving = w.moving();
  posture.ready = w.ready();
  posture.motion = model::CommandId{v.name_or_empty("motion", w.motion().to_string())};
  posture.holds = read_tools(v, "holds", w.holds());
  message.held = w.held();
  return result(v, std::move(message));
}

Converted<model::PlannerState> from_wire(const wire::PlannerState& w, const std::string& owner) {
  Validator v;
  check_version(v, w.version());
  model::PlannerState state;
  state.cell = check_owner(v, "cell", w.cell().to_string(), owner);
  state.fingerprint = w.fingerprint();
  state.incarnation = w.incarnation();
  v.require(w.incarnation() != 0, [] { return std::string{"incarnation: 0 means no planner"}; });
  state.at = v.stamp("at", w.at());
  state.strategy = v.name("strategy", w.strategy().to_string());
  v.require(w.robots().size() <= kMaxRobots, [&] { return "robots: " + std::to_string(w.robots().size()) + " are too many"; });
  state.accepted = w.accepted();
  state.rejected = w.rejected();
  state.completed = w.completed();
  state.refused_samples = w.refused_samples();
  for (const wire::RobotStatus& r : w.robots()) {
    if (!v.ok()) break;
    state.robots.push_back(
        {model::RobotName{v.name("robots.name", r.name().to_string())}, v.known("robots.mode", r.mode(), model::RobotMode::moving),
         r.queued(), model::CommandId{v.name_or_empty("robots.current", r.current().to_string())},
         v.known("robots.reason", r.reason(), model::Reason::replaced), v.text("robots.text", r.text().to_string(), kMaxText),
         read_conflicts(v, r.conflicts()), read_refusals(v, r.refusals()),
         model::CommandId{v.name_or_empty("robots.serves", r.serves().to_string())}, read_tools(v, "robots.holds", r.holds()), r.held()});
  }
  return result(v, std::move(state));
}

wire::Command to_wire(const CommandMessage& message) {
  wire::Command w;
  w.version(wire::PROTOCOL_VERSION);
  w.client(message.client);
  std::visit(FillCommand{w}, message.request);
  return w;
}

wire::CommandStatus to_wire(const StatusMessage& message) {
  const model::CommandStatus& status = message.status;
  wire::CommandStatus w;
  w.version(wire::PROTOCOL_VERSION);
  w.planner_incarnation(message.planner_incarnation);
  w.id(status.id.str());
  w.robot(status.robot.str());
  w.escape(status.escape);
  w.serves(status.serves.str());
  w.state(same_value<wire::CommandState>(status.state));
  w.reason(same_value<wire::ReasonCode>(status.reason));
  w.text(tidy(status.text, kMaxText));
  w.submitted(nanoseconds(status.submitted));
  w.has_start(status.start.has_value());
  w.start(nanoseconds(status.start.value_or(model::Instant{})));
  w.has_end(status.end.has_value());
  w.end(nanoseconds(status.end.value_or(model::Instant{})));
  w.delay(status.delay);
  w.conflicts(to_conflicts(status.conflicts));
  w.refusals(to_refusals(status.refusals));
  w.verdict(same_value<wire::DeadlineVerdict>(status.verdict));
  w.deadline(nanoseconds(status.deadline.value_or(model::Instant{})));
  return w;
}

wire::Dispatch to_wire(const DispatchMessage& message) {
  wire::Dispatch w;
  w.version(wire::PROTOCOL_VERSION);
  w.planner_incarnation(message.planner_incarnation);
  w.fingerprint(message.fingerprint);
  std::visit(FillDispatch{w}, message.order);
  return w;
}

wire::Execution to_wire(const ExecutionMessage& message) {
  const model::ExecutionReported& report = message.report;
  wire::Execution w;
  w.version(wire::PROTOCOL_VERSION);
  w.planner_incarnation(message.planner_incarnation);
  w.proxy_incarnation(message.proxy_incarnation);
  w.id(report.id.str());
  w.robot(report.robot.str());
  w.attempt(report.attempt);
  w.state(same_value<wire::ExecutionState>(report.state));
  w.at(nanoseconds(report.at));
  w.uncertainty(report.uncertainty);
  w.joints(to_joints(report.joints));
  w.text(tidy(report.text, kMaxText));
  w.holds(to_tools(report.holds));
  return w;
}

wire::Posture to_wire(const PostureMessage& message) {
  const model::PostureReported& posture = message.posture;
  wire::Posture w;
  w.version(wire::PROTOCOL_VERSION);
  w.robot(posture.robot.str());
  w.fingerprint(message.fingerprint);
  w.proxy_incarnation(message.proxy_incarnation);
  w.planner_incarnation(message.planner_incarnation);
  w.proxy_sent(message.proxy_sent.count());
  w.at(nanoseconds(posture.at));
  w.uncertainty(posture.uncertainty);
  w.joints(to_joints(posture.joints));
  w.position(to_point(posture.X_WT.translation()));
  w.orientation(to_quaternion(model::Quaternion{posture.X_WT.linear()}));
  w.moving(posture.moving);
  w.ready(posture.ready);
  w.motion(posture.motion.str());
  w.holds(to_tools(posture.holds));
  w.held(message.held);
  return w;
}

wire::PlannerState to_wire(const model::PlannerState& state) {
  wire::PlannerState w;
  w.version(wire::PROTOCOL_VERSION);
  w.cell(state.cell);
  w.fingerprint(state.fingerprint);
  w.incarnation(state.incarnation);
  w.at(nanoseconds(state.at));
  w.strategy(state.strategy);
  w.accepted(state.accepted);
  w.rejected(state.rejected);
  w.completed(state.completed);
  w.refused_samples(state.refused_samples);
  w.robots().reserve(state.robots.size());
  for (const model::RobotStatus& r : state.robots) {
    wire::RobotStatus robot;
    robot.name(r.name.str());
    robot.mode(same_value<wire::RobotMode>(r.mode));
    robot.queued(r.queued);
    robot.current(r.current.str());
    robot.serves(r.serves.str());
    robot.reason(same_value<wire::ReasonCode>(r.reason));
    robot.text(tidy(r.text, kMaxText));
    robot.conflicts(to_conflicts(r.conflicts));
    robot.refusals(to_refusals(r.refusals));
    robot.holds(to_tools(r.holds));
    robot.held(r.held);
    w.robots().push_back(std::move(robot));
  }
  return w;
}

}  // namespace interlace::dds
