#pragma once

#include <functional>
#include <string>

#include "common/model/messages.hpp"
#include "common/model/result.hpp"
#include "robot_proxy/controller_state.hpp"

namespace interlace::proxy {

/// Nothing, or one sentence for people with the value and the rule.
using DriverResult = model::Result<void, std::string>;

/// One robot controller, seen as a black box that moves from point to point. Write one of these for each make.
///
/// Life: construct (no I/O) → connect → observe, execute, stop in any order → disconnect → destroy. `connect` may be called again after
/// `disconnect`.
///
/// Threads: the proxy calls everything from one thread. `Changed` may be called from any thread of the driver, never while it holds a
/// lock that `observe`, `execute` or `stop` takes, and never from inside one of those calls.
///
/// Errors: no call throws. What the controller refuses comes back as text; what goes wrong later (a lost connection, an emergency stop)
/// shows in `observe` as ready = false with a fault text, and as phase `failed` of the motion it ended.
class Driver {
 public:
  /// "Something changed: call observe". May be called for nothing; calls may be merged.
  using Changed = std::function<void()>;

  Driver() = default;
  Driver(const Driver&) = delete;
  Driver& operator=(const Driver&) = delete;
  virtual ~Driver() = default;

  /// Reaches the controller within `timeout` or says why not. From here on `changed` is called at least when a motion begins, ends or
  /// fails and when `ready` changes.
  [[nodiscard]] virtual DriverResult connect(Changed changed, model::Duration timeout) = 0;

  /// After it returns `changed` is never called again and no thread of the driver runs. Does not stop a running motion. Harmless when
  /// not connected.
  virtual void disconnect() = 0;

  /// Valid after `connect`.
  [[nodiscard]] virtual Capabilities capabilities() const = 0;

  /// The latest the driver knows, at once: no round trip to the controller. `at` is the time the posture was true, as well as the driver
  /// can tell, and never decreases.
  [[nodiscard]] virtual ControllerState observe() = 0;

  /// Commands one PTP motion from where the robot stands and returns as soon as the controller took it. `number` comes back in
  /// `ControllerState::motion`; from the return on, `observe` speaks of this number. An error means that nothing will move.
  /// The controller begins within [earliest_start, latest_start] of the call. It says `finished` once it stands.
  /// A change of tools in the request is the controller's to make: one on start is over before the first movement, one on completion
  /// before it says `finished`. `observe` shows in `holds` what was held and what will be until it is surely over.
  [[nodiscard]] virtual DriverResult execute(const model::MotionRequest& request, MotionNumber number) = 0;

  /// Brings a running motion to rest along its path as fast as the controller sees fit; the motion ends as `failed`. Standing already is
  /// no error. A controller that cannot says so here and in its capabilities.
  [[nodiscard]] virtual DriverResult stop() = 0;
};

}  // namespace interlace::proxy
