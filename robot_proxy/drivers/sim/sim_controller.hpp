#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <random>
#include <string>

#include "common/model/motion.hpp"
#include "robot_proxy/driver.hpp"

namespace interlace::proxy {

struct SimOptions {
  model::Duration period{0};  ///< interpolation: a posture holds for one period; 0: continuous. Never quantises begin and end.
  bool can_stop = true;
  std::uint64_t seed = 1;  ///< of latency and speed error
};

/// A robot controller as the planner knows them: foreign. It plans each motion itself from where it stands, begins after its own latency
/// (uniform in start_latency ± start_jitter, not below 0), and takes duration · (1 + e) with e uniform in ± speed_error; the numbers are
/// `Robot::controller`. Pure and deterministic: time is handed in, the same seed and calls give the same motions on every machine.
/// Not thread-safe. The robot must outlive it.
///
/// Everything follows from the calls made, so nothing needs polling: `observe` answers for any time at or after the last call, and
/// `next_event` names the next instant at which the phase changes. Begin and end are exact to the nanosecond.
class SimController {
 public:
  explicit SimController(const model::Robot& robot, SimOptions options = {});

  [[nodiscard]] Capabilities capabilities() const;

  /// Takes a motion; refuses when one is running, when not ready, or when it cannot be planned.
  [[nodiscard]] DriverResult execute(const model::MotionRequest& request, MotionNumber number, LocalTime now);

  /// Slows down along the path, evenly in path time, within tcp.velocity / tcp.acceleration; the motion ends as failed.
  [[nodiscard]] DriverResult stop(LocalTime now);

  [[nodiscard]] ControllerState observe(LocalTime now) const;

  /// The joints of `observe` [rad] alone, for those who ask every millisecond.
  [[nodiscard]] model::Joints joints(LocalTime now) const;

  /// What is in its hand, `ControllerState::holds` alone. A change takes no time: at the begin or at the end of a motion that arrives.
  [[nodiscard]] std::vector<model::ToolName> holds(LocalTime now) const;

  /// First change of phase after `now`: begin, end or fault of the motion. Empty when none will come by itself.
  [[nodiscard]] std::optional<LocalTime> next_event(LocalTime now) const;

  /// Faults for tests. Each of the two first holds for one motion; several queue up.
  void refuse_next(std::string why);
  /// The next motion stops dead after `fraction` (0 … 1) of its path time; the controller is not ready until `clear_fault`.
  void fail_next(double fraction, std::string why);
  /// Postures read from now on repeat the present one, with fresh stamps; phases go on.
  void freeze_posture(LocalTime now);
  void unfreeze_posture() { frozen_.reset(); }
  /// Not ready from now on, with this reason; a running motion is not affected.
  void raise_fault(std::string why) { fault_ = std::move(why); }
  /// Ready again at or after `now`.
  void clear_fault(LocalTime now);

 private:
  /// The last motion and when it does what. Path time is the time of `motion`, before the speed error.
  struct Run {
    model::Motion motion;
    MotionNumber number;
    double stretch;  // real time per path time
    LocalTime begin;
    LocalTime end;
    double end_path_time;                             // [s] reached at `end`
    std::string failure;                              // not empty: does not arrive
    bool fault = false;                               // not ready after the end
    bool cancelled = false;                           // stopped before it began
    std::optional<LocalTime> braking = std::nullopt;  // from here on at falling speed until `end`
    std::vector<model::ToolName> held = {};           // before the motion
    std::optional<model::ToolChange> change = std::nullopt;
  };
  [[nodiscard]] double path_time(const Run& run, LocalTime now) const;
  [[nodiscard]] model::Duration braking_time() const;
  [[nodiscard]] double uniform(double low, double high);

  struct Script {
    std::optional<double> fail_at;  // empty: refuse
    std::string why;
  };

  const model::Robot* robot_;
  SimOptions options_;
  std::mt19937_64 random_;
  model::Joints standing_;  // where it stood before the first motion
  std::optional<Run> run_;
  std::string fault_;
  std::deque<Script> script_;
  std::optional<model::Joints> frozen_;
};

}  // namespace interlace::proxy
