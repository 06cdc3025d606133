#pragma once

#include <algorithm>
#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "common/model/motion.hpp"
#include "planner/core/planner.hpp"
#include "tests/support/seed.hpp"

namespace interlace::test {

using namespace std::chrono_literals;
using core::Duration;
using core::Instant;

/// How badly messages travel.
struct Network {
  double loss = 0;
  double repeat = 0;
  Duration longest = 1ms;  ///< each copy takes any time up to this, so they overtake each other
};

/// A motion as it was really carried out.
struct Executed {
  std::string id;
  model::Motion motion;
  Instant start{};
  double stretch = 1;            ///< of its duration: the controller's speed error
  Instant earliest{}, latest{};  ///< of the dispatch that started it

  [[nodiscard]] Instant end() const { return start + model::from_seconds(motion.duration() * stretch); }
};

/// A proxy and its controller with no faults but those of the network: carries a dispatch out once, inside its window or not at all, and
/// answers every repetition with what became of it.
class IdealProxy {
 public:
  explicit IdealProxy(const model::Robot& robot) : robot_(&robot), joints_(robot.start) {}

  [[nodiscard]] const model::Robot& robot() const { return *robot_; }
  [[nodiscard]] const std::vector<Executed>& executed() const { return executed_; }
  [[nodiscard]] bool moving(Instant now) const {
    return !executed_.empty() && executed_.back().start <= now && now < executed_.back().end();
  }
  [[nodiscard]] model::Joints joints(Instant now) const {
    if (!moving(now)) return joints_;
    return executed_.back().motion.joints(model::to_seconds(now - executed_.back().start) / executed_.back().stretch);
  }

  /// Its answer, if it has one yet.
  [[nodiscard]] std::optional<model::ExecutionReported> on(const model::Dispatch& d, Instant now) {
    if (const auto known = last_.find(d.id.str()); known != last_.end()) {
      if (d.attempt < known->second.attempt) return std::nullopt;
      if (started_.count(d.id.str()) > 0 || d.attempt == known->second.attempt) return known->second;
    }
    if (waiting_ && waiting_->id == d.id) waiting_.reset();
    if (waiting_ || moving(now)) return answer(d.id, d.attempt, model::ExecutionState::refused, now, "busy");
    if ((joints_ - d.from).cwiseAbs().maxCoeff() > 1e-9) return answer(d.id, d.attempt, model::ExecutionState::refused, now, "elsewhere");
    if (now > d.latest) return answer(d.id, d.attempt, model::ExecutionState::refused, now, "too late");
    waiting_ = d;
    return answer(d.id, d.attempt, model::ExecutionState::accepted, now);
  }
  [[nodiscard]] std::optional<model::ExecutionReported> on(const model::Withdrawal& w, Instant now) {
    if (const auto known = last_.find(w.id.str()); known != last_.end()) {
      if (w.attempt < known->second.attempt) return std::nullopt;
      if (started_.count(w.id.str()) > 0) return known->second;
    }
    if (waiting_ && waiting_->id == w.id) waiting_.reset();
    return answer(w.id, w.attempt, model::ExecutionState::withdrawn, now);
  }

  /// The dispatch that waits for its window.
  [[nodiscard]] const std::optional<model::Dispatch>& waiting() const { return waiting_; }

  /// Begins the waiting motion.
  [[nodiscard]] model::ExecutionReported start(Instant now, double stretch) {
    const model::Dispatch d = *waiting_;
    waiting_.reset();
    started_.insert(d.id.str());
    executed_.push_back({d.id.str(), model::plan_motion(*robot_, joints_, d.motion).value(), now, stretch, d.earliest, d.latest});
    return *answer(d.id, d.attempt, model::ExecutionState::started, now);
  }
  [[nodiscard]] model::ExecutionReported arrive(Instant now) {
    joints_ = executed_.back().motion.to();
    const model::CommandId id{executed_.back().id};
    return *answer(id, last_.at(id.str()).attempt, model::ExecutionState::completed, now);
  }

 private:
  std::optional<model::ExecutionReported> answer(const model::CommandId& id, std::uint32_t attempt, model::ExecutionState state,
                                                 Instant now, const std::string& text = {}) {
    model::ExecutionReported e;
    e.id = id;
    e.robot = robot_->name;
    e.attempt = attempt;
    e.state = state;
    e.at = now;
    e.joints = joints_;
    e.text = text;
    last_[id.str()] = e;
    return e;
  }

  const model::Robot* robot_;
  model::Joints joints_;  // where it stands, or stood before the running motion
  std::optional<model::Dispatch> waiting_;
  std::vector<Executed> executed_;
  std::map<std::string, model::ExecutionReported> last_;
  std::set<std::string> started_;
};

/// Planner, proxies and a client in virtual time, with a network between them that loses, repeats and reorders until it is mended.
class LossyWorld {
 public:
  LossyWorld(std::shared_ptr<const model::Cell> cell, const core::PlannerOptions& options, const Network& network, Seed& seed)
      : cell_(std::move(cell)), planner_(cell_, options), network_(network), seed_(seed) {
    for (const auto& robot : cell_->robots) proxies_.emplace_back(robot);
    for (std::size_t i = 0; i < proxies_.size(); ++i) say_where(i);
  }

