#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/e2e/programs.hpp"
#include "tests/e2e/scratch.hpp"

// interlace-generate and interlace-campaign, seen from outside: files, exit codes, and that what they print can be run.
namespace interlace::test {
namespace {

const std::string kGenerate = INTERLACE_BIN_DIR "/interlace-generate";
const std::string kCampaign = INTERLACE_BIN_DIR "/interlace-campaign";
const std::string kFlow = INTERLACE_BIN_DIR "/interlace-flow";

TEST(Generate, WritesAProgramThatTheSimulatorRuns) {
  Scratch scratch;
  const std::string cell = deployed("pattern-serial-3/cell.yaml");
  const std::string program = scratch.path("program.yaml");
  const Outcome made = run({kGenerate, cell, "--seed", "5", "--commands", "3", "--output", program});
  ASSERT_EQ(made.exit_code, 0) << made;
  EXPECT_TRUE(made.output.empty()) << made;
  const Outcome printed = run({kGenerate, cell, "--seed", "5", "--commands", "3"});
  EXPECT_EQ(printed.output, read_text(program)) << "one seed, two programs";
  const Outcome direct = run({kSim, cell, program, "--strategy", "direct", "--json"});
  ASSERT_TRUE(direct.exit_code == 0 || direct.exit_code == 3) << direct;
  EXPECT_EQ(nlohmann::json::parse(direct.output).at(0)["completed"], 9) << "none of it may be rejected";
}

TEST(Generate, SaysWhatIsWrong) {
  const std::string cell = deployed("pattern-serial-3/cell.yaml");
  EXPECT_EQ(run({kGenerate}).exit_code, 2);
  EXPECT_EQ(run({kGenerate, cell, "--commands", "0"}).exit_code, 2);
  EXPECT_EQ(run({kGenerate, cell, "--seed", "many"}).exit_code, 2);
  const Outcome missing = run({kGenerate, "no/such/cell.yaml"});
  EXPECT_EQ(missing.exit_code, 2);
  EXPECT_TRUE(missing.says("no/such/cell.yaml")) << missing;
  const Outcome nowhere = run({kGenerate, cell, "--commands", "1", "--output", "no/such/folder/program.yaml"});
  EXPECT_EQ(nowhere.exit_code, 2);
  EXPECT_TRUE(nowhere.says("cannot be written")) << nowhere;
  EXPECT_TRUE(run({kGenerate, "--help"}).says("well-formed"));
}

TEST(CampaignProgram, FindsTheCollisionsOfNoPlannerAndHowToSeeThemAgain) {
  Scratch scratch;
  const std::string report = scratch.path("report.json");
  const Outcome o = run({kCampaign, "--cells", deployed("pattern-triangle-3"), deployed("pattern-square-4/cell.yaml"), "--commands", "100",
                         "--strategy", "direct", "--report", report},
                        60s);
  ASSERT_EQ(o.exit_code, 3) << o;
  EXPECT_TRUE(o.says("pattern-triangle-3") && o.says("pattern-square-4")) << o;
  const auto r = nlohmann::json::parse(read_text(report));
  ASSERT_FALSE(r["failing"].empty());
  const auto& failing = r["failing"].at(0);
  std::istringstream words{failing["command"].get<std::string>()};
  std::vector<std::string> again;
  for (std::string word; words >> word;) again.push_back(again.empty() ? kCampaign : word);
  again.emplace_back("--json");
  const Outcome alone = run(again, 60s);
  ASSERT_EQ(alone.exit_code, 3) << alone;
  const auto once_more = nlohmann::json::parse(alone.output);
  ASSERT_EQ(once_more["failing"].size(), 1U);
  EXPECT_EQ(once_more["failing"].at(0)["nearest"], failing["nearest"]);
}

TEST(CampaignProgram, SaysWhatIsWrong) {
  const std::string cell = deployed("pattern-serial-3");
  EXPECT_EQ(run({kCampaign}).exit_code, 2);
  EXPECT_EQ(run({kCampaign, "--cells", cell, "--jobs", "0"}).exit_code, 2);
  const Outcome strategy = run({kCampaign, "--cells", cell, "--strategy", "hope"});
  EXPECT_EQ(strategy.exit_code, 2);
  EXPECT_TRUE(strategy.says("hope") && strategy.says("event")) << strategy;
  const Outcome missing = run({kCampaign, "--cells", "no/such/cell"});
  EXPECT_EQ(missing.exit_code, 2);
  EXPECT_TRUE(missing.says("no/such/cell")) << missing;
  EXPECT_TRUE(run({kCampaign, "--help"}).says("robots touched"));
}

TEST(FlowProgram, PrintsATableAndTheSameNumbersAsJson) {
  Scratch scratch;
  const std::string report = scratch.path("flow.json");
  const Outcome o = run({kFlow, deployed("pattern-serial-3"), "--strategies", "zone", "event", "--loads", "0.5", "--programs", "2",
                         "--per-robot", "4", "--resolution", "0.05", "--report", report},
                        60s);
  ASSERT_EQ(o.exit_code, 0) << o;
  EXPECT_TRUE(o.says("| zone |") && o.says("| event |") && o.says("mean flow at 50 %")) << o;
  const auto rows = nlohmann::json::parse(read_text(report))["rows"];
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows.at(1)["completed"], 24);
  EXPECT_GT(rows.at(1)["mean_flow_s"], 0);
}

TEST(FlowProgram, SaysWhatIsWrong) {
  const std::string cell = deployed("pattern-serial-3");
  EXPECT_EQ(run({kFlow}).exit_code, 2);
  EXPECT_EQ(run({kFlow, cell, "--loads", "0"}).exit_code, 2);
  const Outcome strategy = run({kFlow, cell, "--strategies", "event", "hope"});
  EXPECT_EQ(strategy.exit_code, 2);
  EXPECT_TRUE(strategy.says("hope") && strategy.says("acm")) << strategy;
  EXPECT_EQ(run({kFlow, "no/such/cell"}).exit_code, 2);
  EXPECT_TRUE(run({kFlow, "--help"}).says("Poisson"));
}

}  // namespace
}  // namespace interlace::test
