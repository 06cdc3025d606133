#include "simulator/flow.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/support/motions.hpp"
#include "tests/unit/simulator/cells.hpp"

/// Arrivals over time and what flow times come of them.
namespace interlace::sim {
namespace {

model::Program program_of(std::size_t robots, std::size_t commands) {
  model::Program program;
  for (std::size_t i = 0; i < robots; ++i) {
    program.robots.emplace_back(model::RobotName{"r" + std::to_string(i + 1)}, std::vector<model::ProgramStep>(commands));
  }
  return program;
}

TEST(Arrivals, AreAPoissonProcessOfTheRateThatIsAskedFor) {
  constexpr double kRate = 0.5;
  constexpr std::size_t kRobots = 4, kCommands = 5000;
  const auto program = with_arrivals(program_of(kRobots, kCommands), kRate, 7);
  for (const auto& entry : program.robots) {
    const auto& steps = entry.second;
    double before = 0, sum = 0, squares = 0;
    for (const auto& step : steps) {
      const double gap = step.at - before;
      ASSERT_GE(gap, 0);
      sum += gap;
      squares += gap * gap;
      before = step.at;
    }
    const double mean = sum / kCommands;
    const double deviation = std::sqrt(squares / kCommands - mean * mean);
    EXPECT_NEAR(mean, kRobots / kRate, 4 * kRobots / kRate / std::sqrt(kCommands)) << "four standard errors";
    EXPECT_NEAR(deviation / mean, 1, 0.1) << "of an exponential distribution both are the same";
  }
}

TEST(Arrivals, AreTheSameForASeedAndOthersForAnother) {
  const auto a = with_arrivals(program_of(2, 10), 1, 3), b = with_arrivals(program_of(2, 10), 1, 3),
             c = with_arrivals(program_of(2, 10), 1, 4);
  EXPECT_EQ(a.robots[0].second[9].at, b.robots[0].second[9].at);
  EXPECT_NE(a.robots[0].second[9].at, c.robots[0].second[9].at);
  EXPECT_NE(a.robots[0].second[0].at, a.robots[1].second[0].at) << "robots are independent";
  const auto twice = with_arrivals(program_of(2, 10), 2, 3);
  EXPECT_NEAR(twice.robots[0].second[9].at, a.robots[0].second[9].at / 2, 1e-9);
}

FlowOptions small() {
  FlowOptions options;
  options.cell = test::deployed_cell("pattern-serial-3");
  options.resolution = 0.05;
  options.strategies = {"event", "acm"};
  options.loads = {0.3, 0.9};
  options.programs = 2;
  options.per_robot = 8;
  return options;
}

TEST(Flow, GrowsWithTheLoadAndIsNeverShorterThanTheMotion) {
  FlowOptions options = small();
  std::size_t told = 0;
  options.progress = [&](const FlowProgress& p) {
    ++told;
    EXPECT_EQ(p.runs, told);
    EXPECT_EQ(p.runs_in_all, 10u);
  };
  const auto report = measure_flow(options);
  ASSERT_TRUE(report) << report.error();
  EXPECT_EQ(told, 10u);
  EXPECT_GT(report->throughput, 0);
  ASSERT_EQ(report->rows.size(), 4u);
  for (const FlowRow& row : report->rows) {
    EXPECT_EQ(row.submitted, 48u);
    EXPECT_EQ(row.collisions, 0u);
    EXPECT_GT(row.mean, 0);
    EXPECT_LE(row.mean, row.p95);
    EXPECT_LE(row.p95, row.longest);
    EXPECT_DOUBLE_EQ(row.rate, row.load * report->throughput);
  }
  EXPECT_EQ(report->rows[0].strategy, "event");
  EXPECT_EQ(report->rows[0].load, 0.3);
  EXPECT_EQ(report->rows[2].strategy, "event");
  EXPECT_LT(report->rows[0].mean, report->rows[2].mean);
  EXPECT_EQ(report->rows[0].completed, 48u);
  EXPECT_EQ(to_json(*report)["rows"].size(), 4u);
  EXPECT_NE(table(*report).find("| acm |"), std::string::npos) << table(*report);
}

TEST(Flow, DoesNotDependOnTheNumberOfThreads) {
  FlowOptions options = small();
  const auto one = measure_flow(options);
  options.jobs = 3;
  const auto three = measure_flow(options);
  ASSERT_TRUE(one && three);
  EXPECT_EQ(to_json(*one), to_json(*three));
}

TEST(Flow, EndsWhenToldTo) {
  FlowOptions options = small();
  int asked = 0;
  options.stop = [&] { return ++asked > 3; };
  const auto report = measure_flow(options);
  ASSERT_TRUE(report);
  EXPECT_TRUE(report->stopped);
  EXPECT_TRUE(report->rows.empty());
}

}  // namespace
}  // namespace interlace::sim
