#include <gtest/gtest.h>

#include "simulator/reproduce/experiment_tables.hpp"
#include "simulator/reproduce/markdown.hpp"
#include "simulator/reproduce/patterns.hpp"
#include "tests/unit/reproduce/pictures.hpp"

namespace interlace::reproduce {
namespace {

StrategyRun fake(const std::string& strategy, double makespan, std::size_t completed, std::size_t collisions, double clearance) {
  StrategyRun run;
  run.report.strategy = strategy;
  run.report.makespan = makespan;
  run.report.submitted = 8;
  run.report.completed = completed;
  run.report.unserved = 8 - completed;
  run.report.escapes = 2;
  run.report.warnings = 1;
  run.report.collisions = collisions;
  run.report.least_clearance = clearance;
  return run;
}

TEST(Markdown, AlignsNumbersRightAndEscapesBars) {
  EXPECT_EQ(markdown_table({"a", "b"}, {{"x|y", "1.5"}, {"z", "-2"}}), "| a | b |\n|---|---:|\n| x\\|y | 1.5 |\n| z | -2 |\n");
  EXPECT_EQ(counted(0, "escape"), "no escapes");
  EXPECT_EQ(counted(1, "escape"), "1 escape");
  EXPECT_EQ(counted(2, "escape"), "2 escapes");
}

TEST(OutcomeTable, HasTheNumbersOfTheReport) {
  EXPECT_EQ(outcome_table({fake("event", 12.345, 8, 0, 0.0181)}),
            "| strategy | time [s] | completed | unserved | escapes | warnings | collisions | least clearance [mm] |\n"
            "|---|---:|---:|---:|---:|---:|---:|---:|\n"
            "| `event` | 12.35 | 8 of 8 | 0 | 2 | 1 | 0 | 18.1 |\n");
}

TEST(OutcomeTable, ComparesWithTheOptimumWhatWasDoneWithoutContact) {
  LeastTimes least;
  least.waiting.makespan = 12;
  const std::vector<StrategyRun> runs{fake("direct", 9, 8, 1, -0.01), fake("event", 12.345, 8, 0, 0.0181)};
  EXPECT_EQ(outcome_table(runs, least),
            "| strategy | time [s] | time / optimum | completed | unserved | escapes | warnings | collisions | least clearance [mm] |\n"
            "|---|---:|---:|---:|---:|---:|---:|---:|---:|\n"
            "| `direct` | 9.00 | – | 8 of 8 | 0 | 2 | 1 | 1 | -10.0 |\n"
            "| `event` | 12.35 | 1.029 | 8 of 8 | 0 | 2 | 1 | 0 | 18.1 |\n");
  least.waiting.exact = false;
  EXPECT_NE(outcome_table(runs, least).find("≤ 1.029"), std::string::npos) << "of a lower bound only so much is known";
}

TEST(OutcomeNotes, SayWhatWentWrong) {
  EXPECT_EQ(outcome_notes({fake("event", 1, 8, 0, 0.01)}), "");
  EXPECT_NE(outcome_notes({fake("eef-map", 1, 8, 3, -0.01)}).find("3 collisions; it did not see them"), std::string::npos);
  EXPECT_NE(outcome_notes({fake("event", 1, 8, 1, -0.01)}).find("is a fault"), std::string::npos);
  EXPECT_NE(outcome_notes({fake("event", 1, 6, 0, 0.01)}).find("2 commands never done"), std::string::npos);
}

TEST(FinishTimes, StandBesideTheDissertations) {
  ExperimentRun run;
  run.experiment = experiments()[1];
  run.runs = {fake("direct", 23.74, 8, 2, -0.2), fake("event", 29.03, 8, 0, 0.01)};
  const std::string text = finish_time_table({run});
  EXPECT_NE(text.find("| `direct` | without method | 24.3 s | 23.74 s, 2 escapes, **2 collisions** | 24.3 s | not run |"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("0.56 s less than their 24.3 s"), std::string::npos) << text;
}

TEST(PatternTables, HaveAllFifteenExperimentsOfTheDissertation) {
  ASSERT_EQ(pattern_experiments().size(), 15U);
  PatternRun run{pattern_experiments()[7], fake("event", 10, 8, 0, 0.1).report};
  app::DurationStatistics t;
  t.count = 5;
  t.min = 0.25;
  t.mean = 1.5;
  t.max = 7.25;
  run.report.map_build = t;
  const std::string times = map_time_table({run});
  EXPECT_NE(times.find("| 4 | zigzag | 2 | 7 to 305 | 104 | 0.25 to 7.2 | 1.50 | 5 |"), std::string::npos) << times;
  EXPECT_EQ(test::count_of(times, "not run"), 14U);
}

TEST(LocalMinima, ComeFromTheCampaignWhereItHasThePattern) {
  const PatternRun run{pattern_experiments()[0], fake("event", 10, 6, 0, 0.1).report};
  CampaignRow row;
  row.cell = "pattern-zigzag-4";
  row.strategy = "acm";
  row.warnings = 12;
  row.commands = 1000;
  const std::string text = local_minima_table({run}, {Campaign{"c.json", {}, {row}}});
  EXPECT_NE(text.find("| 3 | triangle | few | not run | 1 in 8 commands, 2 never done |"), std::string::npos) << text;
  EXPECT_NE(text.find("| 4 | zigzag | high | 12 in 1000 commands | not run |"), std::string::npos) << text;
}

}  // namespace
}  // namespace interlace::reproduce
