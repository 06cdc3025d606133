#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <vector>

#include "common/model/cell.hpp"
#include "common/model/messages.hpp"
#include "planner/core/escape.hpp"
#include "planner/core/neighbourhood.hpp"
#include "planner/core/outlook.hpp"
#include "planner/core/robot_record.hpp"
#include "planner/core/untangle.hpp"
#include "planner/core/wait_graph.hpp"

namespace interlace::core {

/// What a planner is told once. Defaults are those of virtual time, where messages take none.
struct PlannerOptions {
  std::string strategy = "event";
  bool escapes = true;                      ///< robots in the way may be sent out of it; else their neighbours wait for people
  Duration lead{};                          ///< shortest time from a decision to a start
  Duration start_tolerance{};               ///< window given to a proxy beyond its controller's own latency and jitter
  Duration confirm{};                       ///< from a start until the planner has surely heard of it
  std::optional<Duration> posture_timeout;  ///< a robot silent for longer is lost; empty: never
  Duration answer_timeout = std::chrono::milliseconds{100};  ///< a dispatch unanswered for longer is sent again
  Duration patience = std::chrono::seconds{120};             ///< a command whose turn came longer ago goes before every priority
  std::size_t queue_limit = 1000;                            ///< waiting commands per robot
  std::string escape_prefix = "escape-";                     ///< of the ids of escapes; must differ between planners that proxies remember
  std::size_t remembered = 10000;                            ///< finished commands that are still answered by id
  std::function<double()> stopwatch;                         ///< elapsed [s], for statistics only
};

/// What to do and to say, in order.
struct Decisions {
  std::vector<model::Dispatch> dispatches;
  std::vector<model::Withdrawal> withdrawals;
  std::vector<model::CommandStatus> statuses;

  [[nodiscard]] bool empty() const { return dispatches.empty() && withdrawals.empty() && statuses.empty(); }
};

/// The one planner of a cell: queues, start windows, commitments. Pure: no clock, thread, file, log or socket. Events go in with the
/// time they happened, decisions come out as values. `now` never goes backwards. Not thread-safe. A copy goes its own way from there, but
/// in the same thread: copies share what has been computed of motions.
/// Promise: a dispatch is sent only for a start that is clear of every motion in progress or promised, wherever in their windows those
/// start, and also if one that has not been confirmed never starts. Strategy `lookahead` may rely on a departure before it is confirmed,
/// for no longer than the cell's `planning.promise` and only where it is promised (planner_promises.cpp, docs/adr/0006-look-ahead.md).
class Planner {
 public:
  /// Throws std::invalid_argument when the strategy is unknown. `cell` must have been checked (common/app/config).
  Planner(std::shared_ptr<const model::Cell> cell, PlannerOptions options);

  Decisions on(const model::CommandSubmitted& event, Instant now);
  Decisions on(const model::CommandCancelled& event, Instant now);
  Decisions on(const model::StopRequested& event, Instant now);
  Decisions on(const model::HoldRequested& event, Instant now);
  Decisions on(const model::ResumeRequested& event, Instant now);
  Decisions on(const model::QueueReplaced& event, Instant now);
  Decisions on(const model::PostureReported& event, Instant now);
  Decisions on(const model::ExecutionReported& event, Instant now);

  /// Time passes: sends what is due, notices who is silent.
  Decisions advance(Instant now);

  /// When advance() has something to do next, if nothing else happens.
  [[nodiscard]] std::optional<Instant> next_deadline() const;

  /// The whole state, for the heartbeat. `cell`, `fingerprint` and `incarnation` are the caller's to fill.
  [[nodiscard]] model::PlannerState state(Instant now) const;

  /// A client holds it.
  [[nodiscard]] bool is_held(model::RobotIndex robot) const { return robots_[robot].held; }

  /// Between decisions: builds the next map that one of the coming ones will most likely ask for. False when there is none left to build.
  /// Changes how long decisions take and nothing else. One call takes as long as one map.
  bool prepare();

  [[nodiscard]] MapStore& maps() { return maps_; }

 private:
  /// A dispatch or motion that got no answer is given up this long after it must be over: a proxy never starts after its window.
  static constexpr Duration kGrace = std::chrono::milliseconds{500};

  /// Plans a clearing may make before it is given up: one, and others when robots did not do what was planned.
  static constexpr int kPlans = 3;

