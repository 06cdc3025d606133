#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>
#include <variant>

#include "robot_proxy/drivers/sim/sim_controller.hpp"
#include "robot_proxy/executor.hpp"
#include "tests/unit/proxy/support.hpp"

namespace interlace::proxy {
namespace {

using model::CommandId;
using model::Dispatch;
using model::Duration;
using model::ExecutionState;
using model::Instant;
using model::Withdrawal;
using test::arm;
using test::line_to;

/// A planner that dispatches, redispatches and withdraws as it likes, over a network that drops, repeats and reorders, to an executor
/// with a wrong clock and a controller with latency, jitter, refusals and faults. All in virtual time.
class Storm {
 public:
  explicit Storm(std::uint64_t seed) : random_(seed), controller_(robot_, {Duration{0}, true, seed}) {
    carry_out(executor_.on_planner(incarnation_, moment()));
  }

  void run(int events) {
    while (events_ < events) step();
  }

  int started() const { return started_; }
  int completed() const { return counts_.count(ExecutionState::completed) ? counts_.at(ExecutionState::completed) : 0; }
  std::map<ExecutionState, int> counts_;

 private:
  /// A proxy passes on what the planner it hears has sent, and nothing of a former one.
  struct Message {
    std::uint64_t incarnation;
    std::variant<Dispatch, Withdrawal> content;
  };

  static model::Robot shaky_arm() {
    model::Robot robot = arm();
    robot.tcp.velocity = 1;
    robot.tcp.acceleration = 5;
    robot.controller = {0.02, 0.01, 0.05};
    return robot;
  }
  double unit() { return static_cast<double>(random_() >> 11) * 0x1p-53; }
  bool chance(double p) { return unit() < p; }
  Duration up_to(double seconds) { return model::from_seconds(unit() * seconds); }
  Instant truth(LocalTime t) const { return Instant{t.time_since_epoch()} + kOffset; }

  /// An honest estimate: wrong by at most what it says.
  Moment moment() {
    if (chance(0.002)) return {now_, std::nullopt};
    const Duration uncertainty = up_to(0.004);
    return {now_, ClockEstimate{kOffset + model::from_seconds((2 * unit() - 1) * model::to_seconds(uncertainty)), uncertainty}};
  }

  /// Planner and world do something, then time moves to the next event of anyone.
  void step() {
    ++events_;
    // More eager while the robot stands, so that most events are part of a motion's life.
    if (chance(executor_.running() != nullptr ? 0.1 : 0.6)) plan();
    if (chance(0.03)) withdraw();
    if (chance(0.2)) controller_.clear_fault(now_);
    if (chance(0.003)) replace_planner();

    LocalTime next = now_ + up_to(0.2);
    if (!network_.empty()) next = std::min(next, std::max(now_, network_.begin()->first));
    if (const auto event = controller_.next_event(now_)) next = std::min(next, *event);
    // The estimate changes all the time: what was due by one may not be due by the next.
    const LocalTime soon = now_ + std::chrono::microseconds{100};
    if (const auto event = executor_.next_event(moment().clock)) next = std::min(next, std::max(soon, *event));
    now_ = next;
    carry_out(executor_.on(controller_.observe(now_), moment()));
    while (!network_.empty() && network_.begin()->first <= now_) {
      const Message message = network_.begin()->second;
      network_.erase(network_.begin());
      if (message.incarnation != incarnation_) continue;
      std::visit([&](const auto& m) { carry_out(executor_.on(m, moment())); }, message.content);
    }
    carry_out(executor_.advance(moment()));
  }

  /// The new one knows nothing and may use any id again.
  void replace_planner() {
    of_former_ = executor_.running() != nullptr ? *executor_.running() : CommandId{};
    carry_out(executor_.on_planner(++incarnation_, moment()));
    dispatches_.clear();
    sent_.clear();
    ids_.clear();
    executed_.clear();
    gone_.clear();
    last_id_ = 0;
  }

  void send(const std::variant<Dispatch, Withdrawal>& content) {
    if (chance(0.3)) return;
    const Message message{incarnation_, content};
    const int copies = chance(0.3) ? 2 + static_cast<int>(unit() * 3) : 1;
    for (int i = 0; i < copies; ++i) network_.emplace(now_ + up_to(chance(0.1) ? 3.0 : 0.02), message);
  }

