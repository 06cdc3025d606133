#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/e2e/cells.hpp"
#include "tests/e2e/running_cell.hpp"
#include "tests/e2e/scratch.hpp"
#include "tests/e2e/view.hpp"

// Processes that come late, twice, with the wrong file, or not at all. Nobody else is disturbed.
namespace interlace::test {
namespace {

using model::CommandState;
using model::ExecutionState;

class Disturbance : public ::testing::Test {
 protected:
  [[nodiscard]] bool standby() const {
    if (!view_.planner()) return false;
    for (const auto& robot : view_.planner()->robots) {
      if (robot.mode != model::RobotMode::standby || robot.queued > 0) return false;
    }
    return true;
  }

  Scratch scratch_;
  RunningCell cell_{unique_domain(), "fast", scratch_.file("cell.yaml", cell_text())};
  View view_{unique_domain(), "fast"};
};

TEST_F(Disturbance, AClientThatIsGoneLeavesItsCommandsToComplete) {
  ASSERT_TRUE(cell_.start());
  Process& client = cell_.client({"run", scratch_.file("program.yaml", table_4_4())});
  ASSERT_TRUE(view_.until([&] { return view_.planner() && view_.planner()->accepted == 8 && view_.moving("r1"); }));
  client.kill(SIGKILL);
  ASSERT_LT(view_.planner()->completed, 8u);
  EXPECT_TRUE(view_.until([&] { return view_.planner()->completed == 8; })) << view_.planner()->completed;
  EXPECT_TRUE(view_.until([&] { return standby(); }));
  const Outcome status = cell_.ask({"status", "--json"});
  ASSERT_EQ(status.exit_code, 0) << status;
  const auto json = nlohmann::json::parse(status.output);
  EXPECT_EQ(json["completed"], 8);
  EXPECT_EQ(json["rejected"], 0);
}

TEST_F(Disturbance, CommandsWaitForAProxyThatStartsLateAndSayForWhich) {
  cell_.start_planner();
  cell_.start_proxy("r1");
  ASSERT_TRUE(cell_.knows("r1"));
  Process& late = cell_.send("r2", "for-r2", {300, -250, 330});
  Process& beside = cell_.send("r1", "for-r1", {300, 250, 330});
  const auto waits_because = [&](const std::string& id, model::Reason reason) {
    const auto* status = view_.status(id);
    return status != nullptr && status->state == CommandState::waiting && status->reason == reason;
  };
  ASSERT_TRUE(view_.until([&] { return waits_because("for-r2", model::Reason::not_ready); }));
  ASSERT_TRUE(view_.until([&] { return waits_because("for-r1", model::Reason::robot_unknown); })) << "it would move where r2 could be";
  EXPECT_NE(view_.status("for-r2")->text.find("r2 is not heard from"), std::string::npos) << view_.status("for-r2")->text;
  EXPECT_NE(view_.status("for-r1")->text.find("r2 is not heard from"), std::string::npos) << view_.status("for-r1")->text;
  EXPECT_EQ(view_.executions(ExecutionState::started), 0u);
  const Outcome told = cell_.ask({"status"});
  EXPECT_TRUE(told.says("r2 is not heard from")) << told;

  cell_.start_proxy("r2");
  for (Process* client : {&late, &beside}) {
    const Outcome o = outcome(*client);
    EXPECT_EQ(o.exit_code, 0) << o;
  }
  EXPECT_NE(late.errors().find("waiting: not_ready"), std::string::npos) << "the client is told that it waits\n" << late.errors();
}

TEST_F(Disturbance, TheSameIdTwiceIsAnsweredTwiceAndExecutedOnce) {
  ASSERT_TRUE(cell_.start());
  Process& first = cell_.send("r1", "once", {300, 250, 330});
  Process& second = cell_.send("r1", "once", {300, 250, 330});
  for (Process* client : {&first, &second}) {
    const Outcome o = outcome(*client);
    EXPECT_EQ(o.exit_code, 0) << o;
    EXPECT_TRUE(o.says("once completed")) << o;
  }
  const Outcome third = outcome(cell_.send("r1", "once", {400, 250, 330}));  // even with another target
  EXPECT_EQ(third.exit_code, 0) << third;
  EXPECT_TRUE(third.says("once completed")) << third;
  ASSERT_TRUE(view_.until([&] { return view_.planner() && view_.planner()->completed == 1; }));
  EXPECT_EQ(view_.planner()->accepted, 1u);
  EXPECT_EQ(view_.executions(ExecutionState::started), 1u);
  EXPECT_TRUE(view_.until([&] { return view_.stands_at("r1", {0.3, 0.25, 0.33}); }));
}

TEST_F(Disturbance, ASecondProxyOfARobotIsIgnored) {
  ASSERT_TRUE(cell_.start());
  Process& first = cell_.proxy("r1");
  Process& second = cell_.start_proxy("r1");
  ASSERT_TRUE(cell_.planner().logs("another proxy of this robot", kPatience));
  const Outcome o = cell_.ask({"run", scratch_.file("program.yaml", table_4_4())}, 30s);
  EXPECT_EQ(o.exit_code, 0) << o;
  EXPECT_EQ(Process::count(second.errors(), " starting "), 0u) << second.errors();
  EXPECT_EQ(Process::count(first.errors(), " starting "), 4u) << first.errors();
  EXPECT_EQ(view_.executions(ExecutionState::started), 0u) << "nobody listened yet";
  ASSERT_TRUE(view_.until([&] { return view_.planner() && view_.planner()->completed == 8; }));
  EXPECT_EQ(view_.executions(ExecutionState::started), 8u);
}

TEST_F(Disturbance, AProxyWithAnotherCellFileIsRefusedAndMovesNothing) {
  CellText other;
  other.velocity = 400;
  cell_.start_planner();
  cell_.start_proxy("r1");
  Process& wrong = cell_.start_proxy("r2", scratch_.file("other.yaml", cell_text(other)));
  ASSERT_TRUE(cell_.planner().logs("proxy_ignored robot=r2 why=\"its cell file differs from the planner's\"", kPatience));
  ASSERT_TRUE(wrong.logs("planner_ignored robot=r2 why=\"its cell file differs from the proxy's\"", kPatience));
  EXPECT_NE(cell_.planner().errors().find(" error planner proxy_ignored"), std::string::npos);
  EXPECT_NE(wrong.errors().find(" error proxy planner_ignored"), std::string::npos);

  Process& client = cell_.send("r2", "never", {300, -250, 330}, {"--no-wait"});
  const Outcome o = outcome(client);
  EXPECT_EQ(o.exit_code, 0) << "taken, it waits\n" << o;
  ASSERT_TRUE(view_.until([&] { return view_.reached("never", CommandState::waiting); }));
  EXPECT_EQ(view_.status("never")->reason, model::Reason::not_ready);

  // The right proxy in its place: the command goes on.
  wrong.kill(SIGTERM);
  EXPECT_EQ(wrong.wait(kPatience), 0);
  EXPECT_EQ(Process::count(wrong.errors(), " starting "), 0u);
  cell_.start_proxy("r2");
  EXPECT_TRUE(view_.until([&] { return view_.reached("never", CommandState::completed); }));
}

TEST_F(Disturbance, AnUnreachableTargetIsRejectedWithItsPlaceAndTheOthersGoOn) {
  ASSERT_TRUE(cell_.start());
  const std::string report = scratch_.path("report.json");
  const std::string program = scratch_.file(
      "far.yaml", program_text({linear(300, 250, 330), linear(300, 2000, 330), linear(400, 250, 330)}, {linear(300, -250, 330)}));
  const Outcome o = cell_.ask({"run", program, "--report", report}, 30s);
  EXPECT_EQ(o.exit_code, 1) << o;
  const auto r = nlohmann::json::parse(read_text(report)).at(0);
  EXPECT_EQ(r["completed"], 3);
  EXPECT_EQ(r["rejected"], 1);
  bool found = false;
  for (const auto& c : r["commands"]) {
    if (c["state"] != "rejected") continue;
    found = true;
    EXPECT_EQ(c["reason"], "unreachable");
    EXPECT_NE(c["explanation"].get<std::string>().find("% of the path"), std::string::npos) << "where? " << c["explanation"];
  }
  EXPECT_TRUE(found);
  EXPECT_TRUE(o.says("rejected")) << o;
}

TEST_F(Disturbance, AnUnknownRobotInAProgramIsFoundBeforeAnythingMoves) {
  ASSERT_TRUE(cell_.start());
  std::string program = program_text({linear(300, 250, 330)}, {linear(300, -250, 330)});
  program.replace(program.find("  r2:"), 5, "  r3:");
  const Outcome o = cell_.ask({"run", scratch_.file("program.yaml", program)});
  EXPECT_EQ(o.exit_code, 2) << o;
  EXPECT_TRUE(o.says("unknown robot \"r3\"")) << o;
  const Outcome sent = outcome(cell_.send("r3", "x", {300, 250, 330}));
  EXPECT_EQ(sent.exit_code, 2) << sent;
  EXPECT_TRUE(sent.says("unknown robot \"r3\"")) << sent;
  ASSERT_TRUE(view_.until([&] { return view_.planner().has_value(); }));
  EXPECT_EQ(view_.planner()->accepted, 0u);
  EXPECT_EQ(view_.executions(ExecutionState::accepted), 0u);
}

// The newest state of a planner comes at once, the news that it lives may come later: status must not call it silent in between.
TEST_F(Disturbance, StatusNeverCallsALivingPlannerSilent) {
  ASSERT_TRUE(cell_.start());
  for (int i = 0; i < 20; ++i) {
    const Outcome o = cell_.ask({"status", "--json"});
    ASSERT_EQ(o.exit_code, 0) << o;
    EXPECT_EQ(nlohmann::json::parse(o.output)["alive"], true) << i;
  }
}

TEST_F(Disturbance, WithoutAPlannerAClientSaysSoInTime) {
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"run", scratch_.file("program.yaml", table_4_4()), "--timeout", "0.5"}, {"status", "--timeout", "0.5"}}) {
    const Outcome o = cell_.ask(arguments);
    EXPECT_EQ(o.exit_code, 4) << o;
    EXPECT_TRUE(o.says("no planner of cell fast was heard")) << o;
  }
}

}  // namespace
}  // namespace interlace::test