  /// The client says each of these again and again until it is answered, then the next.
  void submit(const std::vector<model::CommandSubmitted>& commands) {
    wanted_.insert(wanted_.end(), commands.begin(), commands.end());
    say_until_answered(commands, 0);
  }
  void cancel(const model::CommandId& id, const model::RobotName& robot, Instant at) {
    at_time(at, [this, id, robot] { send([this, id, robot] { take(planner_.on(model::CommandCancelled{id, robot}, now_)); }); });
  }
  void mend_network_at(Instant at) {
    at_time(at, [this] { network_ = Network{0, 0, 1ms}; });
  }

  /// Until every command is final, or `limit`.
  void run(Instant limit) {
    while (!events_.empty() && now_ < limit && !all_final()) {
      const auto next = events_.begin();
      const auto deadline = planner_.next_deadline();
      if (deadline && *deadline < next->first) {
        now_ = std::max(now_ + Duration{1}, *deadline);
        take(planner_.advance(now_));
        continue;
      }
      now_ = next->first;
      const auto what = std::move(next->second);
      events_.erase(next);
      what();
    }
  }

  [[nodiscard]] bool all_final() const {
    return std::all_of(wanted_.begin(), wanted_.end(), [this](const auto& c) { return finals_.count(c.id.str()) > 0; });
  }
  /// Final states said of each command, without repetitions of the same.
  [[nodiscard]] const std::map<std::string, std::set<model::CommandState>>& finals() const { return finals_; }
  [[nodiscard]] const std::vector<IdealProxy>& proxies() const { return proxies_; }
  [[nodiscard]] const std::vector<model::CommandSubmitted>& wanted() const { return wanted_; }
  [[nodiscard]] Instant now() const { return now_; }
  [[nodiscard]] const core::Planner& planner() const { return planner_; }
  [[nodiscard]] std::size_t sent() const { return sent_; }
  [[nodiscard]] std::size_t lost() const { return lost_; }

 private:
  using Event = std::function<void()>;
  static constexpr Duration kPosturePeriod = 20ms;
  static constexpr Duration kRetry = 50ms;

  void at_time(Instant at, Event what) { events_.emplace(at, std::move(what)); }

  void send(const Event& arrival) {
    const int copies = 1 + (seed_.chance(network_.repeat) ? 1 : 0);
    for (int i = 0; i < copies; ++i) {
      ++sent_;
      if (seed_.chance(network_.loss)) {
        ++lost_;
        continue;
      }
      at_time(now_ + model::from_seconds(seed_.uniform(0, model::to_seconds(network_.longest))), arrival);
    }
  }

  void say_until_answered(const std::vector<model::CommandSubmitted>& commands, std::size_t next) {
    while (next < commands.size() && answered_.count(commands[next].id.str()) > 0) ++next;
    if (next == commands.size()) return;
    send([this, command = commands[next]] { take(planner_.on(command, now_)); });
    at_time(now_ + kRetry, [this, commands, next] { say_until_answered(commands, next); });
  }

  void say_where(std::size_t i) {
    model::PostureReported p;
    p.robot = proxies_[i].robot().name;
    p.at = now_;
    p.joints = proxies_[i].joints(now_);
    p.moving = proxies_[i].moving(now_);
    if (p.moving) p.motion = model::CommandId{proxies_[i].executed().back().id};
    send([this, p] { take(planner_.on(p, now_)); });
    at_time(now_ + kPosturePeriod, [this, i] { say_where(i); });
  }

  void report(const std::optional<model::ExecutionReported>& e) {
    if (e) send([this, e] { take(planner_.on(*e, now_)); });
  }

  void arrived(std::size_t i, const model::Dispatch& d) {
    IdealProxy& proxy = proxies_[i];
    report(proxy.on(d, now_));
    if (!proxy.waiting() || proxy.waiting()->id != d.id || proxy.waiting()->attempt != d.attempt) return;
    // Anywhere in the window that is still ahead.
    const Instant from = std::max(now_, d.earliest);
    const Instant start = from + model::from_seconds(seed_.uniform(0, 1) * model::to_seconds(d.latest - from));
    at_time(start, [this, i, d] { begin(i, d); });
  }

  void begin(std::size_t i, const model::Dispatch& d) {
    IdealProxy& proxy = proxies_[i];
    if (!proxy.waiting() || proxy.waiting()->id != d.id || proxy.waiting()->attempt != d.attempt) return;  // withdrawn, replaced or begun
    const double error = proxy.robot().controller.speed_error;
    report(proxy.start(now_, 1 + seed_.uniform(-error, error)));
    at_time(proxy.executed().back().end(), [this, i] { report(proxies_[i].arrive(now_)); });
  }

  void take(core::Decisions decisions) {
    for (const auto& s : decisions.statuses) {
      if (s.reason == model::Reason::unknown_id) continue;  // a cancellation that overtook its command
      answered_.insert(s.id.str());
      if (is_final(s.state)) finals_[s.id.str()].insert(s.state);
    }
    for (const auto& d : decisions.dispatches) {
      const auto i = cell_->find(d.robot).value();
      send([this, i, d] { arrived(i, d); });
    }
    for (const auto& w : decisions.withdrawals) {
      const auto i = cell_->find(w.robot).value();
      send([this, i, w] { report(proxies_[i].on(w, now_)); });
    }
  }

  std::shared_ptr<const model::Cell> cell_;
  core::Planner planner_;
  Network network_;
  Seed& seed_;
  std::vector<IdealProxy> proxies_;
  std::multimap<Instant, Event> events_;
  std::vector<model::CommandSubmitted> wanted_;
  std::set<std::string> answered_;
  std::map<std::string, std::set<model::CommandState>> finals_;
  Instant now_{};
  std::size_t sent_ = 0, lost_ = 0;
};

}  // namespace interlace::test
