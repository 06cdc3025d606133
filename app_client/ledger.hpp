#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <variant>
#include <vector>

#include "common/model/messages.hpp"

namespace interlace::client {

/// Local monotonic time; only ever handed in.
using LocalTime = std::chrono::steady_clock::time_point;
using LocalDuration = std::chrono::steady_clock::duration;

using Request = model::ClientRequest;

/// How long a client waits for what.
struct Patience {
  LocalDuration resend = std::chrono::milliseconds{500};         ///< a request without an answer is sent again after this
  LocalDuration give_up = std::chrono::seconds{10};              ///< and is lost after this, counted from the first time it was sent
  LocalDuration silence = std::chrono::seconds{5};               ///< a command not heard of for this long is asked about
  LocalDuration sign_of_life = std::chrono::milliseconds{2500};  ///< nothing is sent again to a planner silent for longer
};

/// What is known of one command or request.
struct Answer {
  model::CommandStatus status;
  bool own = true;    ///< asked for by this client; else another client's, or an escape
  bool told = false;  ///< the planner said so; else it is the client's own view: not sent yet, not answered yet, or lost
};

/// The bookkeeping of a client: what was asked, what was answered, what to send (again) now. Pure: time is handed in.
/// Order: one unanswered command per robot at a time, so commands of one robot reach the planner in the order they were submitted even
/// when messages are lost. A request is only ever sent to the planner it was first sent to: when another incarnation takes over, everything
/// not final is lost and says so, and nothing is submitted again behind the application's back. Not thread-safe.
class Ledger {
 public:
  explicit Ledger(Patience patience = {}) : patience_(patience) {}

  /// Takes `command` over for sending. False when its id is already known; then nothing changes.
  bool submit(const model::CommandSubmitted& command);

  /// Gives up a command, of this client or of another. One that was not sent yet is cancelled on the spot.
  void cancel(const model::RobotName& robot, const model::CommandId& id);

  /// Gives up everything of the robot that has not started, of all clients. False when the id is already known.
  bool stop(const model::StopRequested& request);

  /// Its robot starts nothing more, or again. False when the id is already known.
  bool hold(const model::HoldRequested& request);
  bool resume(const model::ResumeRequested& request);

  /// Other commands instead of all that waits for the robot, here and with the planner. It is sent once the command on its way is
  /// answered, and nothing after it before it is answered itself. False when any of its ids is already known; then nothing changes.
  bool replace(const model::QueueReplaced& request);

  /// `text` says why the request of that id cannot be sent at all: it is rejected locally.
  void refuse(const model::CommandId& id, const std::string& text);

  /// A sign of life of a planner. False when it is one that was replaced before: whatever came with it is old news.
  bool on_planner(std::uint64_t incarnation, LocalTime now);

  void on_status(std::uint64_t incarnation, const model::CommandStatus& status, LocalTime now);

  /// What to send now, in this order; counts as sent. Call before next_due().
  [[nodiscard]] std::vector<Request> due(LocalTime now);

  /// When due() has something to do next, if nothing is heard before; empty: never.
  [[nodiscard]] std::optional<LocalTime> next_due() const;

  /// Everything that has changed since the last call, oldest first.
  [[nodiscard]] std::vector<Answer> take_news();

  /// What is known of `id`; null when nothing was asked about it here. Valid until the next call of a function that is not const.
  [[nodiscard]] const Answer* find(const model::CommandId& id) const;

  /// Commands submitted here and not final, for one robot or for all.
  [[nodiscard]] std::size_t open(const model::RobotName& robot) const;
  [[nodiscard]] std::size_t open() const;

 private:
  struct Sending {
    LocalTime first{}, last{};
  };
  struct Entry {
    Request request;
    Answer answer;
    std::optional<Sending> sent;
    LocalTime heard{};
  };
  /// Commands of one robot that are not final, in the order they were submitted.
  struct Line {
    std::deque<model::CommandId> told;      // the planner has them
    std::optional<model::CommandId> asked;  // sent, not answered
    std::deque<model::CommandId> unsent;
    [[nodiscard]] std::size_t size() const { return told.size() + (asked ? 1 : 0) + unsent.size(); }
  };
  /// A stop or cancellation on its way; a cancellation shares the id of its command.
  struct Order {
    Request request;
    std::uint64_t turn = 0;  // orders go out in the order they were given
    std::optional<Sending> sent;
  };

  [[nodiscard]] bool planner_lives(LocalTime now) const { return planner_ && now - planner_heard_ <= patience_.sign_of_life; }
  [[nodiscard]] bool resend(Sending& sent, LocalTime now, bool lives) const;
  Entry& enter(const Request& request, const model::CommandId& id, const model::RobotName& robot);
  void close(const model::CommandId& id, model::CommandState state, model::Reason reason, std::string text);
  bool give(const Request& request, const model::CommandId& id, const model::RobotName& robot);
  void close_unsent(const model::RobotName& robot, model::Reason reason, const std::string& text);
  void settle_replacement(const model::QueueReplaced& request, const model::CommandStatus& status, LocalTime now);
  void mark_sent(const Request& request, LocalTime now);
  [[nodiscard]] const Order* replacement_of(const model::RobotName& robot) const;
  [[nodiscard]] bool held_back(const Order& order) const;
  void remove_from_line(const model::RobotName& robot, const model::CommandId& id);
  void give_up_orders(LocalTime now);
  void give_up_unanswered(Line& line, LocalTime now);
  void lose_everything();

  Patience patience_;
  std::uint64_t planner_ = 0;
  LocalTime planner_heard_{};
  std::set<std::uint64_t> replaced_;
  std::unordered_map<model::CommandId, Entry> entries_;
  std::map<model::RobotName, Line> lines_;
  std::map<model::CommandId, Order> orders_;
  std::uint64_t last_turn_ = 0;
  LocalTime looked_{};  // when due() last ran
  std::vector<Answer> news_;
};

}  // namespace interlace::client
