#include "simulator/campaign.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/seed.hpp"
#include "tests/unit/simulator/cells.hpp"

namespace interlace::sim {
namespace {

CampaignOptions campaign(const std::string& strategy, std::size_t commands, const std::string& kind = "pattern") {
  CampaignOptions options;
  for (const char* pattern : {"-triangle-3", "-serial-4", "-square-4"}) {
    const std::string name = kind + pattern;
    options.cells.push_back({name, test::deployed_cell(name)});
  }
  options.strategy = strategy;
  options.commands = test::scaled(commands);
  options.per_robot = 5;
  options.resolution = 0.05;  // coarse: faster, and as safe
  options.jobs = 2;
  return options;
}

std::size_t collisions(const CampaignReport& report) {
  std::size_t n = 0;
  for (const auto& row : report.rows) n += row.collisions;
  return n;
}

TEST(Campaign, WithoutAPlannerRobotsCollide) {
  const auto report = run_campaign(campaign("direct", 300));
  EXPECT_GT(collisions(report), 0U) << "the judges see nothing, or the programs do not compete";
  for (const auto& row : report.rows) EXPECT_EQ(row.total.completed, row.total.submitted) << row.cell;
  ASSERT_FALSE(report.failing.empty());
  EXPECT_NE(summary(report, 1).find(command_line(report, report.failing.front())), std::string::npos);
}

TEST(Campaign, WithThePlannerNothingTouchesAndNothingIsLost) {
  const auto report = run_campaign(campaign("event", 300));
  EXPECT_EQ(collisions(report), 0U) << summary(report, 10);
  for (const auto& row : report.rows) {
    EXPECT_EQ(row.total.completed, row.total.submitted) << row.cell << '\n' << summary(report, 10);
    EXPECT_EQ(row.total.lost, 0U) << row.cell;
    EXPECT_EQ(row.total.fruitless_rounds, 0U) << row.cell;
    EXPECT_EQ(row.total.warnings, 0U) << row.cell;
    EXPECT_EQ(row.total.contradicted, 0U) << row.cell;
    EXPECT_GT(row.nearest.clearance, 0) << row.cell;
  }
}

TEST(Campaign, AmongFixturesNothingTouchesThemEither) {
  EXPECT_GT(collisions(run_campaign(campaign("direct", 100, "fixtures"))), 0U) << "the robots keep to themselves: this would show nothing";
  const auto report = run_campaign(campaign("event", 150, "fixtures"));
  EXPECT_EQ(collisions(report), 0U) << summary(report, 10);
  for (const auto& row : report.rows) {
    EXPECT_EQ(row.total.completed, row.total.submitted) << row.cell << '\n' << summary(report, 10);
    EXPECT_EQ(row.total.fruitless_rounds, 0U) << row.cell;
    EXPECT_GT(row.nearest.clearance, 0) << row.cell;
  }
}

/// Programs in which a planner with fewer ways out left commands unserved, or rejected one that an escape had made impossible.
TEST(Campaign, WhatWasOnceLeftUnservedIsServed) {
  const std::vector<std::pair<const char*, std::uint64_t>> programs{
      {"pattern-serial-4", 59},                                // the commanded robot must step aside
      {"pattern-triangle-3", 5294},                            // home by the joints: the straight way touches the robot itself
      {"pattern-zigzag-4", 5063},                              // likewise, for the robot that steps aside
      {"pattern-zigzag-4", 5071},                              // stepping aside needs room itself
      {"pattern-square-4", 262},                               // an escape winds a joint up, and a later command runs into its limit
      {"pattern-triangle-3", 183},  {"pattern-ring-5", 5288},  // five arms in a tangle that comes apart only in a certain order
  };
  for (const auto& [cell, seed] : programs) {
    CampaignOptions options;
    options.cells = {{cell, test::deployed_cell(cell)}};
    options.commands = 1;
    options.per_robot = 10;
    options.seed = seed;
    const auto report = run_campaign(options);
    EXPECT_TRUE(report.failing.empty()) << summary(report, 1);
  }
}

TEST(Campaign, DoesNotDependOnHowManyRunAtOnce) {
  auto options = campaign("event", 100);
  options.jobs = 1;
  const auto one = to_json(run_campaign(options));
  options.jobs = 3;
  EXPECT_EQ(one.dump(), to_json(run_campaign(options)).dump());
}

TEST(Campaign, AFailingProgramRunsAgainAlone) {
  const auto all = run_campaign(campaign("direct", 100));
  ASSERT_FALSE(all.failing.empty());
  const CampaignRun& last = all.failing.back();
  auto options = campaign("direct", 1);
  options.cells = {options.cells[last.cell]};
  options.commands = 1;
  options.seed = last.seed;
  const auto again = run_campaign(options);
  ASSERT_EQ(again.failing.size(), 1U);
  EXPECT_EQ(again.failing.front().collisions, last.collisions);
  EXPECT_EQ(again.failing.front().nearest.clearance, last.nearest.clearance);
}

TEST(Campaign, StopsWhenTold) {
  auto options = campaign("direct", 100'000);
  options.commands = 100'000;
  options.stop = [] { return true; };
  const auto report = run_campaign(options);
  EXPECT_TRUE(report.stopped);
  EXPECT_TRUE(report.failing.empty());
}

TEST(Campaign, RefusesAnUnknownStrategyAndNoCells) {
  EXPECT_THROW((void)run_campaign(campaign("hope", 1)), std::invalid_argument);
  EXPECT_THROW((void)run_campaign(CampaignOptions{}), std::invalid_argument);
}

}  // namespace
}  // namespace interlace::sim
