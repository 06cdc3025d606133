#include "robot_proxy/executor.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "robot_proxy/drivers/sim/sim_controller.hpp"
#include "tests/unit/proxy/support.hpp"

namespace interlace::proxy {
namespace {

using model::CommandId;
using model::Dispatch;
using model::Duration;
using model::ExecutionReported;
using model::ExecutionState;
using model::Joints;
using model::RobotName;
using test::arm;
using test::joints_to;
using test::line_to;
using test::local;
using namespace std::chrono_literals;

/// Planner time runs 100 s ahead of local time in these tests. The controller begins 10 to 30 ms after the command.
class ExecutorTest : public ::testing::Test {
 protected:
  static constexpr Duration kAhead = 100s;
  static Capabilities capabilities() {
    Capabilities c;
    c.can_stop = true;
    c.earliest_start = 10ms;
    c.latest_start = 30ms;
    return c;
  }
  static Moment when(double s, Duration uncertainty = 0ns) { return {local(s), ClockEstimate{kAhead, uncertainty}}; }
  static model::Instant planner(double s) { return model::at_seconds(s + 100); }

  /// Joint move of all joints to 0.5 rad; window in local seconds.
  static Dispatch dispatch(const std::string& id, double earliest, double latest, std::uint32_t attempt = 0) {
    Dispatch d;
    d.id = CommandId{id};
    d.robot = RobotName{"r1"};
    d.attempt = attempt;
    d.motion = joints_to(Joints::Constant(0.5));
    d.earliest = planner(earliest);
    d.latest = planner(latest);
    d.duration = 2;
    return d;
  }
  static model::Withdrawal withdrawal(const std::string& id, std::uint32_t attempt = 0) {
    return {CommandId{id}, RobotName{"r1"}, attempt};
  }
  static ControllerState state(double at, MotionNumber number = 0, MotionPhase phase = MotionPhase::none, double q = 0) {
    ControllerState s;
    s.at = local(at);
    s.joints = Joints::Constant(q);
    s.ready = true;
    s.moving = phase == MotionPhase::moving;
    s.motion.number = number;
    s.motion.phase = phase;
    return s;
  }
  /// Standing at zero.
  Actions look(double at) { return executor_.on(state(at), when(at)); }
  /// `id` on its way as motion 1: commanded at 1 s, last seen standing at 1.00 s, seen moving at 1.02 s.
  void get_moving(const std::string& id) {
    static_cast<void>(look(1));
    ASSERT_TRUE(executor_.on(dispatch(id, 1, 2), when(1)).start);
    static_cast<void>(executor_.on(state(1.02, 1, MotionPhase::moving), when(1.02)));
  }
  static void expect_one(const Actions& actions, ExecutionState expected) {
    ASSERT_EQ(actions.reports.size(), 1u);
    EXPECT_EQ(actions.reports[0].state, expected) << actions.reports[0].text;
  }
  void expect_refused(const Actions& actions, const std::string& part_of_text) {
    expect_one(actions, ExecutionState::refused);
    EXPECT_FALSE(actions.start);
    EXPECT_NE(actions.reports[0].text.find(part_of_text), std::string::npos) << actions.reports[0].text;
    EXPECT_EQ(executor_.waiting(), nullptr);
  }

