#pragma once

#include <deque>
#include <optional>

#include "planner/core/strategy.hpp"

namespace interlace::core {

/// An admitted command, with the motion it will be from where its robot will then be.
struct QueuedCommand {
  enum class Origin {
    client,
    escape,   ///< out of the way of the command it serves
    way_back  ///< to where the robot was before it escaped, because its next command is possible only from there
  };
  Origin origin = Origin::client;
  model::EscapeWay way = model::EscapeWay::retreat;  ///< of an escape
  model::CommandStatus status;
  model::MotionRequest request;
  int priority = 0;
  SampledMotionPtr motion;
  std::optional<std::pair<model::MotionRequest, SampledMotionPtr>> full_speed;  ///< what it was before it was slowed down
  model::ToolSteps tools;                                                       ///< what its robot holds around it
  std::uint32_t attempts = 0;                                                   ///< plans sent to the proxy so far
};

/// A command whose start is decided: a fact for everyone after.
struct Commitment {
  enum class Phase {
    held,        ///< decided, not yet sent: may still be taken back without anyone knowing
    dispatched,  ///< sent; the proxy starts it in its window or refuses
    started
  };
  QueuedCommand command;
  Phase phase = Phase::held;
  std::uint64_t serial = 0;                                             ///< tells commitments of one robot apart
  Instant start_from{};                                                 ///< planned start, or the earliest it can have been
  Instant start_until{};                                                ///< latest start
  std::vector<std::pair<model::RobotIndex, std::uint64_t>> departures;  ///< commitments that must have started before this is sent,
  bool on_promise = false;                                              ///< or be promised
  bool endangered = false;                                              ///< one of them will not start as promised, and that was said
  bool cancel_requested = false;
  bool accepted = false;    ///< the proxy has confirmed the dispatch
  bool start_told = false;  ///< the proxy has reported the start; a posture alone shows only that it has begun
  Instant sent{};           ///< when the dispatch was last sent
};

/// What a command was last assessed in, in vain: as long as it is the same, so is the answer.
struct AssessedScene {
  SampledMotionPtr motion;  ///< of the command; null: not assessed
  std::vector<Neighbour> neighbours;

  [[nodiscard]] bool operator==(const AssessedScene& other) const { return motion == other.motion && neighbours == other.neighbours; }
};

/// Everything the planner knows of one robot.
struct RobotRecord {
  const model::Robot* robot = nullptr;
  model::RobotMode mode = model::RobotMode::unknown;
  bool heard = false;    ///< a posture came and is not older than the time-out
  bool ready = true;     ///< its controller would accept a command
  bool foreign = false;  ///< moves although nobody here told it to
  bool held = false;     ///< a client holds it: it starts nothing, not even an escape
  Instant last_heard{};
  Instant known_at = model::kEarliest;           ///< newest instant that any report tells of; an older posture says nothing any more
  std::optional<model::PostureReported> stood;   ///< newest posture that saw it standing
  SampledMotionPtr standing;                     ///< where it stands, or stood when its motion began
  model::ToolSet tools;                          ///< all it may hold there
  ReachableVolume reach;                         ///< where it can be, whatever it holds
  std::deque<QueuedCommand> queue;               ///< main queue: admitted, in order
  std::deque<QueuedCommand> escapes;             ///< escape queue: goes before the main queue
  std::vector<model::MotionRequest> way_back;    ///< undoes the escapes since the robot's last own command, the newest last
  std::deque<model::MotionRequest> trail;        ///< undoes its last motions, the newest first
  std::vector<model::RobotIndex> blockers;       ///< that leave its next command no start, as last assessed
  AssessedScene in_vain;                         ///< of that assessment
  std::vector<model::RobotIndex> blockers_told;  ///< of whom people were told when they were asked for help
  std::uint64_t changed = 1;                     ///< when something last changed here that a search for room depends on
  std::uint64_t room_sought = 0;                 ///< scene around it for which room for its next command was sought in vain
  std::uint64_t clearing_given_up = 0;           ///< likewise, clearing all space around it
  std::vector<model::EscapeRefusal> refused;     ///< what the last search for room tried in vain
  std::optional<Commitment> committed;           ///< what it does now or next
  std::optional<Commitment> following;           ///< what it does after that: decided together with an escape of its own, or promised
  std::uint64_t last_serial = 0;
  std::uint64_t last_started = 0;  ///< serial of the newest commitment that began
  Instant ready_since{};           ///< since when the head of the queue could have gone
  bool gives_way = false;          ///< its next command could go, but one that goes before it could not go then

  /// Of the command whose turn it is, or that a way back leads to.
  [[nodiscard]] int priority() const { return queue.empty() ? 0 : queue.front().priority; }

  /// Neither heard from nor explained by what we told it: it may be anywhere in its reach.
  [[nodiscard]] bool lost() const { return !heard || foreign; }

  /// The command whose turn it is, if any.
  [[nodiscard]] QueuedCommand* next() { return !escapes.empty() ? &escapes.front() : !queue.empty() ? &queue.front() : nullptr; }
  [[nodiscard]] const QueuedCommand* next() const { return const_cast<RobotRecord*>(this)->next(); }

  /// Posture the robot will have when both queues are done [rad].
  [[nodiscard]] const model::Joints& joints_at_end() const;

  /// Posture the robot will have when what it is doing is done [rad].
  [[nodiscard]] const model::Joints& joints_after_motion() const;

  /// What the robot will hold then.
  [[nodiscard]] model::ToolSet tools_at_end() const;
  [[nodiscard]] model::ToolSet tools_after_motion() const;

  /// As its neighbours have to see it at `now`: one entry, or two when something follows what it is committed to. Each stands before and
  /// after its motion, which is more than true of the two together, and safe.
  void add_as_neighbour(model::RobotIndex index, Instant now, std::vector<Neighbour>& out) const;

  /// Serial of the last thing it is committed to; it is committed.
  [[nodiscard]] std::uint64_t last_committed() const { return following ? following->serial : committed->serial; }
};

}  // namespace interlace::core
