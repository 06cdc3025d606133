#include <gtest/gtest.h>

#include "common/app/config/fingerprint.hpp"
#include "common/app/config/program_text.hpp"
#include "tests/unit/config/samples.hpp"

namespace interlace::app {
namespace {

using model::ToolName;
using model::ToolTime;
using samples::Broken;
using samples::kToolCell;
using samples::replaced;

const std::string kToolProgram = R"(interlace: 1
units: {length: mm, angle: deg}
program:
  r1:
    - {move: linear, to: {xyz: [300, 250, 330], rpy: [0, 0, 0]}, attach: fork, detach: short}
    - {move: linear, to: {xyz: [300, 250, 330], rpy: [0, 0, 0]}, detach: fork, when: start}
)";

class ToolCellRule : public testing::TestWithParam<Broken> {};

TEST_P(ToolCellRule, IsToldWithItsPlace) {
  samples::expect_only(samples::cell_findings(replaced(kToolCell, GetParam().from, GetParam().to)), GetParam(), "cell.yaml");
}

INSTANTIATE_TEST_SUITE_P(
    All, ToolCellRule,
    testing::Values(
        Broken{"NoCapsules", "    capsules:\n      - {from: [0, 0, 0], to: [0, 0, 60], radius: 30}\n", "    capsules: []\n", 31,
               "tools.short.capsules", "[]", "expected 1 to 16 capsules"},
        Broken{"UnknownKey", "to: [0, 0, 60], radius: 30", "to: [0, 0, 60], radius: 30, link: 6", 32, "tools.short.capsules[0].link", "",
               "unknown key"},
        Broken{"NoRadius", ", radius: 20", "", 35, "tools.fork.capsules[0].radius", "", "required key is missing"},
        Broken{"ZeroRadius", "radius: 20", "radius: 0", 35, "tools.fork.capsules[0].radius", "\"0\"", "expected a number > 0 (mm)"},
        Broken{"BadName", "  short:\n", "  a/b:\n    capsules: [{from: [0, 0, 0], to: [0, 0, 1], radius: 1}]\n  short:\n", 30, "tools.a/b",
               "", "the name of a tool is"},
        Broken{"Twice", "  fork:\n", "  short:\n    capsules: [{from: [0, 0, 0], to: [0, 0, 1], radius: 1}]\n  fork:\n", 33, "tools.short",
               "", "duplicate key"},
        Broken{"HoldsUnknown", "holds: [short]", "holds: [shirt]", 48, "robots[0].holds[0]", "\"shirt\"", "did you mean \"short\"?"},
        Broken{"HoldsTwice", "holds: [short]", "holds: [short, short]", 48, "robots[0].holds[1]", "", "is in the hand already"},
        Broken{"HoldsWord", "holds: [short]", "holds: short", 48, "robots[0].holds", "\"short\"", "expected a list of names of tools"}),
    [](const testing::TestParamInfo<Broken>& param_info) { return std::string{param_info.param.name}; });

TEST(ToolCell, HoldsNothingThatTheCellDoesNotHave) {
  const auto text = replaced(samples::kCell, "    controller:", "    holds: [short]\n    controller:");
  samples::expect_only(samples::cell_findings(text), {"", "", "", 40, "robots[0].holds[0]", "\"short\"", "the cell has no tools"},
                       "cell.yaml");
}

TEST(ToolCell, ValuesArriveInSiUnits) {
  const auto loaded = parse_cell(kToolCell, "cell.yaml");
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  const auto& cell = loaded->cell;
  ASSERT_EQ(cell.tools.size(), 2U);
  EXPECT_EQ(cell.tools[1].name, ToolName{"fork"}) << "in the order of the file";
  ASSERT_EQ(cell.tools[1].capsules.size(), 2U);
  const auto& tine = cell.tools[1].capsules[1];
  EXPECT_EQ(tine.name, "fork");
  EXPECT_EQ(tine.link, 6U);
  EXPECT_TRUE(tine.a.isApprox(model::Vector3{0, 0.05, 0.1}, 1e-12));
  EXPECT_TRUE(tine.b.isApprox(model::Vector3{0, 0.05, 0.2}, 1e-12));
  EXPECT_DOUBLE_EQ(tine.radius, 0.01);
  EXPECT_EQ(cell.robots[0].holds, std::vector{ToolName{"short"}});
  EXPECT_TRUE(cell.robots[1].holds.empty());
  EXPECT_EQ(cell.robots[0].model.capsules.size(), 4U) << "the cell's robots are bare";
}

TEST(ToolCell, StartsAreClearWithWhatIsHeldThere) {
  const auto text = replaced(kToolCell, "to: [0, 0, 60], radius: 30", "to: [0, -400, 0], radius: 30");
  const auto findings = samples::cell_findings(text);
  ASSERT_EQ(findings.size(), 1U);
  EXPECT_NE(findings.front().rule.find("r1.short"), std::string::npos) << findings.front().rule;
}

TEST(ToolCell, EveryChangeOfAToolChangesTheFingerprint) {
  const auto of = [](const std::string& text) { return parse_cell(text, "cell.yaml")->fingerprint; };
  const auto original = of(kToolCell);
  for (const auto& [from, to] : {std::pair{"to: [0, 0, 60]", "to: [0, 0, 61]"},
                                 {"radius: 20", "radius: 21"},
                                 {"  fork:", "  spoon:"},
                                 {"holds: [short]", "holds: [fork]"},
                                 {"    holds: [short]\n", ""}}) {
    EXPECT_NE(of(replaced(kToolCell, from, to)), original) << to;
  }
}

TEST(ToolProgram, SaysWhatIsTakenAndLeftAndWhen) {
  const auto cell = parse_cell(kToolCell, "cell.yaml");
  ASSERT_TRUE(cell);
  const auto program = parse_program(kToolProgram, "program.yaml", &cell->cell);
  ASSERT_TRUE(program) << to_string(program.error());
  const auto& first = program->robots[0].second[0].motion.tools;
  ASSERT_TRUE(first);
  EXPECT_EQ(first->attach, ToolName{"fork"});
  EXPECT_EQ(first->detach, ToolName{"short"});
  EXPECT_EQ(first->when, ToolTime::completion);
  const auto& second = program->robots[0].second[1].motion.tools;
  ASSERT_TRUE(second);
  EXPECT_TRUE(second->attach.empty());
  EXPECT_EQ(second->when, ToolTime::start);
  const auto again = parse_program(program_text(*program, ""), "again.yaml", &cell->cell);
  ASSERT_TRUE(again) << to_string(again.error());
  EXPECT_EQ(again->robots[0].second[1].motion.tools->detach, ToolName{"fork"});
  EXPECT_EQ(again->robots[0].second[1].motion.tools->when, ToolTime::start);
}

TEST(ToolProgram, MistakesAreToldWithTheirPlace) {
  const auto cell = parse_cell(kToolCell, "cell.yaml");
  ASSERT_TRUE(cell);
  const auto findings = [&](const std::string& from, const std::string& to) {
    const auto program = parse_program(replaced(kToolProgram, from, to), "program.yaml", &cell->cell);
    return program ? std::vector<Finding>{} : program.error().findings;
  };
  const auto expect = [&](const Broken& b) { samples::expect_only(findings(b.from, b.to), b, "program.yaml"); };
  expect({"unknown", "attach: fork", "attach: frok", 5, "program.r1[0].attach", "\"frok\"", "did you mean \"fork\"?"});
  expect({"word", "when: start", "when: soon", 6, "program.r1[1].when", "\"soon\"", "expected start or completion"});
  expect({"same", "attach: fork, detach: short", "attach: fork, detach: fork", 5, "program.r1[0].attach", "\"fork\"",
          "expected another tool"});
  expect({"when alone", "detach: fork, when: start", "when: start", 6, "program.r1[1].when", "", "neither attach nor detach"});
  const auto unnamed = parse_program(replaced(kToolProgram, "attach: fork", "attach: frok"), "program.yaml", nullptr);
  EXPECT_TRUE(unnamed) << "without a cell the planner judges names";
}

}  // namespace
}  // namespace interlace::app
