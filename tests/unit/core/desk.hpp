#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "planner/core/planner.hpp"
#include "tests/support/arms.hpp"

namespace interlace::test {

using namespace std::chrono_literals;
using core::Instant;
using model::CommandState;
using model::Reason;

/// The planner with everything it says kept in order, and short words for what it is told.
class Desk {
 public:
  static core::PlannerOptions usual() {
    core::PlannerOptions o;
    o.lead = 20ms;
    o.start_tolerance = 10ms;
    o.confirm = 30ms;
    return o;
  }

  /// As usual, but a deadlocked command waits: nobody is sent out of its way.
  static core::PlannerOptions without_escapes() {
    core::PlannerOptions o = usual();
    o.escapes = false;
    return o;
  }

  explicit Desk(std::shared_ptr<const model::Cell> its_cell = experiment_cell(true), const core::PlannerOptions& options = usual())
      : cell(std::move(its_cell)), planner(cell, options) {}

  /// Every robot reports that it stands where it starts.
  Desk& all_stand() {
    for (const auto& r : cell->robots) stands(r.name.str(), r.start);
    return *this;
  }

  void stands(const std::string& robot, const model::Joints& q) { posture(robot, q, false); }
  void posture(const std::string& robot, const model::Joints& q, bool moving, const std::string& motion = {}, bool ready = true) {
    model::PostureReported p;
    p.robot = model::RobotName{robot};
    p.at = now;
    p.joints = q;
    p.moving = moving;
    p.ready = ready;
    p.motion = model::CommandId{motion};
    p.holds = hands[robot];
    keep(planner.on(p, now));
  }
  static model::CommandSubmitted command(const std::string& id, const std::string& robot, const model::MotionRequest& motion,
                                         int priority = 0, std::optional<double> deadline = std::nullopt) {
    return {model::CommandId{id}, model::RobotName{robot}, motion, priority, deadline};
  }
  void submit(const std::string& id, const std::string& robot, const model::MotionRequest& motion, int priority = 0,
              std::optional<double> deadline = std::nullopt) {
    keep(planner.on(command(id, robot, motion, priority, deadline), now));
  }
  void hold(const std::string& id, const std::string& robot) {
    keep(planner.on(model::HoldRequested{model::CommandId{id}, model::RobotName{robot}}, now));
  }
  void resume(const std::string& id, const std::string& robot) {
    keep(planner.on(model::ResumeRequested{model::CommandId{id}, model::RobotName{robot}}, now));
  }
  void replace(const std::string& id, const std::string& robot, std::vector<model::CommandSubmitted> commands) {
    keep(planner.on(model::QueueReplaced{model::CommandId{id}, model::RobotName{robot}, std::move(commands)}, now));
  }
  void cancel(const std::string& id, const std::string& robot) {
    keep(planner.on(model::CommandCancelled{model::CommandId{id}, model::RobotName{robot}}, now));
  }
  void stop(const std::string& id, const std::string& robot) {
    keep(planner.on(model::StopRequested{model::CommandId{id}, model::RobotName{robot}}, now));
  }
  void report(const model::Dispatch& d, model::ExecutionState state, const model::Joints& q = model::Joints::Zero(),
              const std::string& text = {}) {
    model::ExecutionReported e;
    e.id = d.id;
    e.robot = d.robot;
    e.attempt = d.attempt;
    e.state = state;
    e.at = now;
    e.joints = q;
    e.text = text;
    e.holds = hands[d.robot.str()];
    keep(planner.on(e, now));
  }
  void pass(core::Duration time) {
    now += time;
    keep(planner.advance(now));
  }
  /// Time passes until something is dispatched; false when nothing is within `limit`.
  bool pass_until_dispatch(core::Duration limit = 60s) {
    const Instant end = now + limit;
    const std::size_t before = dispatches.size();
    while (dispatches.size() == before) {
      const auto next = planner.next_deadline();
      if (!next || *next > end) return false;
      now = std::max(now, *next);
      keep(planner.advance(now));
    }
    return true;
  }

