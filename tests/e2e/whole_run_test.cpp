#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "tests/e2e/cells.hpp"
#include "tests/e2e/running_cell.hpp"
#include "tests/e2e/scratch.hpp"
#include "tests/e2e/view.hpp"

// The main job: planner, proxies, observer and client as processes, from the first command to the report.
namespace interlace::test {
namespace {

/// What came of one run of a program under the eyes of an observer.
struct Observed {
  Outcome run, watch;
  nlohmann::json report;     // of the run
  nlohmann::json clearance;  // of the observer
};

/// Runs `program` on a cell that was not started yet.
Observed observe(RunningCell& cell, const std::string& program, const Scratch& scratch, std::chrono::milliseconds patience,
                 const std::vector<std::string>& planner_options = {}) {
  const std::string report = scratch.path(cell.name() + "-report.json");
  const std::string clearance = scratch.path(cell.name() + "-clearance.json");
  Observed o;
  Process& watch = cell.watch(clearance);
  if (!cell.start(planner_options)) {
    ADD_FAILURE() << "the planner does not come to know the robots";
    return o;
  }
  o.run = cell.ask({"run", program, "--report", report}, patience);
  watch.kill(SIGTERM);
  o.watch = outcome(watch);
  o.report = nlohmann::json::parse(read_text(report), nullptr, false);
  o.clearance = nlohmann::json::parse(read_text(clearance), nullptr, false);
  EXPECT_FALSE(o.report.is_discarded()) << "no report\n" << o.run;
  EXPECT_FALSE(o.clearance.is_discarded()) << "no report\n" << o.watch;
  return o;
}

const nlohmann::json& first_of(const nlohmann::json& report) {
  return report.is_array() ? report.at(0) : report;
}

TEST(WholeRun, Experiment42DoubledTouchesNothingAndEndsInTime) {
  const Scratch scratch;
  RunningCell cell{unique_domain(), "exp-4-2", deployed("exp-4-2/cell.yaml")};
  const Observed o = observe(cell, deployed("exp-4-2/program.yaml"), scratch, 60s);
  ASSERT_FALSE(HasFailure());
  EXPECT_EQ(o.run.exit_code, 0) << o.run;
  EXPECT_EQ(o.watch.exit_code, 0) << o.watch;
  EXPECT_GT(o.clearance["min_clearance_m"], 0);
  EXPECT_EQ(o.clearance["below_zero_s"], 0);

  ASSERT_TRUE(o.report.is_array());
  const auto& r = o.report.at(0);
  EXPECT_EQ(r["strategy"], "event");
  EXPECT_EQ(r["submitted"], 16);
  EXPECT_EQ(r["completed"], 16);
  EXPECT_EQ(r["rejected"], 0);
  EXPECT_EQ(r["unserved"], 0);
  for (const char* field : {"escapes", "warnings", "collisions", "min_clearance_m", "map_build_ms", "decision_ms"}) {
    EXPECT_TRUE(r.contains(field)) << field;
  }
  ASSERT_EQ(r["commands"].size(), 16u);
  double first = 1e9;
  double last = 0;
  std::size_t delayed = 0;
  for (const auto& c : r["commands"]) {
    for (const char* field : {"id", "robot", "origin", "release_s", "start_s", "end_s", "delay_s", "reason"}) {
      EXPECT_TRUE(c.contains(field)) << field;
    }
    first = std::min(first, c["start_s"].get<double>());
    last = std::max(last, c["end_s"].get<double>());
    if (c["reason"] != "delayed") continue;
    ++delayed;
    EXPECT_FALSE(c["explanation"].get<std::string>().empty()) << "a delay without its evidence";
  }
  EXPECT_GT(delayed, 0u);
  EXPECT_LE(last - first, 30.5);
  EXPECT_NEAR(r["makespan_s"].get<double>(), last - first, 1e-6);
  EXPECT_GE(o.clearance["observed_s"].get<double>(), last - first) << "the observer missed a part";
}

TEST(WholeRun, DirectIsSeenToCollide) {
  const Scratch scratch;
  RunningCell cell{unique_domain(), "fast", scratch.file("cell.yaml", cell_text())};
  const Observed o = observe(cell, scratch.file("program.yaml", table_4_4()), scratch, 30s, {"--strategy", "direct"});
  ASSERT_FALSE(HasFailure());
  EXPECT_EQ(o.run.exit_code, 0) << "the client sees no clearances; all commands complete\n" << o.run;
  EXPECT_EQ(first_of(o.report)["strategy"], "direct");
  EXPECT_EQ(first_of(o.report)["completed"], 8);
  EXPECT_EQ(o.watch.exit_code, 3) << o.watch;
  EXPECT_LT(o.clearance["min_clearance_m"], 0);
  EXPECT_GT(o.clearance["below_zero_s"], 0.2);
  EXPECT_TRUE(o.watch.says("COLLISION")) << o.watch;
}

TEST(WholeRun, FastTouchesNothing) {
  const Scratch scratch;
  RunningCell cell{unique_domain(), "fast", scratch.file("cell.yaml", cell_text())};
  const Observed o = observe(cell, scratch.file("program.yaml", table_4_4(2)), scratch, 40s);
  ASSERT_FALSE(HasFailure());
  EXPECT_EQ(o.run.exit_code, 0) << o.run;
  EXPECT_EQ(first_of(o.report)["completed"], 16);
  EXPECT_EQ(o.watch.exit_code, 0) << o.watch;
  EXPECT_GT(o.clearance["min_clearance_m"], 0);
}

TEST(WholeRun, LateAndJitteryControllersTouchNothing) {
  const Scratch scratch;
  CellText text;
  text.name = "late";
  text.controller = "{start_latency: 0.02, start_jitter: 0.01}";
  RunningCell cell{unique_domain(), "late", scratch.file("cell.yaml", cell_text(text))};
  const Observed o = observe(cell, scratch.file("program.yaml", table_4_4(2)), scratch, 40s);
  ASSERT_FALSE(HasFailure());
  EXPECT_EQ(o.run.exit_code, 0) << o.run;
  EXPECT_EQ(first_of(o.report)["completed"], 16);
  EXPECT_EQ(o.watch.exit_code, 0) << o.watch;
  EXPECT_GT(o.clearance["min_clearance_m"], 0);
}

// The client's own observer: one program for those who want one.
TEST(WholeRun, TheClientWatchesTheClearanceWhenItHasTheCellFile) {
  const Scratch scratch;
  RunningCell cell{unique_domain(), "fast", scratch.file("cell.yaml", cell_text())};
  ASSERT_TRUE(cell.start({"--strategy", "direct"}));
  const std::string report = scratch.path("report.json");
  const Outcome o = cell.ask({"run", scratch.file("program.yaml", table_4_4()), "--cell-file", cell.file(), "--report", report}, 30s);
  EXPECT_EQ(o.exit_code, 3) << o;
  const auto json = nlohmann::json::parse(read_text(report));
  EXPECT_LT(first_of(json)["min_clearance_m"], 0);
  EXPECT_GT(first_of(json)["collisions"], 0);
}

TEST(SideBySide, TwoCellsInOneDomainBothComplete) {
  const Scratch scratch;
  std::vector<std::unique_ptr<RunningCell>> cells;
  const std::string program = scratch.file("program.yaml", table_4_4());
  for (const std::string name : {"left", "right"}) {
    CellText text;
    text.name = name;
    cells.push_back(std::make_unique<RunningCell>(unique_domain(), name, scratch.file(name + ".yaml", cell_text(text))));
  }
  for (auto& cell : cells) ASSERT_TRUE(cell->start());
  std::vector<Process*> clients;
  for (auto& cell : cells) clients.push_back(&cell->client({"run", program, "--report", scratch.path(cell->name() + ".json")}));
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const Outcome o = outcome(*clients[i], 40s);
    EXPECT_EQ(o.exit_code, 0) << cells[i]->name() << '\n' << o;
    EXPECT_EQ(first_of(nlohmann::json::parse(read_text(scratch.path(cells[i]->name() + ".json"))))["completed"], 8);
  }
}

TEST(SideBySide, TwoCopiesOfACellInTwoDomainsBothComplete) {
  const Scratch scratch;
  const std::string file = scratch.file("cell.yaml", cell_text());
  const std::string program = scratch.file("program.yaml", table_4_4());
  const Domain first;
  const Domain second;
  ASSERT_NE(first.id(), second.id());
  RunningCell a{first.id(), "fast", file};
  RunningCell b{second.id(), "fast", file};
  ASSERT_TRUE(a.start());
  ASSERT_TRUE(b.start());
  View view_a{first.id(), "fast"};
  View view_b{second.id(), "fast"};
  Process& client_a = a.client({"run", program});
  Process& client_b = b.client({"run", program});
  for (Process* client : {&client_a, &client_b}) {
    const Outcome o = outcome(*client, 40s);
    EXPECT_EQ(o.exit_code, 0) << o;
  }
  // Each did its own work and none of the other's.
  for (View* view : {&view_a, &view_b}) {
    EXPECT_TRUE(view->until([&] { return view->planner() && view->planner()->completed == 8; }));
    EXPECT_EQ(view->planner()->accepted, 8u);
  }
}

}  // namespace
}  // namespace interlace::test
