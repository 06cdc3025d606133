#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app_client/ids.hpp"
#include "app_client/ledger.hpp"
#include "common/dds/participant.hpp"
#include "common/dds/reader.hpp"
#include "common/dds/wait.hpp"
#include "common/dds/writer.hpp"
#include "common/model/result.hpp"

namespace interlace::client {

struct ClientOptions {
  std::string cell;
  std::uint32_t domain = 0;
  std::string name = "client";  ///< who asks, for the planner's log; a valid name
  Patience patience;
};

/// Why a command was not taken.
enum class SubmitError {
  unknown_robot,  ///< the cell has no such robot, or connect() has not succeeded yet
  bad_id,         ///< no valid name (model::is_valid_name)
  id_in_use       ///< this client has used the id before
};
[[nodiscard]] const char* to_string(SubmitError e);

/// The application's end of a cell: submits commands, follows what becomes of them, and repairs lost messages (see Ledger).
/// No threads inside: everything happens in spin_until() and what calls it (connect, hear_planner, wait_for), in the thread that made the
/// client. All functions belong to that thread, but for wake().
class Client {
 public:
  /// Joins the domain. Throws std::invalid_argument for a cell, name or domain that cannot be, std::runtime_error when DDS cannot start.
  explicit Client(ClientOptions options);
  ~Client();
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;

  /// Waits for the planner's state. False when none came before `deadline` or `give_up()` became true; that is asked after wake().
  [[nodiscard]] bool hear_planner(LocalTime deadline, const std::function<bool()>& give_up = nullptr);
  /// Waits for the planner's state and for the way to and from every robot's queue to be open. False as above.
  [[nodiscard]] bool connect(LocalTime deadline, const std::function<bool()>& give_up = nullptr);

  /// The planner's newest state; empty until one was heard. What it says of robots, strategy and incarnation is at most seconds old
  /// while planner_alive().
  [[nodiscard]] const std::optional<model::PlannerState>& planner() const { return planner_; }
  /// A planner was heard within its lease.
  [[nodiscard]] bool planner_alive() const;
  /// True after another planner has taken over: everything that was not final is lost, see Ledger.
  [[nodiscard]] bool planner_replaced() const { return replaced_; }

  /// Submits under an id of its own making. `deadline`: to be completed within this after the planner took it [s].
  [[nodiscard]] model::Result<model::CommandId, SubmitError> submit(const model::RobotName& robot, const model::MotionRequest& motion,
                                                                    int priority = 0, std::optional<double> deadline = std::nullopt);
  /// Submits under the id in `command`; the planner answers an id it knows without executing it again.
  [[nodiscard]] model::Result<model::CommandId, SubmitError> submit(const model::CommandSubmitted& command);
  /// Gives up a command that has not started.
  [[nodiscard]] model::Result<model::CommandId, SubmitError> cancel(const model::RobotName& robot, const model::CommandId& id);
  /// Gives up all commands of the robot that have not started; the id is the request's own, and completed once it is done.
  [[nodiscard]] model::Result<model::CommandId, SubmitError> stop(const model::RobotName& robot);

  /// The robot ends what it has begun and starts nothing more, not even an escape, until it is resumed; the ids are the requests' own, and
  /// completed once that is so.
  [[nodiscard]] model::Result<model::CommandId, SubmitError> hold(const model::RobotName& robot);
  [[nodiscard]] model::Result<model::CommandId, SubmitError> resume(const model::RobotName& robot);
  /// `commands`, whose ids are new, instead of all that waits for the robot: all of them or, when one is impossible, none, and the queue
  /// stays as it was. The id is the request's own: completed when they were taken, else rejected. At most dds::kMaxReplacement.
  [[nodiscard]] model::Result<model::CommandId, SubmitError> replace(const model::RobotName& robot,
                                                                     const std::vector<model::CommandSubmitted>& commands);

  /// Called from spin_until for everything new about any command of the cell, also those of other clients and escapes (Answer::own).
  /// Must not call functions that spin.
  void on_answer(std::function<void(const Answer&)> callback) { on_answer_ = std::move(callback); }

  /// Subscribes to a robot's postures, 100 a second, for `on_posture`. Needs no planner. May be called again; then does nothing.
  void follow(const model::RobotName& robot);
  /// Called from spin_until for every posture of a followed robot with the time it was received.
  void on_posture(std::function<void(const dds::PostureMessage&, LocalTime)> callback) { on_posture_ = std::move(callback); }

  /// What is known of `id`, null when it was not asked for here.
  [[nodiscard]] const Answer* find(const model::CommandId& id) const { return ledger_.find(id); }
  /// Commands submitted here and not final.
  [[nodiscard]] std::size_t open() const { return ledger_.open(); }
  [[nodiscard]] std::size_t open(const model::RobotName& robot) const { return ledger_.open(robot); }

  /// Receives, sends and calls back until `done()` or `deadline`; returns whether it was done. `done` is asked after everything that
  /// happens and after wake().
  bool spin_until(LocalTime deadline, const std::function<bool()>& done);

  /// Waits until the command is final; returns what is known of it then, which may not be final when `deadline` came first.
  [[nodiscard]] std::optional<Answer> wait_for(const model::CommandId& id, LocalTime deadline);

  /// Makes a running spin_until ask its `done` again. From any thread, not from a signal handler.
  void wake() { wait_.wake(); }

 private:
  struct Link;
  void listen();
  void step(LocalTime now);
  void take_state(model::PlannerState&& state, LocalTime now);
  void add_links();
  void send_due(LocalTime now);
  void call_back();
  [[nodiscard]] bool links_open() const;

  ClientOptions options_;
  Ledger ledger_;
  dds::Participant participant_;
  std::optional<dds::Reader<model::PlannerState>> states_;  // none in an observer of postures
  std::map<model::RobotName, std::unique_ptr<Link>> links_;
  std::map<model::RobotName, std::unique_ptr<dds::Reader<dds::PostureMessage>>> postures_;
  std::optional<model::PlannerState> planner_;
  bool replaced_ = false;
  LocalTime now_{};            // of the last step
  LocalTime planner_heard_{};  // when the last state came
  bool connecting_ = false;    // an observer asks for no links
  std::function<void(const Answer&)> on_answer_;
  std::function<void(const dds::PostureMessage&, LocalTime)> on_posture_;
  dds::Wait wait_;  // last: goes before the readers it waits for
};

}  // namespace interlace::client
