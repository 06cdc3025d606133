#pragma once

#include <cstdint>
#include <string>
#include <variant>

#include "common/model/messages.hpp"

/// What travels on each topic, as plain structs: a message of common/model plus what only the wire needs to know.
namespace interlace::dds {

/// On `command`, client → planner.
struct CommandMessage {
  model::ClientRequest request;
  std::string client;  ///< who asks, for the log; a valid name
};

/// On `command_status`, planner → client.
struct StatusMessage {
  std::uint64_t planner_incarnation = 0;
  model::CommandStatus status;
};

/// The planner lives, and what a proxy needs to place its own clock on the planner's: the last posture heard of it, sent back.
struct Heartbeat {
  model::RobotName robot;
  std::uint64_t proxy_incarnation = 0;  ///< the proxy that is echoed; 0: none heard yet, then the next two mean nothing
  model::Duration proxy_sent{};         ///< PostureMessage::proxy_sent as last received, on that proxy's monotonic clock
  model::Instant planner_received{};    ///< when that posture came
  model::Instant planner_sent{};        ///< when this heartbeat left
  bool held = false;                    ///< a client holds the robot
};

/// On `dispatch`, planner → proxy.
struct DispatchMessage {
  std::uint64_t planner_incarnation = 0;
  std::uint64_t fingerprint = 0;  ///< of the cell description; a proxy with another one obeys nothing
  std::variant<model::Dispatch, model::Withdrawal, Heartbeat> order;
};

/// On `execution`, proxy → planner.
struct ExecutionMessage {
  std::uint64_t planner_incarnation = 0;  ///< of the dispatch this answers; the instants of the report are that planner's
  std::uint64_t proxy_incarnation = 0;
  model::ExecutionReported report;
};

/// On `posture`, proxy → everyone.
struct PostureMessage {
  std::uint64_t fingerprint = 0;          ///< of the proxy's cell description
  std::uint64_t proxy_incarnation = 0;    ///< different each time a proxy starts
  std::uint64_t planner_incarnation = 0;  ///< whose time posture.at is in; 0 while no planner is heard: then posture.at means nothing
  model::Duration proxy_sent{};           ///< the proxy's monotonic clock when this left; comes back in a Heartbeat
  model::PostureReported posture;
  bool held = false;  ///< as the last planner that knew this proxy said: a hold outlives the planner
};

// On `planner_state`, planner → everyone: model::PlannerState. On `planner_journal`, likewise: model::PlannerJournal.

}  // namespace interlace::dds