  Executor executor_{RobotName{"r1"}, capabilities()};
};

TEST_F(ExecutorTest, RefusesAMotionThatWasPlannedWithoutWhatTheRobotMayHold) {
  ControllerState holding = state(1);
  holding.holds = {model::ToolName{"long"}};
  static_cast<void>(executor_.on(holding, when(1)));
  Dispatch d = dispatch("a", 1, 2);
  d.holds = {model::ToolName{"short"}};
  const Actions refused = executor_.on(d, when(1));
  expect_refused(refused, "may hold 'long', the motion was planned without it");
  EXPECT_EQ(refused.reports[0].holds, holding.holds) << "the planner hears what is held";
  d.attempt = 1;
  d.holds.emplace_back("long");
  EXPECT_TRUE(executor_.on(d, when(1)).start) << "planned with more than there is, which is safe";
}

TEST_F(ExecutorTest, StartsAtEarliestAndTellsTheWholeStory) {
  static_cast<void>(look(0));
  const Actions accepted = executor_.on(dispatch("a", 1, 2), when(0));
  expect_one(accepted, ExecutionState::accepted);
  EXPECT_EQ(accepted.reports[0].at, planner(0));
  EXPECT_FALSE(accepted.start);
  ASSERT_NE(executor_.waiting(), nullptr);
  EXPECT_EQ(executor_.next_event(when(0).clock), local(1));

  static_cast<void>(look(0.999999999));
  EXPECT_FALSE(executor_.advance(when(0.999999999)).start);
  const Actions go = executor_.advance(when(1));
  ASSERT_TRUE(go.start);
  EXPECT_EQ(go.start->id, CommandId{"a"});
  EXPECT_EQ(go.start->number, 1u);
  EXPECT_TRUE(go.reports.empty()) << "started is said when the robot is seen to move";
  ASSERT_NE(executor_.running(), nullptr);
  EXPECT_FALSE(executor_.advance(when(1)).start) << "once";

  EXPECT_TRUE(executor_.on(state(1.01, 1, MotionPhase::commanded), when(1.01)).reports.empty());
  const Actions begun = executor_.on(state(1.03, 1, MotionPhase::moving, 0.01), when(1.04));
  expect_one(begun, ExecutionState::started);
  EXPECT_EQ(begun.reports[0].at, planner(1.02)) << "the middle between seen standing and seen moving";
  EXPECT_NEAR(begun.reports[0].uncertainty, 0.01, 1e-8);

  EXPECT_TRUE(executor_.on(state(2, 1, MotionPhase::moving, 0.3), when(2)).reports.empty());
  const Actions done = executor_.on(state(3.02, 1, MotionPhase::finished, 0.5005), when(3.02));
  expect_one(done, ExecutionState::completed);
  EXPECT_EQ(done.reports[0].joints, Joints::Constant(0.5005));
  EXPECT_EQ(done.reports[0].at, planner(3.02));
  EXPECT_EQ(executor_.running(), nullptr);
  EXPECT_FALSE(executor_.next_event(when(3.02).clock));
}

TEST_F(ExecutorTest, TheControllersOwnTimesAreExact) {
  static_cast<void>(look(1));
  ASSERT_TRUE(executor_.on(dispatch("a", 1, 2), when(1)).start);
  ControllerState s = state(3.5, 1, MotionPhase::finished, 0.5);
  s.motion.began = local(1.012345678);
  s.motion.ended = local(3.012345678);
  const Actions actions = executor_.on(s, when(3.5, 1ms));
  ASSERT_EQ(actions.reports.size(), 2u) << "the movement was never seen, yet it is told";
  EXPECT_EQ(actions.reports[0].state, ExecutionState::started);
  EXPECT_EQ(actions.reports[0].at, planner(1.012345678));
  EXPECT_DOUBLE_EQ(actions.reports[0].uncertainty, 1e-3);
  EXPECT_EQ(actions.reports[1].state, ExecutionState::completed);
  EXPECT_EQ(actions.reports[1].at, planner(3.012345678));
}

TEST_F(ExecutorTest, UncertaintyShrinksTheWindowFromBothSides) {
  static_cast<void>(look(0.9));
  expect_one(executor_.on(dispatch("a", 1, 1.05), when(0.9, 10ms)), ExecutionState::accepted);
  EXPECT_EQ(executor_.next_event(when(0.9, 10ms).clock), local(1.01));
  static_cast<void>(executor_.on(state(1.009), when(1.009, 10ms)));
  EXPECT_FALSE(executor_.advance(when(1.009, 10ms)).start);
  // 1.01 + 0.01 uncertainty + 0.03 latency is exactly the end of the window.
  EXPECT_TRUE(executor_.advance(when(1.01, 10ms)).start);
}

TEST_F(ExecutorTest, RefusesAWindowThatCannotBeMetForCertain) {
  static_cast<void>(look(0.9));
  expect_refused(executor_.on(dispatch("a", 1, 1.049), when(0.9, 10ms)), "window");
  expect_refused(executor_.on(dispatch("b", 0.5, 0.92), when(0.9)), "window");
  expect_one(executor_.on(dispatch("c", 0.5, 0.93), when(0.9)), ExecutionState::accepted);
}

TEST_F(ExecutorTest, RefusesAtTheStartWhatHasBecomeUncertainOrLate) {
  static_cast<void>(look(0.9));
  expect_one(executor_.on(dispatch("a", 1, 1.05), when(0.9)), ExecutionState::accepted);
  expect_refused(executor_.advance(when(1.021)), "window");
  static_cast<void>(look(1.9));
  expect_one(executor_.on(dispatch("b", 2, 2.05), when(1.9)), ExecutionState::accepted);
  expect_refused(executor_.on(state(2.1), when(2.1, 1ms)), "window");
}

TEST_F(ExecutorTest, RefusesWithoutEstimateOfPlannerTime) {
  static_cast<void>(look(0));
  const Actions actions = executor_.on(dispatch("a", 1, 2), {local(0), std::nullopt});
  expect_refused(actions, "planner time");
  EXPECT_EQ(actions.reports[0].uncertainty, kUnknownTime);
  expect_one(executor_.on(dispatch("b", 1, 2), when(0)), ExecutionState::accepted);
  EXPECT_LE(executor_.next_event(std::nullopt), local(0)) << "due at once";
  expect_refused(executor_.advance({local(0.5), std::nullopt}), "planner time");
}

TEST_F(ExecutorTest, RefusesWhenTheControllerIsSilentOrNotReadyOrMovesByItself) {
  expect_refused(executor_.on(dispatch("a", 1, 2), when(0)), "never heard");
  static_cast<void>(look(0));
  expect_refused(executor_.on(dispatch("b", 1, 2), when(0.3)), "not heard from for 0.3");
  ControllerState broken = state(0.4);
  broken.ready = false;
  broken.fault = "door open";
  static_cast<void>(executor_.on(broken, when(0.4)));
  expect_refused(executor_.on(dispatch("c", 1, 2), when(0.4)), "door open");
  ControllerState jogged = state(0.5);
  jogged.moving = true;
  static_cast<void>(executor_.on(jogged, when(0.5)));
  expect_refused(executor_.on(dispatch("d", 1, 2), when(0.5)), "moving");
  static_cast<void>(look(0.6));
  expect_one(executor_.on(dispatch("e", 1, 2), when(0.6)), ExecutionState::accepted);
  broken.at = local(1);
  expect_refused(executor_.on(broken, when(1)), "door open");
}

TEST_F(ExecutorTest, RefusesAnotherPostureThanPlannedFrom) {
  static_cast<void>(executor_.on(state(0, 0, MotionPhase::none, 0.9e-3), when(0)));
  expect_one(executor_.on(dispatch("a", 1, 2), when(0)), ExecutionState::accepted);
  static_cast<void>(executor_.on(state(1, 0, MotionPhase::none, 1.1e-3), when(0.99)));
  expect_refused(executor_.advance(when(1)), "joint 1 stands");
  expect_refused(executor_.on(dispatch("b", 1, 2), when(1)), "joint 1 stands");
  Dispatch nan = dispatch("c", 1, 2);
  nan.from[3] = std::nan("");
  expect_refused(executor_.on(nan, when(1)), "joint");
}

TEST_F(ExecutorTest, RefusesMovesTheControllerDoesNotKnow) {
  Capabilities joints_only = capabilities();
  joints_only.linear_moves = false;
  Executor executor{RobotName{"r1"}, joints_only};
  static_cast<void>(executor.on(state(0), when(0)));
  Dispatch d = dispatch("a", 1, 2);
  d.motion = line_to({0.4, 0, 0.3});
  expect_refused(executor.on(d, when(0)), "linear");
  expect_one(executor.on(dispatch("b", 1, 2), when(0)), ExecutionState::accepted);
}

TEST_F(ExecutorTest, RefusesWhileBusyWaitingOrRunning) {
  static_cast<void>(look(0.9));
  expect_one(executor_.on(dispatch("a", 1, 2), when(0.9)), ExecutionState::accepted);
  const Actions waiting = executor_.on(dispatch("b", 1, 2), when(0.9));
  expect_one(waiting, ExecutionState::refused);
  EXPECT_NE(waiting.reports[0].text.find("'a'"), std::string::npos);
  ASSERT_TRUE(executor_.advance(when(1)).start);
  expect_one(executor_.on(dispatch("c", 1, 2), when(1)), ExecutionState::refused);
}

TEST_F(ExecutorTest, TheSameIdAndAttemptIsAnsweredAgainAndExecutedOnce) {
  static_cast<void>(look(0.9));
  const Dispatch d = dispatch("a", 1, 20);
  expect_one(executor_.on(d, when(0.9)), ExecutionState::accepted);
  const Actions again = executor_.on(d, when(0.95));
  expect_one(again, ExecutionState::accepted);
  EXPECT_EQ(again.reports[0].at, planner(0.9)) << "the same report";
  ASSERT_TRUE(executor_.advance(when(1)).start);
  EXPECT_FALSE(executor_.on(d, when(1)).start);
  static_cast<void>(executor_.on(state(1.02, 1, MotionPhase::moving), when(1.02)));
  expect_one(executor_.on(d, when(1.1)), ExecutionState::started);
  static_cast<void>(executor_.on(state(3, 1, MotionPhase::finished, 0.5), when(3)));
  static_cast<void>(executor_.on(state(4, 1, MotionPhase::finished, 0), when(4)));  // brought back by hand
  const Actions after = executor_.on(d, when(4));
  expect_one(after, ExecutionState::completed);
  EXPECT_FALSE(after.start);
  Dispatch newer = d;
  newer.attempt = 1;
  const Actions never = executor_.on(newer, when(4));
  expect_one(never, ExecutionState::completed);
  EXPECT_FALSE(never.start) << "a command that was executed is not executed again";
}

TEST_F(ExecutorTest, RefusalsAreAnsweredAgainAndANewerAttemptIsTriedAgain) {
  static_cast<void>(look(0.9));
  expect_refused(executor_.on(dispatch("a", 0, 0, 3), when(0.9)), "window");
  expect_refused(executor_.on(dispatch("a", 1, 2, 3), when(0.9)), "window");
  EXPECT_TRUE(executor_.on(dispatch("a", 1, 2, 2), when(0.9)).reports.empty()) << "older: ignored";
  expect_one(executor_.on(dispatch("a", 1, 2, 4), when(0.9)), ExecutionState::accepted);
}

TEST_F(ExecutorTest, ANewerAttemptReplacesAWaitingOne) {
  static_cast<void>(look(0.9));
  expect_one(executor_.on(dispatch("a", 1, 2, 0), when(0.9)), ExecutionState::accepted);
  const Actions replaced = executor_.on(dispatch("a", 1.5, 2, 1), when(0.9));
  ASSERT_EQ(replaced.reports.size(), 2u);
  EXPECT_EQ(replaced.reports[0].state, ExecutionState::withdrawn);
  EXPECT_EQ(replaced.reports[0].attempt, 0u);
  EXPECT_EQ(replaced.reports[1].state, ExecutionState::accepted);
  EXPECT_EQ(replaced.reports[1].attempt, 1u);
  EXPECT_EQ(executor_.next_event(when(1).clock), local(1.5));
}

TEST_F(ExecutorTest, AWithdrawalTakesBackWhatHasNotStarted) {
  static_cast<void>(look(0.9));
  expect_one(executor_.on(dispatch("a", 1, 2), when(0.9)), ExecutionState::accepted);
  expect_one(executor_.on(withdrawal("a"), when(0.95)), ExecutionState::withdrawn);
  static_cast<void>(look(1));
  EXPECT_FALSE(executor_.advance(when(1)).start);
  expect_one(executor_.on(withdrawal("a"), when(1)), ExecutionState::withdrawn);
  expect_one(executor_.on(dispatch("a", 1, 2), when(1)), ExecutionState::withdrawn);
}

TEST_F(ExecutorTest, AWithdrawalThatOvertakesItsDispatchHolds) {
  static_cast<void>(look(0.9));
  expect_one(executor_.on(withdrawal("a", 1), when(0.9)), ExecutionState::withdrawn);
  expect_one(executor_.on(dispatch("a", 1, 2, 1), when(0.9)), ExecutionState::withdrawn);
  EXPECT_TRUE(executor_.on(dispatch("a", 1, 2, 0), when(0.9)).reports.empty());
  expect_one(executor_.on(dispatch("a", 1, 2, 2), when(0.9)), ExecutionState::accepted);
  EXPECT_TRUE(executor_.on(withdrawal("a", 1), when(0.9)).reports.empty()) << "an old withdrawal does not touch a newer attempt";
  expect_one(executor_.on(withdrawal("a", 3), when(0.9)), ExecutionState::withdrawn);
  expect_one(executor_.on(dispatch("a", 1, 2, 3), when(0.9)), ExecutionState::withdrawn);
}

TEST_F(ExecutorTest, AWithdrawalAfterTheStartIsAnsweredWithStarted) {
  get_moving("a");
  expect_one(executor_.on(withdrawal("a"), when(1.1)), ExecutionState::started);
  ASSERT_NE(executor_.running(), nullptr);
  static_cast<void>(executor_.on(state(3, 1, MotionPhase::finished, 0.5), when(3)));
  expect_one(executor_.on(withdrawal("a"), when(3.1)), ExecutionState::completed);
}

TEST_F(ExecutorTest, AnotherIncarnationDropsWhatWaitsAndForgetsTheAnswers) {
  static_cast<void>(executor_.on_planner(1, when(0)));
  static_cast<void>(look(0.9));
  expect_refused(executor_.on(dispatch("x", 0, 0), when(0.9)), "window");
  expect_one(executor_.on(dispatch("a", 1, 2), when(0.9)), ExecutionState::accepted);
  EXPECT_TRUE(executor_.on_planner(1, when(0.9)).reports.empty());
  ASSERT_NE(executor_.waiting(), nullptr);
  EXPECT_TRUE(executor_.on_planner(2, when(0.95)).reports.empty());
  EXPECT_EQ(executor_.waiting(), nullptr);
  static_cast<void>(look(1));
  EXPECT_FALSE(executor_.advance(when(1)).start);
  expect_one(executor_.on(dispatch("x", 2, 3), when(1)), ExecutionState::accepted);
}

TEST_F(ExecutorTest, AMotionOutlivesItsPlanner) {
  static_cast<void>(executor_.on_planner(1, when(0)));
  get_moving("a");
  static_cast<void>(executor_.on_planner(2, when(1.5)));
  ASSERT_NE(executor_.running(), nullptr);
  expect_one(executor_.on(dispatch("a", 1, 20), when(1.5)), ExecutionState::refused);
  expect_one(executor_.on(state(3, 1, MotionPhase::finished, 0.5), when(3)), ExecutionState::completed);
  Dispatch next = dispatch("a", 3, 20, 1);
  next.from = Joints::Constant(0.5);
  EXPECT_TRUE(executor_.on(next, when(3)).start) << "the new planner's command of the same name is another command";
}

TEST_F(ExecutorTest, FinishedElsewhereIsFailed) {
  get_moving("a");
  const Actions actions = executor_.on(state(3, 1, MotionPhase::finished, 0.48), when(3));
  expect_one(actions, ExecutionState::failed);
  EXPECT_NE(actions.reports[0].text.find("0.02"), std::string::npos) << actions.reports[0].text;
  EXPECT_EQ(actions.reports[0].joints, Joints::Constant(0.48));
}

TEST_F(ExecutorTest, ALinearMoveArrivesByItsTcp) {
  for (const double off : {0.9e-3, 1.1e-3}) {
    Executor executor{RobotName{"r1"}, capabilities()};
    static_cast<void>(executor.on(state(1), when(1)));
    Dispatch d = dispatch("a", 1, 2);
    d.motion = line_to({0.4, 0, 0.3});
    ASSERT_TRUE(executor.on(d, when(1)).start);
    ControllerState s = state(3, 1, MotionPhase::finished);
    s.X_WT.translation() = model::Vector3{0.4 + off, 0, 0.3};
    const Actions actions = executor.on(s, when(3));
    ASSERT_EQ(actions.reports.size(), 2u);
    EXPECT_EQ(actions.reports[1].state, off < 1e-3 ? ExecutionState::completed : ExecutionState::failed);
  }
}

TEST_F(ExecutorTest, FinishedIsBelievedOnlyOfARobotThatStands) {
  get_moving("a");
  ControllerState s = state(3, 1, MotionPhase::finished, 0.5);
  s.moving = true;
  EXPECT_TRUE(executor_.on(s, when(3)).reports.empty());
  s.moving = false;
  s.at = local(3.1);
  expect_one(executor_.on(s, when(3.1)), ExecutionState::completed);
}

TEST_F(ExecutorTest, AFaultOnTheWayIsFailedWithItsText) {
  get_moving("a");
  ControllerState s = state(2, 1, MotionPhase::failed, 0.2);
  s.motion.text = "servo off";
  const Actions actions = executor_.on(s, when(2));
  expect_one(actions, ExecutionState::failed);
  EXPECT_EQ(actions.reports[0].text, "servo off");
  EXPECT_FALSE(actions.stop);
}

TEST_F(ExecutorTest, WhatTheControllerDoesNotTakeIsRefused) {
  static_cast<void>(look(1));
  ASSERT_TRUE(executor_.on(dispatch("a", 1, 2), when(1)).start);
  EXPECT_TRUE(executor_.refused_by_controller(17, "?", when(1)).reports.empty());
  const Actions at_once = executor_.refused_by_controller(1, "joint 2 out of range", when(1));
  expect_refused(at_once, "joint 2 out of range");
  ASSERT_TRUE(executor_.on(dispatch("a", 1, 2, 1), when(1)).start) << "a newer attempt is tried again: nothing had moved";
  ControllerState s = state(1.1, 2, MotionPhase::refused);
  s.motion.text = "wrong tool";
  expect_refused(executor_.on(s, when(1.1)), "wrong tool");
}

TEST_F(ExecutorTest, AMotionThatDoesNotBeginOrEndHasADeadline) {
  static_cast<void>(look(1));
  ASSERT_TRUE(executor_.on(dispatch("a", 1, 2), when(1)).start);
  EXPECT_EQ(executor_.next_event(when(1).clock), local(1.53));
  const Actions stuck = executor_.advance(when(1.53));
  expect_one(stuck, ExecutionState::failed);
  EXPECT_TRUE(stuck.stop);
  // It begins after all: nothing else may start meanwhile.
  static_cast<void>(executor_.on(state(1.6, 1, MotionPhase::moving), when(1.6)));
  expect_refused(executor_.on(dispatch("b", 1.6, 2), when(1.6)), "moving");

  static_cast<void>(executor_.on(state(5, 1, MotionPhase::failed), when(5)));
  ASSERT_TRUE(executor_.on(dispatch("c", 5, 6), when(5)).start);
  ControllerState s = state(5.02, 2, MotionPhase::moving);
  s.motion.began = local(5.02);
  static_cast<void>(executor_.on(s, when(5.02)));
  EXPECT_EQ(executor_.next_event(when(5.02).clock), local(5.02 + 2 * 1.5 + 1));
  EXPECT_TRUE(executor_.advance(when(9.02)).stop);
  EXPECT_EQ(executor_.running(), nullptr);
}

TEST_F(ExecutorTest, OldNewsOfTheControllerIsIgnored) {
  get_moving("a");
  EXPECT_TRUE(executor_.on(state(1.01, 1, MotionPhase::finished, 0.5), when(1.05)).reports.empty()) << "older than the last";
  EXPECT_TRUE(executor_.on(state(1.05, 0, MotionPhase::finished, 0.5), when(1.05)).reports.empty()) << "of another motion";
  ASSERT_NE(executor_.running(), nullptr);
}

TEST_F(ExecutorTest, MessagesForOtherRobotsAreIgnored) {
  static_cast<void>(look(1));
  Dispatch d = dispatch("a", 1, 2);
  d.robot = RobotName{"r2"};
  EXPECT_TRUE(executor_.on(d, when(1)).reports.empty());
  EXPECT_TRUE(executor_.on(model::Withdrawal{CommandId{"a"}, RobotName{"r2"}, 0}, when(1)).reports.empty());
}

TEST_F(ExecutorTest, RemembersTheLastOutcomesOnly) {
  ExecutorOptions options;
  options.remembered = 3;
  Executor executor{RobotName{"r1"}, capabilities(), options};
  for (const char* id : {"a", "b", "c", "a", "d"}) static_cast<void>(executor.on(withdrawal(id, 1), when(0)));
  // "a" is the oldest (its repetition changed nothing) and gone: an older attempt is new again. The others are known.
  expect_one(executor.on(dispatch("a", 1, 2, 0), when(0)), ExecutionState::refused);
  for (const char* id : {"c", "d"}) EXPECT_TRUE(executor.on(dispatch(id, 1, 2, 0), when(0)).reports.empty());
}

/// As the simulator drives it: one clock, no latency. Start and end are exact to the nanosecond.
TEST(ExecutorInVirtualTime, IsExact) {
  const model::Robot robot = arm();
  SimController controller{robot};
  Executor executor{robot.name, controller.capabilities()};
  Dispatch d;
  d.id = CommandId{"a"};
  d.robot = robot.name;
  d.motion = line_to({0.45, 0.1, 0.3});
  d.from = robot.start;
  d.earliest = d.latest = model::at_seconds(1.234567891);
  d.duration = 2;
  std::vector<ExecutionReported> reports;
  LocalTime now{};
  const auto moment = [&] { return Moment{now, ClockEstimate{}}; };
  const auto carry_out = [&](Actions actions) {
    if (actions.start) {
      ASSERT_TRUE(controller.execute(actions.start->request, actions.start->number, now));
    }
    reports.insert(reports.end(), actions.reports.begin(), actions.reports.end());
  };
  carry_out(executor.on(controller.observe(now), moment()));
  carry_out(executor.on(d, moment()));
  int steps = 0;
  while (executor.waiting() != nullptr || executor.running() != nullptr) {
    ASSERT_LT(++steps, 10) << "no polling";
    now = std::min(executor.next_event(ClockEstimate{}).value_or(LocalTime::max()), controller.next_event(now).value_or(LocalTime::max()));
    carry_out(executor.on(controller.observe(now), moment()));
    carry_out(executor.on(controller.observe(now), moment()));  // a start without latency moves at this very instant
  }
  ASSERT_EQ(reports.size(), 3u);
  EXPECT_EQ(reports[1].state, ExecutionState::started);
  EXPECT_EQ(reports[1].at, d.earliest);
  EXPECT_EQ(reports[1].uncertainty, 0);
  EXPECT_EQ(reports[2].state, ExecutionState::completed);
  EXPECT_EQ(reports[2].at, d.earliest + 2s);
}

}  // namespace
}  // namespace interlace::proxy
