#include "robot_proxy/drivers/sim/sim_controller.hpp"

#include <algorithm>
#include <utility>

namespace interlace::proxy {

using model::Duration;
using model::from_seconds;
using model::Joints;
using model::to_seconds;

namespace {

using Tools = std::vector<model::ToolName>;

bool is_in(const model::ToolName& tool, const Tools& held) {
  return std::find(held.begin(), held.end(), tool) != held.end();
}

/// Why a hand that holds `held` cannot do that; empty: it can.
std::string why_not(const model::ToolChange& change, const Tools& held) {
  if (!change.detach.empty() && !is_in(change.detach, held)) return "there is no " + change.detach.str() + " in its hand to leave";
  if (!change.attach.empty() && is_in(change.attach, held)) return change.attach.str() + " is in its hand already";
  return {};
}

Tools changed(Tools held, const model::ToolChange& change) {
  held.erase(std::remove(held.begin(), held.end(), change.detach), held.end());
  if (!change.attach.empty()) held.push_back(change.attach);
  return held;
}

}  // namespace

SimController::SimController(const model::Robot& robot, SimOptions options)
    : robot_(&robot), options_(options), random_(options.seed), standing_(robot.start) {}

Capabilities SimController::capabilities() const {
  const model::ControllerTraits& traits = robot_->controller;
  Capabilities c;
  c.can_stop = options_.can_stop;
  c.earliest_start = from_seconds(std::max(0.0, traits.start_latency - traits.start_jitter));
  c.latest_start = from_seconds(traits.latest_start());
  if (options_.period.count() > 0) c.posture_rate = 1 / to_seconds(options_.period);
  return c;
}

DriverResult SimController::execute(const model::MotionRequest& request, MotionNumber number, LocalTime now) {
  if (run_ && now < run_->end) return model::unexpected("motion " + std::to_string(run_->number) + " is still running");
  if (const ControllerState state = observe(now); !state.ready) return model::unexpected("not ready: " + state.fault);

  // Drawn whether used or not, so that a refused motion does not shift the numbers of those after it by what refused it.
  const model::ControllerTraits& traits = robot_->controller;
  const double latency = std::max(0.0, uniform(traits.start_latency - traits.start_jitter, traits.latest_start()));
  const double stretch = uniform(1 - traits.speed_error, 1 + traits.speed_error);

  std::optional<Script> script;
  if (!script_.empty()) {
    script = std::move(script_.front());
    script_.pop_front();
    if (!script->fail_at) return model::unexpected(script->why);
  }
  const Tools held = holds(now);
  if (request.tools) {
    if (const std::string why = why_not(*request.tools, held); !why.empty()) return model::unexpected(why);
  }
  const Joints from = run_ ? run_->motion.joints(path_time(*run_, now)) : standing_;
  auto motion = model::plan_motion(*robot_, from, request);
  if (!motion) return model::unexpected(motion.error().text);

  const double end_path_time = script ? *script->fail_at * motion->duration() : motion->duration();
  const LocalTime begin = now + from_seconds(latency);
  Run run{std::move(*motion), number, stretch, begin, begin + from_seconds(end_path_time * stretch), end_path_time, {}};
  run.fault = script.has_value();
  if (script) run.failure = script->why;
  run.held = held;
  run.change = request.tools;
  run_ = std::move(run);
  return {};
}

DriverResult SimController::stop(LocalTime now) {
  if (!options_.can_stop) return model::unexpected(std::string("this controller cannot stop a running motion"));
  if (!run_ || now >= run_->end || run_->braking) return {};
  if (now < run_->begin) {
    run_->begin = run_->end = now;
    run_->end_path_time = 0;
    run_->cancelled = true;
    run_->fault = false;
    run_->failure = "stopped before it began";
    return {};
  }
  const double here = to_seconds(now - run_->begin) / run_->stretch;
  const double rest = here + to_seconds(braking_time()) / 2 / run_->stretch;
  if (rest >= run_->end_path_time) return {};  // it ends before it could be stopped
  run_->braking = now;
  run_->end = now + braking_time();
  run_->end_path_time = rest;
  run_->fault = false;
  run_->failure = "stopped on its way";
  return {};
}

Joints SimController::joints(LocalTime now) const {
  if (frozen_) return *frozen_;
  return run_ ? run_->motion.joints(path_time(*run_, now)) : standing_;
}

Tools SimController::holds(LocalTime now) const {
  if (!run_) return robot_->holds;
  if (!run_->change || run_->cancelled) return run_->held;
  const bool arrived = now >= run_->end && run_->failure.empty();
  const bool over = run_->change->when == model::ToolTime::start ? now >= run_->begin : arrived;
  return over ? changed(run_->held, *run_->change) : run_->held;
}

ControllerState SimController::observe(LocalTime now) const {
  ControllerState state;
  state.at = now;
  state.joints = joints(now);
  state.X_WT = robot_->X_WB * model::tcp_pose(robot_->model, state.joints);
  state.holds = holds(now);
  state.fault = fault_;
  if (run_) {
    MotionProgress& progress = state.motion;
    progress.number = run_->number;
    if (run_->cancelled) {
      progress.phase = MotionPhase::refused;
      progress.text = run_->failure;
    } else if (now < run_->begin) {
      progress.phase = MotionPhase::commanded;
    } else {
      progress.began = run_->begin;
      progress.phase = MotionPhase::moving;
    }
    if (progress.phase == MotionPhase::moving && now >= run_->end) {
      progress.ended = run_->end;
      progress.phase = run_->failure.empty() ? MotionPhase::finished : MotionPhase::failed;
      progress.text = run_->failure;
    }
    state.moving = progress.phase == MotionPhase::moving;
    if (run_->fault && now >= run_->end && state.fault.empty()) state.fault = run_->failure;
  }
  state.ready = state.fault.empty();
  return state;
}

std::optional<LocalTime> SimController::next_event(LocalTime now) const {
  if (!run_ || now >= run_->end) return std::nullopt;
  return now < run_->begin ? run_->begin : run_->end;
}

void SimController::refuse_next(std::string why) {
  script_.push_back({std::nullopt, std::move(why)});
}

void SimController::fail_next(double fraction, std::string why) {
  script_.push_back({std::clamp(fraction, 0.0, 1.0), std::move(why)});
}

void SimController::freeze_posture(LocalTime now) {
  frozen_ = observe(now).joints;
}

void SimController::clear_fault(LocalTime now) {
  fault_.clear();
  if (run_ && now >= run_->end) run_->fault = false;
}

double SimController::path_time(const Run& run, LocalTime now) const {
  if (now <= run.begin) return 0;
  if (now >= run.end) return run.end_path_time;
  Duration elapsed = now - run.begin;
  if (options_.period.count() > 0) elapsed -= elapsed % options_.period;
  const Duration braked = run.braking ? run.begin + elapsed - *run.braking : Duration{0};
  if (braked.count() <= 0) return std::min(to_seconds(elapsed) / run.stretch, run.end_path_time);
  const double s = to_seconds(braked);
  const double free = to_seconds(*run.braking - run.begin);
  return std::min((free + s - s * s / (2 * to_seconds(braking_time()))) / run.stretch, run.end_path_time);
}

Duration SimController::braking_time() const {
  return from_seconds(robot_->tcp.velocity / robot_->tcp.acceleration);
}

double SimController::uniform(double low, double high) {
  // Not std::uniform_real_distribution: its numbers differ between standard libraries. 53 bits fill a double.
  return low + (high - low) * (static_cast<double>(random_() >> 11) * 0x1p-53);
}

}  // namespace interlace::proxy
