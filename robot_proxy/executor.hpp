#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "common/model/messages.hpp"
#include "robot_proxy/clock_offset.hpp"
#include "robot_proxy/controller_state.hpp"

namespace interlace::proxy {

/// Now, and what the proxy knows of planner time now; no clock: no echo of the present planner yet.
struct Moment {
  LocalTime local{};
  std::optional<ClockEstimate> clock;
};

/// `uncertainty` [s] of a report made while the proxy has no estimate of planner time; its `at` is meaningless then.
inline constexpr double kUnknownTime = 1e6;

struct ExecutorOptions {
  double from_tolerance = 1e-3;    ///< largest deviation of a joint from the posture the motion was planned from [rad]
  double arrival_joints = 1e-3;    ///< of a joint from a joint target, at the end [rad]
  double arrival_position = 1e-3;  ///< of the TCP from a linear target [m]
  double arrival_rotation = 2e-3;  ///< ditto [rad]
  double observation_age = 0.2;    ///< an older observation says nothing about where the robot is [s]
  double begin_grace = 0.5;        ///< not seen moving that long after the controller's latest start: failed [s]
  double overrun_factor = 1.5;     ///< not arrived after duration · factor + grace from the start: failed
  double overrun_grace = 1.0;      ///< [s]
  std::size_t remembered = 1024;   ///< commands whose outcome is kept to answer repeated messages
};

/// Give this to the controller at once.
struct StartMotion {
  MotionNumber number = 0;
  model::CommandId id;
  model::MotionRequest request;
};

/// What to do now. `start` comes at most once per call and only when the controller stands idle.
struct Actions {
  std::optional<StartMotion> start;
  bool stop = false;  ///< the running motion is out of hand: stop it if the controller can
  std::vector<model::ExecutionReported> reports;
};

/// Decides when dispatched motions start, and tells the planner what became of each. Pure: no clock, thread or I/O; not thread-safe.
///
/// Drive it: feed every message and every observation as it comes, carry out the Actions in the order start, stop, reports, and call
/// `advance` at `next_event`. When a start could not be handed to the controller, say so with `refused_by_controller`. Before each call
/// that may start a motion (dispatch, advance) feed a fresh observation, so that posture and readiness are those of this moment.
///
/// Rules
/// * One motion at a time: a dispatch is refused while another one waits or runs, or the controller moves by itself.
/// * A motion is started only when this is certainly inside its window: not before estimate − uncertainty ≥ earliest, and refused when
///   estimate + uncertainty + the controller's latest start latency would be beyond latest. Both ends belong to the window.
/// * Refused too: controller not ready or not heard from, no estimate of planner time, a move the controller does not know, a posture
///   other than `from`, a tool in the hand that the motion was planned without. All of it is checked when the dispatch comes and again when
///   it starts.
/// * Messages may be repeated, lost and reordered. The same id and attempt is answered again with the last report and started once. An id
///   that was once started is never started again, whatever the attempt. Older attempts are ignored; a newer one replaces a waiting one.
///   A withdrawal that overtakes its dispatch is remembered and withdraws it when it comes. After the start a withdrawal is answered with
///   `started` (or how it ended).
/// * Another planner incarnation drops the waiting dispatch and forgets the answers, as ids, attempts and times are now another
///   planner's; a running motion runs on and is reported.
/// * The outcome of the last `remembered` commands is kept; nothing else grows.
///
/// Time of `started`: the controller's own time of the first movement where it knows it; otherwise the middle between the last
/// observation (or the command) that saw it standing and the first that saw it moving, with half that gap as uncertainty, to which the
/// uncertainty of the clock is added. `completed` is reported only when the controller says finished, stands still and stands at the
/// target within the arrival tolerances; else `failed`.
class Executor {
 public:
  Executor(model::RobotName robot, Capabilities capabilities, ExecutorOptions options = {});

  /// A message for another robot is ignored.
  [[nodiscard]] Actions on(const model::Dispatch& dispatch, const Moment& now);
  [[nodiscard]] Actions on(const model::Withdrawal& withdrawal, const Moment& now);

  /// The controller as seen; an observation older than the last one is ignored.
  [[nodiscard]] Actions on(const ControllerState& seen, const Moment& now);

  /// A heartbeat, an echo or a state of the planner came.
  [[nodiscard]] Actions on_planner(std::uint64_t incarnation, const Moment& now);

  /// The controller did not take the motion of `StartMotion::number`; nothing moves.
  [[nodiscard]] Actions refused_by_controller(MotionNumber number, const std::string& why, const Moment& now);

  /// Time passes.
  [[nodiscard]] Actions advance(const Moment& now);

  /// When to call `advance` next at the latest, if nothing else happens and the clock estimate stays as given: the start of the waiting
  /// dispatch or a deadline of the running motion. Empty when there is nothing to wait for; in the past
  /// when `advance` is due at once.
  [[nodiscard]] std::optional<LocalTime> next_event(const std::optional<ClockEstimate>& clock) const;

  /// Command given to the controller and not ended yet; nullptr when none.
  [[nodiscard]] const model::CommandId* running() const;
  /// Command accepted and waiting for its window; nullptr when none.
  [[nodiscard]] const model::CommandId* waiting() const;

 private:
  /// The command in hand, waiting or running.
  struct Active {
    model::Dispatch dispatch;
    model::ExecutionReported last;  // the answer to a repeated message
    MotionNumber number = 0;        // 0: waiting for its window
    LocalTime commanded{};
    LocalTime looked{};    // last look at this motion, at first the time of the command
    bool started = false;  // seen to move
    bool of_former_planner = false;
    LocalTime deadline = LocalTime::max();
  };
  /// What became of a command that is no longer in hand.
  struct Outcome {
    model::ExecutionReported last;
    bool executed = false;
  };

  void accept_or_refuse(const model::Dispatch& dispatch, const Moment& now, Actions& actions);
  [[nodiscard]] std::optional<std::string> why_not(const model::Dispatch& dispatch, const Moment& now) const;
  [[nodiscard]] LocalTime start_time(const model::Dispatch& dispatch, const ClockEstimate& clock) const;
  void step(const Moment& now, Actions& actions);
  void start_if_due(const Moment& now, Actions& actions);
  void follow_motion(const Moment& now, Actions& actions);
  void begin(const Moment& now, Actions& actions);
  [[nodiscard]] std::optional<std::string> why_not_arrived(const model::MotionRequest& request) const;
  void finish(model::ExecutionState state, std::string text, const Moment& now, Actions& actions);
  [[nodiscard]] model::ExecutionReported report(const model::CommandId& id, std::uint32_t attempt, model::ExecutionState state,
                                                const Moment& now, std::string text = {}) const;
  static void set_time(model::ExecutionReported& report, LocalTime at, model::Duration doubt, const Moment& now);
  [[nodiscard]] std::optional<Outcome> recall(const model::CommandId& id) const;
  void remember(const model::ExecutionReported& last, bool executed);

  model::RobotName robot_;
  Capabilities capabilities_;
  ExecutorOptions options_;
  std::optional<std::uint64_t> incarnation_;
  std::optional<ControllerState> seen_;
  std::optional<Active> active_;
  MotionNumber last_number_ = 0;
  std::unordered_map<model::CommandId, Outcome> outcomes_;
  std::deque<model::CommandId> order_;  // of outcomes_, oldest first
};

}  // namespace interlace::proxy
