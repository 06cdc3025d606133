#pragma once

#include <deque>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "planner/core/planner.hpp"
#include "tests/model/judge.hpp"
#include "tests/model/motions_seen.hpp"
#include "tests/model/scenario.hpp"
#include "tests/support/ideal_proxy.hpp"

namespace interlace::test {

/// Something that may happen next.
struct Choice {
  enum class Kind {
    submit,   ///< the robot's next order
    cancel,   ///< the order that may be given up
    deliver,  ///< the robot's oldest report to the planner
    start,    ///< the robot begins what it was sent
    refuse,   ///< the robot gives up what it was sent
    silence,  ///< the planner no longer hears the robot
    back,     ///< it hears the robot again
    advance,  ///< the planner's deadline
    wait      ///< nothing at this instant any more
  };
  Kind kind = Kind::wait;
  model::RobotIndex robot = 0;
};

/// One state of a scenario: planner, proxies, what is on its way between them and what the client has left to ask. Events happen at the
/// instants at which something begins, is half done, ends or falls due, in any order; time passes when nothing must happen any more at an
/// instant. What the planner says arrives at once, what robots say within the planner's `confirm` and, of one robot, in order. Copies are
/// independent.
class World {
 public:
  World(const Scenario& scenario, MotionsSeen& motions, Judge& judge);

  /// What may happen next, in a fixed order. Empty: all is over.
  [[nodiscard]] std::vector<Choice> choices() const;
  void happen(const Choice& choice);

  /// What has gone wrong, in one sentence; empty so far.
  [[nodiscard]] const std::string& fault() const { return fault_; }

  /// Everything that what follows depends on, times as distances from now. Of the planner it holds what it has said and been told, not its
  /// members: states that differ in some hidden way are taken for one, which can hide a fault but never invent one.
  [[nodiscard]] std::string signature() const;

  [[nodiscard]] std::string tell(const Choice& choice) const;

  /// Of a command, what the planner has said.
  struct Said {
    model::CommandStatus newest;
    std::size_t finals = 0;  ///< final states told
    bool delayed = false;
    bool blocked = false;
  };
  [[nodiscard]] const std::map<std::string, Said>& said() const { return said_; }
  [[nodiscard]] double least_clearance() const { return least_; }
  [[nodiscard]] bool silent() const { return silence_ == Silence::now; }

 private:
  enum class Silence { not_yet, now, over };
  static constexpr model::Duration kLongestSilence = std::chrono::milliseconds{1500};  // longer than any of the motions
  struct Report {
    model::ExecutionReported report;
    model::Instant due{};  // it arrives until then
  };
  struct Robot {
    IdealProxy proxy;
    std::size_t motion;            // carried out last, or being carried out
    std::vector<std::size_t> way;  // all of them
    std::optional<std::size_t> sent;
    std::deque<Report> reports;
    std::size_t submitted = 0;
    model::Instant ready{};  // since when it could have gone, as the planner has it
    model::Instant heard{};
  };

  [[nodiscard]] bool heard(model::RobotIndex i) const { return !silent() || scenario_->liberties.silent != i; }
  [[nodiscard]] bool all_rest() const;
  [[nodiscard]] bool has_work(const Robot& r) const;
  [[nodiscard]] bool all_final() const;
  [[nodiscard]] bool all_submitted() const;
  [[nodiscard]] bool urgent(model::RobotIndex i) const;
  [[nodiscard]] std::optional<model::Instant> next_instant() const;
  [[nodiscard]] const Order* next_order(model::RobotIndex i) const;
  [[nodiscard]] const Order* order(const std::string& id) const;
  [[nodiscard]] UnderWay under_way(const Robot& r) const;
  void pass_until(model::Instant t);
  void say_where(model::RobotIndex i);
  void report(model::RobotIndex i, const std::optional<model::ExecutionReported>& e);
  void take(const core::Decisions& decisions);
  void judge_rest();
  void blame(std::string text);

  const Scenario* scenario_;
  MotionsSeen* motions_;
  Judge* judge_;
  core::Planner planner_;
  std::vector<Robot> robots_;
  std::map<std::string, Said> said_;
  std::vector<std::string> escapes_;  // in the order of their making
  model::Instant now_{};
  bool cancelled_ = false;
  bool refused_ = false;
  Silence silence_ = Silence::not_yet;
  model::Instant silent_until_{};
  double least_ = std::numeric_limits<double>::infinity();
  std::string fault_;
};

}  // namespace interlace::test
