#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/e2e/cells.hpp"
#include "tests/e2e/running_cell.hpp"
#include "tests/e2e/scratch.hpp"
#include "tests/e2e/view.hpp"

// Every program is told to end, or is killed, and started again: how it ends, and that the others go on.
namespace interlace::test {
namespace {

using model::CommandState;
using model::ExecutionState;
using model::RobotMode;

class Lifecycle : public ::testing::Test {
 protected:
  /// A motion of r1 away from r2 that takes about 3 s at 60 mm/s; true once it is under way.
  [[nodiscard]] bool slow_motion_of_r1(const std::string& velocity = "60") {
    slow_ = &cell_.send("r1", "slow", {300, 250, 330}, {"--velocity", velocity});
    return view_.until([&] { return view_.moving("r1"); });
  }
  [[nodiscard]] RobotMode mode(const std::string& robot) const {
    if (!view_.planner()) return RobotMode::unknown;
    for (const auto& r : view_.planner()->robots) {
      if (r.name.str() == robot) return r.mode;
    }
    return RobotMode::unknown;
  }
  [[nodiscard]] bool becomes(const std::string& robot, RobotMode wanted) {
    return view_.until([&] { return mode(robot) == wanted; });
  }

  Scratch scratch_;
  RunningCell cell_{unique_domain(), "fast", scratch_.file("cell.yaml", cell_text())};
  View view_{unique_domain(), "fast"};
  Process* slow_ = nullptr;
};

TEST_F(Lifecycle, PlannerEndsOnSigtermAndTheProxiesServeTheNext) {
  ASSERT_TRUE(cell_.start());
  ASSERT_EQ(outcome(cell_.send("r1", "before", {300, 250, 330})).exit_code, 0);
  Process& planner = cell_.planner();
  planner.kill(SIGTERM);
  EXPECT_EQ(planner.wait(kPatience), 0);
  EXPECT_NE(planner.errors().find(" stopped "), std::string::npos);
  const Outcome none = cell_.ask({"status", "--timeout", "0.5"});
  EXPECT_EQ(none.exit_code, 4) << none;
  EXPECT_TRUE(cell_.proxy("r1").running());
  EXPECT_TRUE(cell_.proxy("r2").running());

  cell_.start_planner();
  ASSERT_TRUE(cell_.knows("r1") && cell_.knows("r2"));
  const Outcome again = outcome(cell_.send("r1", "after", {400, 250, 330}));
  EXPECT_EQ(again.exit_code, 0) << again;
  EXPECT_TRUE(cell_.proxy("r1").logs("planner_heard", kPatience, 2));
}

TEST_F(Lifecycle, EveryProgramEndsOnSigintToo) {
  ASSERT_TRUE(cell_.start());
  Process& status = cell_.client({"status", "--watch"});
  Process& postures = cell_.client({"watch"});
  ASSERT_TRUE(view_.until([&] { return !status.output().empty() && !postures.output().empty(); }));
  for (Process* process : {&status, &postures, &cell_.planner(), &cell_.proxy("r1"), &cell_.proxy("r2")}) {
    process->kill(SIGINT);
    EXPECT_EQ(process->wait(kPatience), 0) << process->program() << '\n' << process->errors();
  }
}

TEST_F(Lifecycle, AStandingProxyEndsAtOnceAndIsMissed) {
  ASSERT_TRUE(cell_.start());
  cell_.proxy("r2").kill(SIGTERM);
  EXPECT_EQ(cell_.proxy("r2").wait(2s), 0);
  EXPECT_TRUE(cell_.planner().logs("robot_lost robot=r2", kPatience));
  EXPECT_TRUE(becomes("r2", RobotMode::unknown));
  EXPECT_EQ(mode("r1"), RobotMode::standby);
  cell_.start_proxy("r2");
  ASSERT_TRUE(cell_.knows("r2", 2));
  EXPECT_EQ(outcome(cell_.send("r2", "back", {300, -250, 330})).exit_code, 0);
}

TEST_F(Lifecycle, AProxyInMotionEndsAfterItsMotion) {
  ASSERT_TRUE(cell_.start());
  ASSERT_TRUE(slow_motion_of_r1());
  Process& proxy = cell_.proxy("r1");
  proxy.kill(SIGTERM);
  const Outcome o = outcome(*slow_);
  EXPECT_EQ(o.exit_code, 0) << "others count on its arrival\n" << o;
  EXPECT_EQ(proxy.wait(kPatience), 0);
  const std::string log = proxy.errors();
  ASSERT_NE(log.find(" completed "), std::string::npos) << log;
  EXPECT_LT(log.find(" completed "), log.find(" stopped "));
  EXPECT_NE(log.find("in_motion=false"), std::string::npos) << log;
  EXPECT_TRUE(view_.until([&] { return view_.stands_at("r1", {0.3, 0.25, 0.33}); })) << "the last that is heard of it is where it stopped";
}

TEST_F(Lifecycle, ASecondSigtermEndsAProxyInMotionAtOnce) {
  ASSERT_TRUE(cell_.start());
  ASSERT_TRUE(slow_motion_of_r1());
  Process& proxy = cell_.proxy("r1");
  proxy.kill(SIGTERM);
  ASSERT_TRUE(view_.until([&] { return !view_.posture("r1")->posture.ready; }));  // it has understood the first
  ASSERT_TRUE(view_.moving("r1"));
  proxy.kill(SIGTERM);
  EXPECT_EQ(proxy.wait(1s), 0);
  EXPECT_NE(proxy.errors().find("in_motion=true"), std::string::npos) << proxy.errors();
}

TEST_F(Lifecycle, AProxyThatIsKilledInMotionKeepsTheNeighboursOutUntilItIsBack) {
  ASSERT_TRUE(cell_.start());
  ASSERT_TRUE(slow_motion_of_r1());
  cell_.proxy("r1").kill(SIGKILL);
  ASSERT_TRUE(becomes("r1", RobotMode::unknown));
  Process& neighbour = cell_.send("r2", "neighbour", {300, -250, 330});
  ASSERT_TRUE(view_.until([&] { return view_.reached("neighbour", CommandState::waiting); }));
  EXPECT_EQ(view_.status("neighbour")->reason, model::Reason::robot_unknown);
  EXPECT_NE(view_.status("neighbour")->text.find("r1 is not heard from"), std::string::npos) << view_.status("neighbour")->text;
  EXPECT_EQ(view_.executions(ExecutionState::started, "neighbour"), 0u);
  EXPECT_TRUE(neighbour.running());

  cell_.start_proxy("r1");
  const Outcome o = outcome(neighbour);
  EXPECT_EQ(o.exit_code, 0) << o;
  const Outcome interrupted = outcome(*slow_);
  EXPECT_EQ(interrupted.exit_code, 1) << "its motion did not end where it should\n" << interrupted;
  const Outcome again = outcome(cell_.send("r1", "again", {400, 250, 330}));
  EXPECT_EQ(again.exit_code, 0) << again;
}

TEST_F(Lifecycle, APlannerThatIsKilledIsReplacedAndTheClientIsTold) {
  ASSERT_TRUE(cell_.start());
  ASSERT_TRUE(slow_motion_of_r1());
  Process& run = cell_.client({"run", scratch_.file("program.yaml", table_4_4())});
  ASSERT_TRUE(view_.until([&] { return view_.planner()->accepted == 9; }));
  cell_.planner().kill(SIGKILL);
  cell_.start_planner();
  const Outcome told = outcome(run, 30s);
  EXPECT_EQ(told.exit_code, 1) << told;
  EXPECT_TRUE(told.says("the planner was restarted")) << told;
  EXPECT_EQ(outcome(*slow_).exit_code, 1);

  // The new planner does not know the motion that still runs, keeps out of its way, and goes on once it has ended.
  ASSERT_TRUE(cell_.knows("r2") && cell_.knows("r1"));
  const Outcome again = outcome(cell_.send("r2", "again", {300, -250, 330}));
  EXPECT_EQ(again.exit_code, 0) << again;
  EXPECT_TRUE(cell_.proxy("r1").logs("planner_heard", kPatience, 2));
  EXPECT_TRUE(view_.until([&] { return view_.stands_at("r1", {0.3, 0.25, 0.33}); }));
}

TEST_F(Lifecycle, AClientToldToEndTakesItsCommandsAlongAndNothingMoreStarts) {
  ASSERT_TRUE(cell_.start());
  const std::string report = scratch_.path("report.json");
  Process& run = cell_.client({"run", scratch_.file("program.yaml", table_4_4(4)), "--report", report});
  ASSERT_TRUE(view_.until([&] { return view_.executions(ExecutionState::completed) >= 1 && (view_.moving("r1") || view_.moving("r2")); }));
  run.kill(SIGTERM);
  const Outcome o = outcome(run);
  EXPECT_EQ(o.exit_code, 130) << o;
  EXPECT_TRUE(o.says("interrupted")) << o;
  // When it has gone, all it had sent is final: nothing waits, nothing moves.
  ASSERT_TRUE(view_.until([&] { return mode("r1") == RobotMode::standby && mode("r2") == RobotMode::standby; }));
  const std::size_t started = view_.executions(ExecutionState::started);
  EXPECT_LT(started, 32u);
  EXPECT_EQ(view_.queued("r1") + view_.queued("r2"), 0u);
  EXPECT_EQ(view_.executions(ExecutionState::completed), started) << "a running motion ends where it was going";
  const auto r = nlohmann::json::parse(read_text(report)).at(0);
  EXPECT_EQ(r["completed"], started);
  // A fresh command goes first: the queues are empty indeed.
  EXPECT_EQ(outcome(cell_.send("r1", "fresh", {450, 250, 300})).exit_code, 0);
  EXPECT_EQ(view_.until([&] { return view_.executions(ExecutionState::completed, "fresh") == 1; }), true);
  EXPECT_EQ(view_.executions(ExecutionState::started), started + 1);
}

TEST_F(Lifecycle, StopAndCancelGiveUpWhatHasNotStarted) {
  ASSERT_TRUE(cell_.start());
  ASSERT_TRUE(slow_motion_of_r1("15"));  // longer than five programs take to start, one after the other, on a loaded machine
  ASSERT_EQ(outcome(cell_.send("r1", "second", {400, 250, 330}, {"--no-wait"})).exit_code, 0);
  ASSERT_EQ(outcome(cell_.send("r1", "third", {450, 250, 300}, {"--no-wait"})).exit_code, 0);
  const Outcome cancelled = cell_.ask({"cancel", "r1", "second"});
  EXPECT_EQ(cancelled.exit_code, 0) << cancelled;
  const Outcome stopped = cell_.ask({"stop"});
  EXPECT_EQ(stopped.exit_code, 0) << stopped;
  EXPECT_EQ(outcome(*slow_).exit_code, 0) << "a running motion ends where it was going";
  EXPECT_TRUE(
      view_.until([&] { return view_.reached("second", CommandState::cancelled) && view_.reached("third", CommandState::cancelled); }));
  EXPECT_TRUE(becomes("r1", RobotMode::standby));
  EXPECT_EQ(view_.executions(ExecutionState::started), 1u);
}

}  // namespace
}  // namespace interlace::test
