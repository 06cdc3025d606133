#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/model/ids.hpp"
#include "common/model/pose.hpp"
#include "robot_proxy/local_time.hpp"

namespace interlace::proxy {

/// What a controller can do; fixed while it is connected.
struct Capabilities {
  bool can_stop = false;              ///< a running motion can be brought to rest before its end
  bool linear_moves = true;           ///< takes a TCP pose as target
  bool joint_moves = true;            ///< takes joints as target
  model::Duration earliest_start{0};  ///< from the command to the first movement: bounds, latest ≥ earliest ≥ 0
  model::Duration latest_start{0};
  double posture_rate = 100;  ///< postures per second that `observe` can tell apart [1/s]
};

/// Names a motion between proxy and controller; grows by one with each, so that news about an old one is told from news about a new one.
using MotionNumber = std::uint64_t;

enum class MotionPhase : std::uint8_t {
  none,       ///< nothing was commanded since the controller was connected
  commanded,  ///< taken, not moving yet
  moving,
  finished,  ///< ended where the controller says the target is
  refused,   ///< will not be carried out and nothing moved
  failed     ///< ended somewhere else; where, is where the robot stands now
};

/// How far the controller is with the last motion it was given.
struct MotionProgress {
  MotionNumber number = 0;  ///< 0: none yet
  MotionPhase phase = MotionPhase::none;
  std::optional<LocalTime> began;  ///< first movement, where the controller knows it; else the proxy infers it from `moving`
  std::optional<LocalTime> ended;  ///< ditto, end of the movement
  std::string text;                ///< why, when refused or failed
};

/// One consistent look at a controller.
struct ControllerState {
  LocalTime at{};                                ///< when posture and phase were true
  model::Joints joints = model::Joints::Zero();  ///< [rad]
  model::Pose X_WT = model::Pose::Identity();    ///< the TCP in the world frame
  bool moving = false;
  bool ready = false;  ///< would take a motion if it were standing: on, in automatic, no fault
  std::string fault;   ///< why not ready, for people; empty when ready
  MotionProgress motion;
  std::vector<model::ToolName> holds;  ///< all that may be in the robot's hand; a controller that cannot tell lists what could be
};

}  // namespace interlace::proxy
