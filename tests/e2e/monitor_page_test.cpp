// The page of interlace-monitor in a real browser, beside a running cell. What it looks at is in monitor/web/test/browser; the pictures it
// takes stay in the build folder, under screenshots.
#include <gtest/gtest.h>

#include <iostream>
#include <nlohmann/json.hpp>

#include "tests/e2e/running_cell.hpp"

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

}  // namespace
}  // namespace interlace::test