  // Commands: planner_commands.cpp
  void reject(model::CommandStatus status, model::Reason reason, std::string text, Decisions& out);
  /// A command as it can be carried out.
  struct Admitted {
    SampledMotionPtr motion;
    model::ToolSteps tools;
  };
  using AdmittedQueue = std::vector<Admitted>;
  [[nodiscard]] model::Result<Admitted, model::MotionError> judge(const RobotRecord& r, const model::Joints& from, model::ToolSet held,
                                                                  const model::MotionRequest& request) const;
  [[nodiscard]] model::Result<AdmittedQueue, model::MotionError> chain_from(const RobotRecord& r, model::Joints from) const;
  [[nodiscard]] model::Result<AdmittedQueue, model::MotionError> judge_queue(RobotRecord& r);
  void rejudge_queue(RobotRecord& r, Decisions& out);
  void drop_escapes(RobotRecord& r, Decisions& out);
  bool cancel(RobotRecord& r, const model::CommandId& id, Decisions& out);
  [[nodiscard]] std::string why_not_cancelled(const RobotRecord& r, const model::CommandStatus& status) const;
  void publish(const model::CommandStatus& status, Decisions& out);

  // Control: planner_control.cpp
  [[nodiscard]] RobotRecord* robot_asked(const model::CommandStatus& answer, Decisions& out);
  void hold(RobotRecord& r, Decisions& out);
  void scene_is_new();
  void tell_held(Decisions& out);
  [[nodiscard]] std::string held_in_the_way(const std::vector<model::RobotIndex>& blockers) const;
  [[nodiscard]] std::optional<std::pair<model::Reason, std::string>> why_not_replaced(const RobotRecord& r,
                                                                                      const model::QueueReplaced& event) const;
  void fill_queue(RobotRecord& r, const model::QueueReplaced& event, AdmittedQueue chain, Instant now, Decisions& out);
  [[nodiscard]] std::string first_impossible(const RobotRecord& r) const;

  // Deadlines: planner_deadlines.cpp
  void set_deadline(const RobotRecord& r, QueuedCommand& command, double within, Instant now);
  [[nodiscard]] Duration least_time(const RobotRecord& r, const QueuedCommand& command, Instant now) const;
  void notice_deadlines(Instant now, Decisions& out);

  // Who goes first: planner_precedence.cpp
  [[nodiscard]] bool goes_before(const RobotRecord& a, const RobotRecord& b, Instant now) const;
  [[nodiscard]] bool somebody_goes_before(Instant now) const;
  bool gives_way(RobotRecord& r, Instant now);
  [[nodiscard]] bool can_be_let_through(const RobotRecord& w) const;
  [[nodiscard]] bool kept_out_by(const RobotRecord& w, const Neighbour& moving, Instant now);

  // Robots: planner_robots.cpp
  void stand_at(RobotRecord& r, const model::Joints& q, Instant now, Decisions& out, bool escaped = false);
  void put_following_back(RobotRecord& r, Decisions& out);
  void put_in_queue_again(RobotRecord& r, QueuedCommand command, model::Reason why, const std::string& text, Decisions& out);
  void put_back(RobotRecord& r, model::Reason why, const std::string& text, Decisions& out);
  void begin(RobotRecord& r, const StartInterval& start, Decisions& out);
  [[nodiscard]] static std::optional<model::ExecutionReported> unreported_outcome(const RobotRecord& r, Instant now);
  void revoke_dependents(model::RobotIndex robot, Decisions& out);
  [[nodiscard]] model::RobotIndex index_of(const RobotRecord& r) const { return static_cast<model::RobotIndex>(&r - robots_.data()); }

  // Scheduling: planner.cpp
  void notice_silence(Instant now, Decisions& out);
  void schedule(Instant now, Decisions& out);
  void serve_whoever_can(Instant now, Decisions& out);
  void serve_in_turn(Instant now, Decisions& out);
  bool try_commit_when_all_stand(RobotRecord& r, Instant now, Decisions& out);
  [[nodiscard]] std::vector<RobotRecord*> candidates(Instant now);
  [[nodiscard]] std::vector<Neighbour> neighbours_of(const RobotRecord& r, Instant now) const;
  [[nodiscard]] Candidate candidate_of(const RobotRecord& r, const SampledMotionPtr& motion) const;
  [[nodiscard]] Timing timing_at(Instant now) const { return {now + options_.lead, options_.confirm}; }
  [[nodiscard]] Timing timing_ahead(Instant now) const;
  bool try_commit(RobotRecord& r, Instant now, Decisions& out);
  void commit_next(RobotRecord& r, const Candidate& candidate, Assessment a, Instant could_start, Decisions& out, std::string text = {});
  void send_due(Instant now, Decisions& out);
  enum class Departures { open, met, broken };
  [[nodiscard]] Departures departures_of(const Commitment& c) const;
  [[nodiscard]] Departures departure_of(model::RobotIndex robot, std::uint64_t serial, bool on_promise) const;
  void dispatch(RobotRecord& r, Instant now, Decisions& out);