  /// The newest dispatch of a command; fails the test when there is none.
  [[nodiscard]] model::Dispatch dispatch_of(const std::string& id) const {
    for (auto it = dispatches.rbegin(); it != dispatches.rend(); ++it) {
      if (it->id.str() == id) return *it;
    }
    ADD_FAILURE() << "no dispatch of " << id;
    return {};
  }
  [[nodiscard]] std::size_t dispatches_of(const std::string& id) const {
    return static_cast<std::size_t>(std::count_if(dispatches.begin(), dispatches.end(), [&](const auto& d) { return d.id.str() == id; }));
  }
  /// The newest status of a command; fails the test when there is none.
  [[nodiscard]] model::CommandStatus status_of(const std::string& id) const {
    for (auto it = statuses.rbegin(); it != statuses.rend(); ++it) {
      if (it->id.str() == id) return *it;
    }
    ADD_FAILURE() << "no status of " << id;
    return {};
  }
  [[nodiscard]] std::size_t finals_of(const std::string& id) const {
    return static_cast<std::size_t>(
        std::count_if(statuses.begin(), statuses.end(), [&](const auto& s) { return s.id.str() == id && is_final(s.state); }));
  }
  [[nodiscard]] const model::Robot& robot(const std::string& name) const {
    return cell->robots[cell->find(model::RobotName{name}).value()];
  }

  /// Where a dispatched motion ends.
  [[nodiscard]] model::Joints end_of(const model::Dispatch& d) const {
    return model::plan_motion(robot(d.robot.str()), d.from, d.motion).value().to();
  }
  /// The proxy carries a dispatch out at its earliest start.
  void carry_out(const model::Dispatch& d) {
    begin(d);
    finish(d);
  }
  void begin(const model::Dispatch& d) {
    now = std::max(now, d.earliest);
    report(d, model::ExecutionState::accepted);
    report(d, model::ExecutionState::started);
  }
  void finish(const model::Dispatch& d) {
    now = std::max(now, d.earliest + model::from_seconds(d.duration));
    report(d, model::ExecutionState::completed, end_of(d));
  }
  /// Submits and carries out at once.
  void go(const std::string& id, const std::string& robot_name, const model::MotionRequest& motion) {
    submit(id, robot_name, motion);
    if (dispatches_of(id) == 0) {
      ASSERT_TRUE(pass_until_dispatch());
    }
    carry_out(dispatch_of(id));
  }

  std::shared_ptr<const model::Cell> cell;
  core::Planner planner;
  Instant now{};
  std::map<std::string, std::vector<model::ToolName>> hands;  ///< what each robot says it holds
  std::vector<model::Dispatch> dispatches;
  std::vector<model::CommandStatus> statuses;
  std::vector<model::Withdrawal> withdrawals;

 private:
  void keep(core::Decisions d) {
    std::move(d.dispatches.begin(), d.dispatches.end(), std::back_inserter(dispatches));
    std::move(d.statuses.begin(), d.statuses.end(), std::back_inserter(statuses));
    std::move(d.withdrawals.begin(), d.withdrawals.end(), std::back_inserter(withdrawals));
  }
};

/// Places of experiment 4.2: where both arms cannot be at once, and where each is out of the other's way.
inline model::MotionRequest to_centre() {
  return line_to(pose_mm(350, 0, 200));
}
inline model::MotionRequest r1_aside() {
  return line_to(pose_mm(300, 250, 330));
}
inline model::MotionRequest r1_home() {
  return line_to(pose_mm(450, 250, 300));
}
inline model::MotionRequest r2_aside() {
  return line_to(pose_mm(300, -250, 330));
}
inline model::MotionRequest r2_home() {
  return line_to(pose_mm(450, -250, 300));
}

}  // namespace interlace::test
