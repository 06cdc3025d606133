#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tests/e2e/cells.hpp"
#include "tests/e2e/running_cell.hpp"
#include "tests/e2e/scratch.hpp"
#include "tests/e2e/view.hpp"

// A robot with nothing to do stands where another one has to go: it is sent out of the way, or people are told why it cannot be and clear
// the place themselves.
namespace interlace::test {
namespace {

using model::CommandState;
using model::Reason;

constexpr std::array<int, 3> kMiddle{350, 0, 200};  // both reach it, but not at once

class Deadlock : public ::testing::Test {
 protected:
  RunningCell& start(const CellText& text) {
    cell_.emplace(unique_domain(), "fast", scratch_.file("cell.yaml", cell_text(text)));
    view_.emplace(unique_domain(), "fast");
    EXPECT_TRUE(cell_->start());
    return *cell_;
  }

  /// The newest status of an escape that serves `id`; null when there is none.
  [[nodiscard]] const model::CommandStatus* escape_for(const std::string& id) const {
    const auto& all = view_->statuses();
    const auto found = std::find_if(all.rbegin(), all.rend(), [&](const auto& s) { return s.escape && s.serves.str() == id; });
    return found == all.rend() ? nullptr : &*found;
  }

  /// What `interlace status --json` says of r1 now.
  [[nodiscard]] nlohmann::json r1_in_status() {
    const Outcome o = cell_->ask({"status", "--json"});
    EXPECT_EQ(o.exit_code, 0) << o;
    const auto json = nlohmann::json::parse(o.output, nullptr, false);
    if (json.is_discarded()) return nullptr;
    for (const auto& robot : json["robots"]) {
      if (robot["name"] == "r1") return robot;
    }
    return nullptr;
  }

  /// True once the planner's state, which follows the statuses, gives `reason` for r1.
  [[nodiscard]] bool state_says(Reason reason) {
    return view_->until([&] { return view_->planner() && view_->planner()->robots.at(0).reason == reason; });
  }