  // Deadlocks: planner_escapes.cpp
  [[nodiscard]] WaitGraph wait_graph() const;
  bool make_room(Instant now, Decisions& out);
  bool make_room_for(RobotRecord& r, Instant now, Decisions& out);
  void commit_escape(PlannedMotion escape, const model::CommandId& serves, Instant now, Decisions& out);
  [[nodiscard]] static const model::CommandId& served_by(const QueuedCommand& command);
  [[nodiscard]] EscapeView escape_view(const RobotRecord& r, Instant now) const;
  [[nodiscard]] std::vector<EscapeView> escape_views(const RobotRecord& r, Instant now) const;
  void warn(RobotRecord& r);
  [[nodiscard]] bool all_stand() const;
  [[nodiscard]] bool all_stand_around(const RobotRecord& r) const;
  [[nodiscard]] std::uint64_t scene_around(const RobotRecord& r) const;
  [[nodiscard]] bool may_escape() const { return options_.escapes && strategy_->service().escapes; }

  // Preparation: planner_prepare.cpp
  [[nodiscard]] bool prepare_for(const RobotRecord& r);

  // Clearing: planner_clearing.cpp
  bool begin_clearing(RobotRecord& r, Instant now, Decisions& out);
  bool go_on_clearing(Instant now, Decisions& out);
  bool send(const UntangleStep& step, Instant now, Decisions& out);
  void check_clearing();

  // Looking ahead: planner_ahead.cpp
  void serve_ahead(Instant now, Decisions& out);
  void look_ahead(Instant now);
  void search_ahead(Instant now);
  void look_from(Instant now);
  [[nodiscard]] Instant free_at(const RobotRecord& r, Instant now) const;
  [[nodiscard]] OutlookRobot outlook_robot(const RobotRecord& r, Instant now) const;
  bool start_as_planned(const PlannedStart& planned, Instant now, Decisions& out);
  [[nodiscard]] bool somebody_is_about_to_start(Instant now) const;

  // Promises: planner_promises.cpp
  [[nodiscard]] bool promises(const RobotRecord& r, std::uint64_t serial) const;
  [[nodiscard]] const RobotRecord* relying_on(const RobotRecord& r, const Commitment& promised, bool under_way) const;
  [[nodiscard]] bool is_relied_on(const RobotRecord& r, const std::optional<Commitment>& c) const;
  void give_up_broken_promises(Decisions& out);
  void let_others_go_first();
  [[nodiscard]] std::optional<OutlookPlan> rehearse(Instant now);

  std::shared_ptr<const model::Cell> cell_;
  std::shared_ptr<model::Bodies> bodies_;  // copies share it: motions refer to what is in it
  PlannerOptions options_;
  std::shared_ptr<const Strategy> strategy_;  // stateless: copies share it
  Neighbourhood neighbourhood_;
  MapStore maps_;
  bool prepared_ = false;          // nothing was left to prepare since the last event
  std::size_t next_prepared_ = 0;  // the robot for which preparing goes on
  std::vector<RobotRecord> robots_;
  std::unordered_map<model::CommandId, model::CommandStatus> known_;              // newest status of every command still answered by id
  std::deque<model::CommandId> finished_;                                         // final ones, oldest first
  std::set<std::tuple<Instant, model::RobotIndex, model::CommandId>> deadlines_;  // that nobody has passed yet; of finished commands too
  std::uint64_t accepted_ = 0, rejected_ = 0, completed_ = 0;
  /// Says that something changed at `r` that a search for room depends on.
  void changed(RobotRecord& r) { r.changed = ++revision_; }
  std::uint64_t revision_ = 0;
  std::uint64_t last_escape_ = 0;
  /// The space around a command that could not be let through at one stroke is being cleared; only it starts there meanwhile.
  struct Clearing {
    model::RobotIndex robot;
    model::CommandId command;
    std::deque<UntangleStep> steps;  // still to be sent
    int plans = 0;                   // made so far
  };
  std::optional<Clearing> clearing_;
  /// What has been found by looking ahead. Copies share what has been computed, not what was decided.
  struct Ahead {
    std::shared_ptr<Outlook> outlook;   // null: the strategy does not look ahead
    std::optional<OutlookPlan> plan;    // that is followed; empty: whoever can start does
    std::optional<Instant> event_ends;  // when all is done if whoever can start does, as rehearsed
    std::uint64_t seen = 0;             // revision that the plan was made for
    std::uint64_t look = 0;             // of the outlook, for it
    std::optional<Instant> wake;        // when the next planned start is due
    bool fresh = false;                 // nothing is known yet of what is planned for
    std::optional<Instant> searched;    // last
    bool arrived = false;               // commands that nothing has been decided for yet
  };
  Ahead ahead_;
  std::optional<model::RobotIndex> deadlocked_;  // served in turn: for whom all others are held up
  bool escaping_ = false;                        // served in turn: escapes and what they serve are under way
};

}  // namespace interlace::core
