#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/e2e/cells.hpp"
#include "tests/e2e/running_cell.hpp"
#include "tests/e2e/scratch.hpp"
#include "tests/e2e/view.hpp"

// Holding, resuming, replacing and deadlines with the real programs.
namespace interlace::test {
namespace {

using model::CommandState;
using model::ExecutionState;
using model::Reason;

class Control : public ::testing::Test {
 protected:
  /// A motion of r1 that is longer than several programs take to start on a loaded machine; true once it is under way.
  [[nodiscard]] bool slow_motion_of_r1() {
    slow_ = &cell_.send("r1", "slow", {300, 250, 330}, {"--velocity", "15"});
    return view_.until([&] { return view_.moving("r1"); });
  }
  [[nodiscard]] bool held(std::size_t robot) const { return view_.planner() && view_.planner()->robots.at(robot).held; }
  /// A program file for r1 alone.
  [[nodiscard]] std::string program(const std::string& name, const std::vector<std::string>& commands) const {
    std::string text = "interlace: 1\nunits: {length: mm, angle: deg}\nprogram:\n  r1:\n";
    for (const std::string& command : commands) text += "    - " + command + "\n";
    return scratch_.file(name, text);
  }

  Scratch scratch_;
  RunningCell cell_{unique_domain(), "fast", scratch_.file("cell.yaml", cell_text())};
  View view_{unique_domain(), "fast"};
  Process* slow_ = nullptr;
};

TEST_F(Control, AHeldRobotEndsItsMotionAndStandsUntilItIsResumed) {
  ASSERT_TRUE(cell_.start());
  ASSERT_TRUE(slow_motion_of_r1());
  ASSERT_EQ(outcome(cell_.send("r1", "second", {400, 250, 330}, {"--no-wait"})).exit_code, 0);
  const Outcome o = cell_.ask({"hold", "r1"});
  EXPECT_EQ(o.exit_code, 0) << o;
  EXPECT_TRUE(o.says("r1: held; what it has begun it ends; 1 command waits")) << o;
  EXPECT_EQ(outcome(*slow_).exit_code, 0) << "a running motion ends where it was going";
  ASSERT_TRUE(view_.until([&] { return view_.reached("second", CommandState::waiting); }));
  EXPECT_EQ(view_.status("second")->reason, Reason::held);
  const Outcome status = cell_.ask({"status"});
  EXPECT_TRUE(status.says("HELD") && status.says("until it is resumed")) << status;
  // r2 can go where r1 is not in its way.
  EXPECT_EQ(outcome(cell_.send("r2", "other", {300, -250, 330})).exit_code, 0);
  EXPECT_EQ(view_.executions(ExecutionState::started, "second"), 0u);
  const Outcome resumed = cell_.ask({"resume", "r1", "--json"});
  EXPECT_EQ(resumed.exit_code, 0) << resumed;
  EXPECT_EQ(nlohmann::json::parse(resumed.output).at(0)["state"], "completed");
  EXPECT_TRUE(view_.until([&] { return view_.reached("second", CommandState::completed); }));
}

TEST_F(Control, WhoeverWaitsForAHeldRobotIsToldSo) {
  ASSERT_TRUE(cell_.start());
  ASSERT_EQ(outcome(cell_.send("r1", "out", {350, 0, 200})).exit_code, 0);
  ASSERT_EQ(cell_.ask({"hold", "r1"}).exit_code, 0);
  Process& in = cell_.send("r2", "in", {350, 0, 200});
  ASSERT_TRUE(view_.until([&] { return view_.reached("in", CommandState::waiting); }));
  EXPECT_EQ(view_.status("in")->reason, Reason::held);
  EXPECT_EQ(view_.status("in")->text.rfind("r2 waits for r1, which is held", 0), 0u) << view_.status("in")->text;
  ASSERT_EQ(cell_.ask({"resume"}).exit_code, 0);
  const Outcome o = outcome(in);
  EXPECT_EQ(o.exit_code, 0) << o;
  EXPECT_TRUE(o.says("escape")) << "r1 had to be sent away\n" << o;
}

TEST_F(Control, AHoldOutlivesThePlanner) {
  ASSERT_TRUE(cell_.start());
  ASSERT_EQ(cell_.ask({"hold", "r1"}).exit_code, 0);
  ASSERT_TRUE(view_.until([&] { return view_.posture("r1") && view_.posture("r1")->held; }));
  cell_.planner().kill(SIGKILL);
  cell_.start_planner();
  ASSERT_TRUE(cell_.knows("r1") && cell_.knows("r2"));
  ASSERT_TRUE(view_.until([&] { return held(0); }));
  EXPECT_FALSE(held(1));
  Process& command = cell_.send("r1", "waits", {400, 250, 330});
  ASSERT_TRUE(view_.until([&] { return view_.reached("waits", CommandState::waiting); }));
  EXPECT_EQ(view_.status("waits")->reason, Reason::held);
  ASSERT_EQ(cell_.ask({"resume", "r1"}).exit_code, 0);
  EXPECT_EQ(outcome(command).exit_code, 0);
  EXPECT_TRUE(view_.until([&] { return !view_.posture("r1")->held; }));
}

TEST_F(Control, AQueueIsReplacedAsAWholeOrNotAtAll) {
  ASSERT_TRUE(cell_.start());
  ASSERT_TRUE(slow_motion_of_r1());
  ASSERT_EQ(outcome(cell_.send("r1", "second", {400, 250, 330}, {"--no-wait"})).exit_code, 0);
  const Outcome refused = cell_.ask({"replace", "r1", program("bad.yaml", {linear(400, 250, 330), linear(900, 250, 300)})});
  EXPECT_EQ(refused.exit_code, 1) << refused;
  EXPECT_TRUE(refused.says("command 2 of 2") && refused.says("the queue stays as it was")) << refused;
  EXPECT_TRUE(view_.until([&] { return view_.queued("r1") == 1; }));
  const Outcome o = cell_.ask({"replace", "r1", program("good.yaml", {linear(420, 250, 330), linear(450, 250, 300)}), "--json"});
  ASSERT_EQ(o.exit_code, 0) << o;
  const auto json = nlohmann::json::parse(o.output);
  EXPECT_EQ(json["explanation"], "1 command replaced by 2 commands");
  ASSERT_EQ(json["commands"].size(), 2u);
  ASSERT_TRUE(view_.until([&] { return view_.reached("second", CommandState::cancelled); }));
  EXPECT_EQ(view_.status("second")->reason, Reason::replaced);
  const std::string last = json["commands"].at(1)["id"];
  EXPECT_TRUE(view_.until([&] { return view_.reached(last, CommandState::completed); }));
  EXPECT_TRUE(view_.until([&] { return view_.stands_at("r1", {0.45, 0.25, 0.3}); }));
}

TEST_F(Control, WhatIsWrongWithAReplacementIsSaidBeforeAnythingIsSent) {
  ASSERT_TRUE(cell_.start());
  const std::string good = program("good.yaml", {linear(420, 250, 330)});
  EXPECT_EQ(cell_.ask({"replace", "r9", good}).exit_code, 2);
  EXPECT_EQ(cell_.ask({"replace", "r2", good}).exit_code, 2);
  const Outcome both = cell_.ask({"replace", "r1", scratch_.file("both.yaml", table_4_4())});
  EXPECT_EQ(both.exit_code, 2);
  EXPECT_TRUE(both.says("has commands for r2 too")) << both;
  EXPECT_EQ(cell_.ask({"hold", "r9"}).exit_code, 2);
  const Outcome events = cell_.ask({"run", scratch_.file("events.yaml", table_4_4() + "events:\n  - {at: 1, hold: r1}\n")});
  EXPECT_EQ(events.exit_code, 2);
  EXPECT_TRUE(events.says("only interlace-sim plays them")) << events;
  EXPECT_EQ(view_.executions(ExecutionState::started), 0u);
}

TEST_F(Control, DeadlinesAreReported) {
  ASSERT_TRUE(cell_.start());
  const Outcome met = outcome(cell_.send("r1", "met", {300, 250, 330}, {"--deadline", "60", "--json"}));
  ASSERT_EQ(met.exit_code, 0) << met;
  EXPECT_EQ(nlohmann::json::parse(met.output)["deadline_verdict"], "met");
  const Outcome impossible = outcome(cell_.send("r1", "soon", {450, 250, 300}, {"--deadline", "0.01"}));
  EXPECT_EQ(impossible.exit_code, 0) << "it is carried out all the same\n" << impossible;
  EXPECT_TRUE(impossible.says("(deadline: impossible)") && impossible.says("cannot be done within 0.01 s")) << impossible;
}

}  // namespace
}  // namespace interlace::test