  Scratch scratch_;
  std::optional<RunningCell> cell_;
  std::optional<View> view_;
};

TEST_F(Deadlock, AnIdleBlockerIsSentOutOfTheWay) {
  RunningCell& cell = start({});
  Process& watch = cell.client({"watch", "--json", "--rate", "50"});
  ASSERT_EQ(outcome(cell.send("r2", "parked", kMiddle)).exit_code, 0);
  const Outcome sent = outcome(cell.send("r1", "through", kMiddle));
  EXPECT_EQ(sent.exit_code, 0) << sent;
  EXPECT_TRUE(sent.says(" for through  scheduled: escape: r2 goes ")) << "the escape is shown as such, with the command it serves\n"
                                                                      << sent;
  ASSERT_TRUE(view_->until([&] { return escape_for("through") != nullptr && view_->reached("through", CommandState::completed); }));
  const model::CommandStatus escape = *escape_for("through");
  EXPECT_EQ(escape.robot.str(), "r2");
  EXPECT_EQ(escape.id.str().rfind("escape-", 0), 0u) << escape.id.str();
  EXPECT_TRUE(view_->until([&] { return view_->executions(model::ExecutionState::completed, escape.id.str()) == 1; }));
  EXPECT_TRUE(cell.planner().logs("escape=" + escape.id.str() + " serves=through", kPatience));
  EXPECT_TRUE(view_->until([&] { return watch.output().find("\"serves\":\"through\"") != std::string::npos; }));

  // Its id belongs to the planner.
  const Outcome again = cell.ask({"send", "--id", escape.id.str(), "r2", "linear", "300", "-250", "330", "0", "0", "0"});
  EXPECT_EQ(again.exit_code, 2) << again;
  EXPECT_TRUE(again.says("escape of the planner for through")) << again;
  const Outcome cancelled = cell.ask({"cancel", "r2", escape.id.str()});
  EXPECT_EQ(cancelled.exit_code, 1) << cancelled;
  EXPECT_TRUE(cancelled.says("is an escape of the planner")) << cancelled;
}

TEST_F(Deadlock, TheReportOfARunHasItsEscapes) {
  RunningCell& cell = start({});
  ASSERT_EQ(outcome(cell.send("r2", "parked", kMiddle)).exit_code, 0);
  const std::string report = scratch_.path("report.json");
  const Outcome o = cell.ask({"run", scratch_.file("program.yaml", program_text({linear(350, 0, 200)}, {})), "--report", report});
  EXPECT_EQ(o.exit_code, 0) << o;
  const auto r = nlohmann::json::parse(read_text(report)).at(0);
  EXPECT_EQ(r["completed"], 1);
  ASSERT_GE(r["escapes"], 1);
  EXPECT_EQ(r["warnings"], 0);
  ASSERT_GE(r["commands"].size(), 2u);
  EXPECT_TRUE(r["commands"][0]["serves"].is_null());
  EXPECT_EQ(r["commands"][1]["origin"], "escape");
  EXPECT_EQ(r["commands"][1]["robot"], "r2");
  EXPECT_EQ(r["commands"][1]["serves"], r["commands"][0]["id"]);
  EXPECT_TRUE(o.says("escape escape-")) << o;
}

TEST_F(Deadlock, IdsOfEscapesDifferBetweenPlanners) {
  RunningCell& cell = start({});
  std::vector<std::string> ids;
  for (const std::string id : {"first", "second"}) {
    ASSERT_EQ(outcome(cell.send("r1", id + "-aside", {450, 250, 300})).exit_code, 0);
    ASSERT_EQ(outcome(cell.send("r2", id + "-parked", kMiddle)).exit_code, 0);
    const Outcome sent = outcome(cell.send("r1", id, kMiddle));
    EXPECT_EQ(sent.exit_code, 0) << "the proxies remember the escapes of the planner before\n" << sent;
    ASSERT_TRUE(view_->until([&] { return escape_for(id) != nullptr; }));
    ids.push_back(escape_for(id)->id.str());
    if (ids.size() > 1) break;
    cell.planner().kill(SIGKILL);
    cell.start_planner();
    ASSERT_TRUE(cell.knows("r1") && cell.knows("r2"));
  }
  EXPECT_NE(ids[0], ids[1]);
}

// r2 turns about its base, and can do nothing else: it has no straight way out, and its home is where it stands.
TEST_F(Deadlock, APersonIsToldWhyNothingHelpsAndClearsThePlace) {
  CellText text;
  text.r2_start = "joints: [35, 40, 94, 0, -44, 0]";
  text.r2_joints =
      "{min: [-170, 39, 93, -1, -45, -1], max: [170, 41, 95, 1, -43, 1], velocity: [60, 60, 60, 60, 60, 60], "
      "acceleration: [300, 300, 300, 300, 300, 300]}";
  RunningCell& cell = start(text);
  const std::string report = scratch_.path("report.json");
  Process& run = cell.client({"run", scratch_.file("program.yaml", program_text({linear(350, 0, 200)}, {})), "--report", report});
  ASSERT_TRUE(state_says(Reason::deadlock));
  const auto r1 = r1_in_status();
  EXPECT_EQ(r1["reason"], "deadlock") << r1;
  ASSERT_FALSE(r1["conflicts"].empty()) << r1;
  EXPECT_EQ(r1["conflicts"][0]["blocker"], "r2");
  EXPECT_FALSE(r1["conflicts"][0]["link"].get<std::string>().empty());
  EXPECT_TRUE(r1["conflicts"][0]["until_s"].is_null()) << "r2 stays";
  ASSERT_GE(r1["refusals"].size(), 6u) << r1;
  for (const auto& refusal : r1["refusals"]) {
    EXPECT_EQ(refusal["robot"], "r2");
    EXPECT_FALSE(refusal["way"].get<std::string>().empty());
    EXPECT_FALSE(refusal["explanation"].get<std::string>().empty()) << refusal;
  }
  const Outcome status = cell.ask({"status"});
  EXPECT_TRUE(status.says("r2 cannot go +x: ")) << status;
  EXPECT_TRUE(cell.planner().logs("warning planner deadlock robot=r1", kPatience));
  EXPECT_TRUE(run.running());

  const Outcome cleared = cell.ask({"send", "r2", "joint", "--", "-40", "40", "94", "0", "-44", "0"});
  EXPECT_EQ(cleared.exit_code, 0) << cleared;
  const Outcome o = outcome(run);
  EXPECT_EQ(o.exit_code, 0) << o;
  EXPECT_TRUE(o.says("WARNING waiting: deadlock: ")) << o;
  EXPECT_TRUE(o.says("r2 cannot go -z: ")) << o;
  const auto r = nlohmann::json::parse(read_text(report)).at(0);
  EXPECT_EQ(r["completed"], 1);
  EXPECT_EQ(r["escapes"], 0);
  EXPECT_GE(r["warnings"], 1);
  EXPECT_GE(r["commands"][0]["refusals"].size(), 6u) << "the evidence of the warning outlives it";
}

TEST_F(Deadlock, WithoutEscapesTheBlockedWaitForPeople) {
  CellText text;
  text.escapes = false;
  RunningCell& cell = start(text);
  ASSERT_EQ(outcome(cell.send("r2", "parked", kMiddle)).exit_code, 0);
  Process& sent = cell.send("r1", "through", kMiddle);
  ASSERT_TRUE(state_says(Reason::blocked));
  const auto r1 = r1_in_status();
  ASSERT_FALSE(r1["conflicts"].empty()) << r1;
  EXPECT_EQ(r1["conflicts"][0]["blocker"], "r2");
  EXPECT_TRUE(r1["conflicts"][0]["until_s"].is_null()) << r1;
  EXPECT_TRUE(r1["refusals"].empty());
  EXPECT_TRUE(sent.running());
  ASSERT_EQ(outcome(cell.send("r2", "aside", {300, -250, 330})).exit_code, 0);
  const Outcome o = outcome(sent);
  EXPECT_EQ(o.exit_code, 0) << o;
  EXPECT_TRUE(std::none_of(view_->statuses().begin(), view_->statuses().end(), [](const auto& s) { return s.escape; }));
}

}  // namespace
}  // namespace interlace::test
