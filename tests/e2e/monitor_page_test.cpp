// The page of interlace-monitor in a real browser, beside a running cell. What it looks at is in monitor/web/test/browser; the pictures it
// takes stay in the build folder, under screenshots.
#include <gtest/gtest.h>

#include <iostream>
#include <nlohmann/json.hpp>

#include "tests/e2e/running_cell.hpp"
#include "tests/e2e/scratch.hpp"

namespace interlace::test {
namespace {

constexpr auto kBrowserPatience = 100s;  // on a busy machine without a graphics card

TEST(MonitorPage, ShowsExperiment62AsItHappens) {
  RunningCell cell{unique_domain(), "exp-6-2", deployed("exp-6-2/cell.yaml")};
  cell.start_planner();
  for (const char* robot : {"r1", "r2", "r3", "r4"}) cell.start_proxy(robot);
  for (const char* robot : {"r1", "r2", "r3", "r4"}) ASSERT_TRUE(cell.knows(robot));
  const std::string url = cell.start_monitor();
  ASSERT_FALSE(url.empty());

  Process looker{{INTERLACE_NODE, INTERLACE_PAGE_TESTS "/live_run.js", INTERLACE_CHROMIUM, url, INTERLACE_SCREENSHOTS}, true};
  ASSERT_TRUE(looker.logs("page loaded", kBrowserPatience)) << outcome(looker, 1ms);
  (void)cell.client({"run", deployed("exp-6-2/program.yaml")});
  const Outcome seen = outcome(looker, kBrowserPatience);
  ASSERT_EQ(seen.exit_code, 0) << seen;
  std::cout << seen.output;

  // The planner itself gave the reason that the page shows.
  const auto waiting = nlohmann::json::parse(seen.output)["waiting"];
  const auto text = [&](const char* key) { return waiting[key].get<std::string>(); };
  const std::string reason = text("robot") + "'s " + text("link") + " would meet " + text("blocker") + "'s " + text("blocker_link");
  EXPECT_NE(cell.planner().errors().find(reason), std::string::npos) << reason;
}

TEST(MonitorPage, PlaysARecording) {
  const Scratch scratch;
  const std::string file = scratch.path("run.mcap");
  const Outcome simulated = run({kSim, deployed("exp-4-2/cell.yaml"), deployed("exp-4-2/program.yaml"), "--record", file});
  ASSERT_EQ(simulated.exit_code, 0) << simulated;
  Process monitor{{kMonitor, "--recording", file, "--port", "0"}, true};
  ASSERT_TRUE(monitor.logs("info monitor ready", kPatience)) << outcome(monitor, 1ms);
  const std::string url = monitor.output().substr(0, monitor.output().find('\n'));
  const Outcome seen =
      run({INTERLACE_NODE, INTERLACE_PAGE_TESTS "/recording_run.js", INTERLACE_CHROMIUM, url, INTERLACE_SCREENSHOTS}, kBrowserPatience);
  EXPECT_EQ(seen.exit_code, 0) << seen;
  monitor.kill(SIGTERM);
  EXPECT_EQ(monitor.wait(kPatience), 0);
}

TEST(MonitorPage, RefusesARecordingThatCannotBePlayed) {
  const Outcome none = run({kMonitor, "--recording", deployed("exp-4-2/cell.yaml")});
  EXPECT_EQ(none.exit_code, 2) << none;
  EXPECT_TRUE(none.says("byte 0: not an MCAP file")) << none;
  EXPECT_EQ(run({kMonitor}).exit_code, 2);
}

}  // namespace
}  // namespace interlace::test