  void plan() {
    const bool last_one_used = !dispatches_.empty() && ids_.count(dispatches_.back().id) > 0;
    if (dispatches_.empty() || chance(last_one_used ? 0.8 : 0.1)) {
      Dispatch d;
      d.id = CommandId{"c" + std::to_string(++last_id_)};
      d.robot = robot_.name;
      dispatches_.push_back(d);
    }
    // Mostly the latest command, at times one of long ago.
    Dispatch& d =
        chance(0.8) ? dispatches_.back() : dispatches_[static_cast<std::size_t>(unit() * static_cast<double>(dispatches_.size()))];
    if (chance(0.6)) {
      const ControllerState state = controller_.observe(now_);
      d.attempt += static_cast<std::uint32_t>(1 + unit() * 2);
      d.from = state.joints;
      d.motion = line_to({0.45, state.X_WT.translation().y() > 0 ? -0.05 - 0.05 * unit() : 0.05 + 0.05 * unit(), 0.3});
      d.earliest = truth(now_) + model::from_seconds(0.4 * unit() - 0.1);
      d.latest = d.earliest + up_to(0.5);
      d.duration = 0.4;
      sent_[d.id].push_back(d);
    }
    if (d.attempt > 0) send(d);
  }

  void withdraw() {
    if (dispatches_.empty()) return;
    const Dispatch& d = dispatches_.back();
    send(Withdrawal{d.id, d.robot, d.attempt + (chance(0.1) ? 1u : 0u)});
  }

  void carry_out(const Actions& actions) {
    if (actions.start) start(*actions.start);
    for (const auto& report : actions.reports) {
      ++counts_[report.state];
      if (of_former_ == report.id) continue;
      const auto key = std::make_pair(report.id, report.attempt);
      if (report.state == ExecutionState::withdrawn || report.state == ExecutionState::refused) {
        gone_.insert(key);
      } else if (report.state == ExecutionState::started || report.state == ExecutionState::completed) {
        ASSERT_TRUE(executed_.count(key)) << report.id.str() << " attempt " << report.attempt << ' ' << model::to_string(report.state);
      }
    }
  }

  void start(const StartMotion& motion) {
    ASSERT_NE(executor_.running(), nullptr);
    ASSERT_EQ(*executor_.running(), motion.id);
    const ControllerState before = controller_.observe(now_);
    ASSERT_FALSE(before.moving) << "two motions at once";
    ASSERT_NE(before.motion.phase, MotionPhase::commanded) << "two motions at once";
    // The attempt that starts is the one with this target: each attempt draws its own.
    const auto& attempts = sent_[motion.id];
    const auto sent =
        std::find_if(attempts.begin(), attempts.end(), [&](const Dispatch& d) { return y_of(d.motion) == y_of(motion.request); });
    ASSERT_NE(sent, attempts.end());
    const auto key = std::make_pair(motion.id, sent->attempt);
    ASSERT_FALSE(gone_.count(key)) << motion.id.str() << " was withdrawn or refused";
    ASSERT_LT((before.joints - sent->from).cwiseAbs().maxCoeff(), 1e-3);
    if (chance(0.1)) controller_.refuse_next("no");
    if (chance(0.1)) controller_.fail_next(unit(), "fault");
    if (!controller_.execute(motion.request, motion.number, now_)) {
      return carry_out(executor_.refused_by_controller(motion.number, "no", moment()));
    }
    ++started_;
    ASSERT_TRUE(ids_.insert(motion.id).second) << motion.id.str() << " executed twice";
    ASSERT_TRUE(executed_.insert(key).second);
    const LocalTime begin = controller_.observe(now_).motion.began.value_or(controller_.next_event(now_).value_or(now_));
    ASSERT_GE(truth(now_), sent->earliest);
    ASSERT_GE(truth(begin), sent->earliest);
    ASSERT_LE(truth(begin), sent->latest);
  }

  static double y_of(const model::MotionRequest& request) { return std::get<model::LinearTarget>(request.target).X_WT.translation().y(); }

  static constexpr Duration kOffset{123'456'789'012};
  std::mt19937_64 random_;
  model::Robot robot_ = shaky_arm();
  SimController controller_;
  Executor executor_{robot_.name, controller_.capabilities()};
  LocalTime now_{};
  int events_ = 0;
  std::uint64_t incarnation_ = 0;
  std::multimap<LocalTime, Message> network_;
  std::vector<Dispatch> dispatches_;
  std::map<CommandId, std::vector<Dispatch>> sent_;  // every attempt
  CommandId of_former_;                              // runs on under the new planner
  int last_id_ = 0;
  int started_ = 0;
  std::set<CommandId> ids_;
  std::set<std::pair<CommandId, std::uint32_t>> executed_;
  std::set<std::pair<CommandId, std::uint32_t>> gone_;
};

TEST(ExecutorStorm, NeverTwoAtOnceNeverOutsideTheWindowNeverTwice) {
  int started = 0, completed = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    std::cout << "seed " << seed;
    Storm storm{seed};
    storm.run(10'000);
    std::cout << ":";
    for (const auto& [state, count] : storm.counts_) std::cout << ' ' << model::to_string(state) << ' ' << count;
    std::cout << '\n';
    started += storm.started();
    completed += storm.completed();
    ASSERT_FALSE(::testing::Test::HasFatalFailure());
  }
  EXPECT_GT(started, 1000) << "the storm must let something through, or it shows nothing";
  EXPECT_GT(completed, 500);
}

}  // namespace
}  // namespace interlace::proxy
