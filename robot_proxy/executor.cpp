#include "robot_proxy/executor.hpp"

#include <algorithm>
#include <utility>

namespace interlace::proxy {

using model::Dispatch;
using model::Duration;
using model::ExecutionReported;
using model::ExecutionState;
using model::from_seconds;
using model::Instant;
using model::to_seconds;

namespace {

std::string text_of(Duration d) {
  return std::to_string(to_seconds(d)) + " s";
}

/// The controller has taken the motion and not ended it.
bool under_way(const MotionProgress& motion) {
  return motion.phase == MotionPhase::commanded || motion.phase == MotionPhase::moving;
}

}  // namespace

Executor::Executor(model::RobotName robot, Capabilities capabilities, ExecutorOptions options)
    : robot_(std::move(robot)), capabilities_(capabilities), options_(options) {}

Actions Executor::on(const Dispatch& dispatch, const Moment& now) {
  Actions actions;
  if (dispatch.robot != robot_) return actions;
  const auto known = recall(dispatch.id);
  if (known && dispatch.attempt < known->last.attempt) return actions;
  if (known && (known->executed || dispatch.attempt == known->last.attempt)) {
    actions.reports.push_back(known->last);
  } else {
    if (waiting() != nullptr && *waiting() == dispatch.id) {
      finish(ExecutionState::withdrawn, "replaced by attempt " + std::to_string(dispatch.attempt), now, actions);
    }
    accept_or_refuse(dispatch, now, actions);
  }
  step(now, actions);
  return actions;
}

Actions Executor::on(const model::Withdrawal& withdrawal, const Moment& now) {
  Actions actions;
  if (withdrawal.robot != robot_) return actions;
  const auto known = recall(withdrawal.id);
  if (known && withdrawal.attempt < known->last.attempt) return actions;
  if (waiting() != nullptr && *waiting() == withdrawal.id) {
    active_->dispatch.attempt = withdrawal.attempt;  // it may have overtaken that attempt, which must not start any more either
    finish(ExecutionState::withdrawn, {}, now, actions);
  } else if (known && (known->executed || withdrawal.attempt == known->last.attempt)) {
    actions.reports.push_back(known->last);
  } else {
    actions.reports.push_back(report(withdrawal.id, withdrawal.attempt, ExecutionState::withdrawn, now));
    remember(actions.reports.back(), false);
  }
  step(now, actions);
  return actions;
}

Actions Executor::on(const ControllerState& seen, const Moment& now) {
  Actions actions;
  if (!seen_ || seen.at >= seen_->at) {
    seen_ = seen;
    follow_motion(now, actions);
  }
  step(now, actions);
  return actions;
}

Actions Executor::on_planner(std::uint64_t incarnation, const Moment& now) {
  Actions actions;
  if (incarnation_ && *incarnation_ != incarnation) {
    if (waiting() != nullptr) active_.reset();
    if (active_) active_->of_former_planner = true;
    outcomes_.clear();
    order_.clear();
  }
  incarnation_ = incarnation;
  step(now, actions);
  return actions;
}

Actions Executor::refused_by_controller(MotionNumber number, const std::string& why, const Moment& now) {
  Actions actions;
  if (active_ && active_->number == number) finish(ExecutionState::refused, "the controller refused: " + why, now, actions);
  step(now, actions);
  return actions;
}

Actions Executor::advance(const Moment& now) {
  Actions actions;
  step(now, actions);
  return actions;
}

std::optional<LocalTime> Executor::next_event(const std::optional<ClockEstimate>& clock) const {
  if (!active_) return std::nullopt;
  if (active_->number != 0) return active_->deadline;
  return clock ? start_time(active_->dispatch, *clock) : LocalTime::min();
}

const model::CommandId* Executor::running() const {
  return active_ && active_->number != 0 ? &active_->dispatch.id : nullptr;
}

const model::CommandId* Executor::waiting() const {
  return active_ && active_->number == 0 ? &active_->dispatch.id : nullptr;
}

void Executor::accept_or_refuse(const Dispatch& dispatch, const Moment& now, Actions& actions) {
  const auto why = active_ ? "busy with command '" + active_->dispatch.id.str() + "'" : why_not(dispatch, now);
  if (why) {
    actions.reports.push_back(report(dispatch.id, dispatch.attempt, ExecutionState::refused, now, *why));
    remember(actions.reports.back(), false);
    return;
  }
  actions.reports.push_back(report(dispatch.id, dispatch.attempt, ExecutionState::accepted, now));
  active_ = Active{dispatch, actions.reports.back()};
}

std::optional<std::string> Executor::why_not(const Dispatch& dispatch, const Moment& now) const {
  if (!now.clock) return "no estimate of planner time yet";
  if (!seen_) return "the controller was never heard from";
  const Duration silence = now.local - seen_->at;
  if (silence > from_seconds(options_.observation_age)) return "the controller was not heard from for " + text_of(silence);
  if (!seen_->ready) return "the controller is not ready: " + seen_->fault;
  if (seen_->moving || under_way(seen_->motion)) return std::string("the robot is moving already");
  const bool linear = std::holds_alternative<model::LinearTarget>(dispatch.motion.target);
  if (linear && !capabilities_.linear_moves) return std::string("the controller knows no linear moves");
  if (!linear && !capabilities_.joint_moves) return std::string("the controller knows no joint moves");
  Eigen::Index joint = 0;
  const double off = (seen_->joints - dispatch.from).cwiseAbs().maxCoeff(&joint);
  if (!(off <= options_.from_tolerance)) {
    return "joint " + std::to_string(joint + 1) + " stands " + std::to_string(off) + " rad from where the motion was planned to begin; " +
           std::to_string(options_.from_tolerance) + " are allowed";
  }
  for (const model::ToolName& tool : seen_->holds) {
    if (std::find(dispatch.holds.begin(), dispatch.holds.end(), tool) == dispatch.holds.end()) {
      return "the robot may hold '" + tool.str() + "', the motion was planned without it";
    }
  }
  const LocalTime start = std::max(now.local, start_time(dispatch, *now.clock));
  const Instant movement = later(later(now.clock->to_planner(start), now.clock->uncertainty), capabilities_.latest_start);
  if (movement > dispatch.latest) return "could begin " + text_of(movement - dispatch.latest) + " after the end of its window";
  return std::nullopt;
}

LocalTime Executor::start_time(const Dispatch& dispatch, const ClockEstimate& clock) const {
  return clock.to_local(later(dispatch.earliest, clock.uncertainty));
}

void Executor::step(const Moment& now, Actions& actions) {
  if (!active_) return;
  if (active_->number == 0) {
    start_if_due(now, actions);
  } else if (now.local >= active_->deadline) {
    actions.stop = true;
    const std::string late = text_of(now.local - active_->commanded) + " after the command";
    finish(ExecutionState::failed, (active_->started ? "not at its target " : "not seen moving ") + late, now, actions);
  }
}

void Executor::start_if_due(const Moment& now, Actions& actions) {
  if (now.clock && now.local < start_time(active_->dispatch, *now.clock)) return;
  if (const auto why = why_not(active_->dispatch, now)) return finish(ExecutionState::refused, *why, now, actions);
  active_->number = ++last_number_;
  active_->commanded = active_->looked = now.local;
  active_->deadline = now.local + capabilities_.latest_start + from_seconds(options_.begin_grace);
  actions.start = StartMotion{active_->number, active_->dispatch.id, active_->dispatch.motion};
}

void Executor::follow_motion(const Moment& now, Actions& actions) {
  if (!active_ || active_->number == 0 || seen_->motion.number != active_->number) return;
  const MotionProgress& motion = seen_->motion;
  if (motion.phase == MotionPhase::refused) return finish(ExecutionState::refused, motion.text, now, actions);
  const bool moved = motion.phase == MotionPhase::moving || motion.phase == MotionPhase::finished || motion.began;
  if (moved && !active_->started) begin(now, actions);
  const bool ended = motion.phase == MotionPhase::finished || motion.phase == MotionPhase::failed;
  if (ended && !seen_->moving) {
    const auto why = motion.phase == MotionPhase::failed ? motion.text : why_not_arrived(active_->dispatch.motion);
    finish(why ? ExecutionState::failed : ExecutionState::completed, why.value_or(""), now, actions);
  } else {
    active_->looked = seen_->at;
  }
}

void Executor::begin(const Moment& now, Actions& actions) {
  const Duration half_gap = (seen_->at - active_->looked) / 2;
  const LocalTime began = seen_->motion.began.value_or(active_->looked + half_gap);
  const Duration doubt = seen_->motion.began ? Duration{0} : half_gap + Duration{1};  // the halving may drop a nanosecond
  active_->started = true;
  active_->deadline = began + from_seconds(active_->dispatch.duration * options_.overrun_factor) + from_seconds(options_.overrun_grace);
  actions.reports.push_back(report(active_->dispatch.id, active_->dispatch.attempt, ExecutionState::started, now));
  set_time(actions.reports.back(), began, doubt, now);
  active_->last = actions.reports.back();
}

std::optional<std::string> Executor::why_not_arrived(const model::MotionRequest& request) const {
  if (const auto* target = std::get_if<model::JointTarget>(&request.target)) {
    const double off = (seen_->joints - target->q).cwiseAbs().maxCoeff();
    if (off <= options_.arrival_joints) return std::nullopt;
    return "ended " + std::to_string(off) + " rad from its target; " + std::to_string(options_.arrival_joints) + " are allowed";
  }
  const model::Pose& X_WT = std::get<model::LinearTarget>(request.target).X_WT;
  const double off = (seen_->X_WT.translation() - X_WT.translation()).norm();
  const double turned = model::angle_between(model::Quaternion(seen_->X_WT.linear()), model::Quaternion(X_WT.linear()));
  if (off <= options_.arrival_position && turned <= options_.arrival_rotation) return std::nullopt;
  return "ended " + std::to_string(off) + " m and " + std::to_string(turned) + " rad from its target; " +
         std::to_string(options_.arrival_position) + " m and " + std::to_string(options_.arrival_rotation) + " rad are allowed";
}

void Executor::finish(ExecutionState state, std::string text, const Moment& now, Actions& actions) {
  ExecutionReported last = report(active_->dispatch.id, active_->dispatch.attempt, state, now, std::move(text));
  if (state == ExecutionState::completed) {
    const auto& ended = seen_->motion.ended;
    set_time(last, ended.value_or(seen_->at), ended ? Duration{0} : seen_->at - active_->looked, now);
  }
  const bool executed = state == ExecutionState::completed || state == ExecutionState::failed;
  if (!active_->of_former_planner) remember(last, executed);
  actions.reports.push_back(std::move(last));
  active_.reset();
}

ExecutionReported Executor::report(const model::CommandId& id, std::uint32_t attempt, ExecutionState state, const Moment& now,
                                   std::string text) const {
  ExecutionReported r;
  r.id = id;
  r.robot = robot_;
  r.attempt = attempt;
  r.state = state;
  if (seen_) {
    r.joints = seen_->joints;
    r.holds = seen_->holds;
  }
  r.text = std::move(text);
  set_time(r, now.local, Duration{0}, now);
  return r;
}

void Executor::set_time(ExecutionReported& report, LocalTime at, Duration doubt, const Moment& now) {
  report.at = now.clock ? now.clock->to_planner(at) : Instant{};
  report.uncertainty = now.clock ? to_seconds(now.clock->uncertainty + doubt) : kUnknownTime;
}

std::optional<Executor::Outcome> Executor::recall(const model::CommandId& id) const {
  if (active_ && active_->dispatch.id == id && !active_->of_former_planner) return Outcome{active_->last, active_->number != 0};
  if (const auto found = outcomes_.find(id); found != outcomes_.end()) return found->second;
  return std::nullopt;
}

void Executor::remember(const ExecutionReported& last, bool executed) {
  const bool fresh = outcomes_.insert_or_assign(last.id, Outcome{last, executed}).second;
  if (!fresh) order_.erase(std::find(order_.begin(), order_.end(), last.id));
  order_.push_back(last.id);
  if (order_.size() > options_.remembered) {
    outcomes_.erase(order_.front());
    order_.pop_front();
  }
}

}  // namespace interlace::proxy
