#pragma once

#include <chrono>
#include <string>

#include "common/dds/envelope.hpp"
#include "common/model/ids.hpp"
#include "common/model/journal.hpp"

namespace interlace::dds {

/// The address of one stream of `Message`: its name on the wire and whom its messages must be about.
template <typename Message>
struct Topic {
  std::string name;   ///< `<cell>/<robot>/<kind>` or `<cell>/<kind>`
  std::string owner;  ///< robot (or cell, for planner_state) every message must carry; others are refused
};

/// How often the periodic topics are written. Deadlines and leases (qos.cpp) are multiples of these.
inline constexpr std::chrono::milliseconds kPosturePeriod{10};
inline constexpr std::chrono::milliseconds kHeartbeatPeriod{100};
inline constexpr std::chrono::milliseconds kPlannerStatePeriod{1000};

/// All topics of a cell. Throw std::invalid_argument when the cell or the robot is not a valid name (model::is_valid_name).
namespace topics {
[[nodiscard]] Topic<CommandMessage> command(const std::string& cell, const model::RobotName& robot);
[[nodiscard]] Topic<StatusMessage> command_status(const std::string& cell, const model::RobotName& robot);
[[nodiscard]] Topic<DispatchMessage> dispatch(const std::string& cell, const model::RobotName& robot);
[[nodiscard]] Topic<ExecutionMessage> execution(const std::string& cell, const model::RobotName& robot);
[[nodiscard]] Topic<PostureMessage> posture(const std::string& cell, const model::RobotName& robot);
[[nodiscard]] Topic<model::PlannerState> planner_state(const std::string& cell);
[[nodiscard]] Topic<model::PlannerJournal> planner_journal(const std::string& cell);
}  // namespace topics

}  // namespace interlace::dds
