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

#include "planner/core/planner.hpp"
#include "tests/support/ideal_proxy.hpp"
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

/// Planner, proxies and a client in virtual time, with a network between them that loses, repeats and reorders until it is mended.
class LossyWorld {
 public:
  using Event = std::function<void()>;

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
  /// A client asks again and again until the planner has heard it, then goes on with `then`.
  void ask(const model::ClientRequest& request, Instant at, Event then = nullptr) {
    at_time(at, [this, request, then = std::move(then)] { ask_until_answered(request, then); });
  }
  /// When the planner first answered under `id`; kForever: it never did.
  [[nodiscard]] Instant answered_at(const std::string& id) const {
    const auto found = answered_at_.find(id);
    return found == answered_at_.end() ? model::kForever : found->second;
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

  void ask_until_answered(const model::ClientRequest& request, const Event& then) {
    const auto id = std::visit([](const auto& r) { return r.id.str(); }, request);
    if (answered_.count(id) > 0) {
      if (then) then();
      return;
    }
    send([this, request] { std::visit([this](const auto& r) { take(planner_.on(r, now_)); }, request); });
    at_time(now_ + kRetry, [this, request, then] { ask_until_answered(request, then); });
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
      answered_at_.emplace(s.id.str(), now_);
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
  std::map<std::string, Instant> answered_at_;
  std::map<std::string, std::set<model::CommandState>> finals_;
  Instant now_{};
  std::size_t sent_ = 0, lost_ = 0;
};

}  // namespace interlace::test
