#include <gtest/gtest.h>

#include "tests/unit/config/samples.hpp"

namespace interlace::app {
namespace {

using samples::Broken;
using samples::kProgram;
using samples::replaced;

constexpr double kDegree = model::kPi / 180;

class ProgramRule : public testing::TestWithParam<Broken> {};

TEST_P(ProgramRule, IsToldWithItsPlace) {
  const Broken& broken = GetParam();
  samples::expect_only(samples::program_findings(replaced(kProgram, broken.from, broken.to)), broken, "program.yaml");
}

INSTANTIATE_TEST_SUITE_P(
    All, ProgramRule,
    testing::Values(
        Broken{"WrongVersion", "interlace: 1", "interlace: 1.0", 1, "interlace", "\"1.0\"", "expected 1"},
        Broken{"NoUnits", "units: {length: mm, angle: deg}\n", "", 1, "units", "", "required key is missing"},
        Broken{"UnknownKey", "repeat: 2", "repeats: 2", 3, "repeats", "", "did you mean \"repeat\"?"},
        Broken{"RepeatZero", "repeat: 2", "repeat: 0", 3, "repeat", "\"0\"", "expected a whole number from 1"},
        Broken{"RepeatFraction", "repeat: 2", "repeat: 1.5", 3, "repeat", "\"1.5\"", "expected a whole number from 1"},
        Broken{"RepeatHuge", "repeat: 2", "repeat: 200000", 3, "repeat", "\"200000\"", "expected at most 200000 commands in all"},
        Broken{"RepeatOverflow", "repeat: 2", "repeat: 99999999999", 3, "repeat", "\"99999999999\"", "expected a whole number from 1"},
        Broken{"UnknownRobot", "  r2:", "  r22:", 8, "program.r22", "",
               "unknown robot \"r22\", the cell has r1 or r2 (did you mean \"r2\"?)"},
        Broken{"SameRobotTwice", "  r2:", "  r1:", 8, "program.r1", "", "duplicate key"},
        Broken{"UnknownMove", "move: joint", "move: circular", 7, "program.r1[1].move", "\"circular\"", "expected linear or joint"},
        Broken{"NoMove", "move: joint, ", "", 7, "program.r1[1].move", "", "required key is missing"},
        Broken{"NoTarget", "      to: {xyz: [300, -250, 330], rpy: [0, 0, 0]}\n", "", 9, "program.r2[0].to", "", "required key is missing"},
        Broken{"LinearToJoints", "{xyz: [300, 250, 330], rpy: [0, 0, 90]}", "{xyz: [300, 250, 330], rpy: [0, 0, 90], joints: [0]}", 6,
               "program.r1[0].to.joints", "", "unknown key"},
        Broken{"JointToPose", "{joints: [0, 40, 94, 0, -44, 180]}", "{joints: [0, 40, 94, 0, -44, 180], rpy: [0, 0, 0]}", 7,
               "program.r1[1].to.rpy", "", "unknown key"},
        Broken{"NanTarget", "xyz: [300, 250, 330]", "xyz: [300, .NaN, 330]", 6, "program.r1[0].to.xyz[1]", "\".NaN\"",
               "expected a finite number (mm)"},
        Broken{"TwoAngles", "rpy: [0, 0, 90]", "rpy: [0, 0]", 6, "program.r1[0].to.rpy", "[0, 0]", "expected a list of 3 numbers (deg)"},
        Broken{"FiveJoints", "joints: [0, 40, 94, 0, -44, 180]", "joints: [0, 40, 94, 0, -44]", 7, "program.r1[1].to.joints",
               "[0, 40, 94, 0, -44]", "expected a list of 6 numbers (deg)"},
        Broken{"VelocityZero", "velocity: 50", "velocity: 0", 11, "program.r2[0].velocity", "\"0\"", "expected a number > 0 (mm/s)"},
        Broken{"AccelerationInf", "acceleration: 60", "acceleration: .inf", 12, "program.r2[0].acceleration", "\".inf\"",
               "expected a number > 0 (mm/s^2)"},
        Broken{"PriorityWord", "priority: 7", "priority: high", 13, "program.r2[0].priority", "\"high\"", "expected a whole number"},
        Broken{"AtNegative", "at: 2.5", "at: -2.5", 14, "program.r2[0].at", "\"-2.5\"", "expected a number >= 0 (s)"},
        Broken{"DeadlineNegative", "deadline: 30", "deadline: -1", 15, "program.r2[0].deadline", "\"-1\"", "expected a number >= 0 (s)"},
        Broken{"EventWithoutTime", "{at: 4, hold: r1}", "{hold: r1}", 17, "events[0].at", "", "required key is missing"},
        Broken{"EventOfNothing", "{at: 4, hold: r1}", "{at: 4}", 17, "events[0]", "", "expected one of hold, resume, cancel and replace"},
        Broken{"EventOfTwo", "{at: 4, hold: r1}", "{at: 4, hold: r1, resume: r1}", 17, "events[0]", "",
               "expected one of hold, resume, cancel and replace"},
        Broken{"EventOfAnUnknownRobot", "{at: 4, hold: r1}", "{at: 4, hold: r3}", 17, "events[0].hold", "", "unknown robot \"r3\""},
        Broken{"EventNobodyKnows", "{at: 4, hold: r1}", "{at: 4, hold: r1, pause: r1}", 17, "events[0].pause", "", "unknown key"},
        Broken{"CancelOfNothing", "cancel: r2, command: 2", "cancel: r2", 19, "events[2].command", "", "required key is missing"},
        Broken{"CancelOfNumberZero", "command: 2", "command: 0", 19, "events[2].command", "\"0\"", "expected a whole number from 1"},
        Broken{"HoldOfACommand", "{at: 4, hold: r1}", "{at: 4, hold: r1, command: 1}", 17, "events[0].command", "", "only `cancel` has it"},
        Broken{"HoldByCommands", "{at: 4, hold: r1}", "{at: 4, hold: r1, by: []}", 17, "events[0].by", "", "only `replace` has it"},
        Broken{"ReplaceByNothingSaid", "    by:\n      - {move: joint, to: {joints: [0, 40, 94, 0, -44, 0]}, priority: -1}\n", "", 20,
               "events[3].by", "", "required key is missing"},
        Broken{"ReplacementWithATime", "priority: -1}", "at: 3}", 23, "events[3].by[0]", "",
               "a command of a replacement is released with it"},
        Broken{"UnknownStepKey", "velocity: 50", "speed: 50", 11, "program.r2[0].speed", "", "unknown key"},
        Broken{"StepNoMapping", "{move: joint, to: {joints: [0, 40, 94, 0, -44, 180]}}", "home", 7, "program.r1[1]", "\"home\"",
               "expected a mapping with the keys move"}),
    [](const testing::TestParamInfo<Broken>& param_info) { return std::string{param_info.param.name}; });

TEST(Program, EveryKeyArrivesInSiUnitsAndRepeats) {
  const auto program = parse_program(kProgram, "program.yaml", nullptr);
  ASSERT_TRUE(program) << to_string(program.error());
  EXPECT_EQ(program->size(), 6U);
  ASSERT_EQ(program->robots.size(), 2U);
  EXPECT_EQ(program->robots[0].first.str(), "r1");
  const auto& r1 = program->robots[0].second;
  ASSERT_EQ(r1.size(), 4U);
  const auto* line = std::get_if<model::LinearTarget>(&r1[0].motion.target);
  ASSERT_NE(line, nullptr);
  EXPECT_TRUE(line->X_WT.translation().isApprox(model::Vector3{0.3, 0.25, 0.33}, 1e-12));
  EXPECT_TRUE((line->X_WT.linear() * model::Vector3::UnitX()).isApprox(model::Vector3::UnitY(), 1e-12)) << "a yaw of 90 deg turns x to y";
  EXPECT_FALSE(r1[0].motion.velocity);
  EXPECT_EQ(r1[0].at, 0);
  const auto* joints = std::get_if<model::JointTarget>(&r1[1].motion.target);
  ASSERT_NE(joints, nullptr);
  EXPECT_NEAR(joints->q[2], 94 * kDegree, 1e-12);
  EXPECT_NEAR(joints->q[5], model::kPi, 1e-12);
  EXPECT_TRUE(std::holds_alternative<model::LinearTarget>(r1[2].motion.target));
  EXPECT_TRUE(std::holds_alternative<model::JointTarget>(r1[3].motion.target));
  const auto& step = program->robots[1].second.at(1);
  EXPECT_DOUBLE_EQ(step.motion.velocity.value_or(0), 0.05);
  EXPECT_DOUBLE_EQ(step.motion.acceleration.value_or(0), 0.06);
  EXPECT_EQ(step.priority, 7);
  EXPECT_DOUBLE_EQ(step.at, 2.5);
  EXPECT_EQ(step.deadline, 30);
  EXPECT_FALSE(r1[0].deadline);
}

TEST(Program, EventsComeInTheOrderOfTheirTimeAndOnce) {
  using What = model::ProgramEvent::What;
  const auto program = parse_program(kProgram, "program.yaml", nullptr);
  ASSERT_TRUE(program) << to_string(program.error());
  const auto& events = program->events;
  ASSERT_EQ(events.size(), 4U) << "`repeat` is for commands";
  const std::vector<std::pair<double, What>> wanted{{1, What::cancel}, {4, What::hold}, {5, What::replace}, {6.5, What::resume}};
  for (std::size_t i = 0; i < events.size(); ++i) {
    EXPECT_DOUBLE_EQ(events[i].at, wanted[i].first);
    EXPECT_EQ(events[i].what, wanted[i].second);
    EXPECT_EQ(events[i].robot.str(), i % 2 == 0 ? "r2" : "r1");
  }
  EXPECT_EQ(events[0].command, 2U);
  ASSERT_EQ(events[2].commands.size(), 1U);
  EXPECT_EQ(events[2].commands[0].priority, -1);
}

TEST(Program, WithoutCommandsIsRefused) {
  const std::string head = "interlace: 1\nunits: {length: mm, angle: deg}\n";
  samples::expect_only(samples::program_findings(head + "program: {}\n"), {"", "", "", 3, "program", "{}", "at least one command"},
                       "program.yaml");
  samples::expect_only(samples::program_findings(head + "program: {r1: [], r2: []}\n"),
                       {"", "", "", 3, "program", "{r1: [], r2: []}", "at least one command"}, "program.yaml");
  samples::expect_only(samples::program_findings(head), {"", "", "", 1, "program", "", "required key is missing"}, "program.yaml");
  samples::expect_only(samples::program_findings(head + "program:\n"), {"", "", "", 3, "program", "nothing", "expected a mapping"},
                       "program.yaml");
}

TEST(Program, OneRobotMayRest) {
  const auto program = parse_program(replaced(kProgram, kProgram.substr(kProgram.find("  r2:")), "  r2: []\n"), "program.yaml",
                                     {model::RobotName{"r1"}, model::RobotName{"r2"}});
  ASSERT_TRUE(program) << to_string(program.error());
  EXPECT_EQ(program->size(), 4U);
}

TEST(Program, RobotsAreThoseOfTheCell) {
  const auto cell = parse_cell(samples::kCell, "cell.yaml");
  ASSERT_TRUE(cell);
  EXPECT_TRUE(parse_program(kProgram, "program.yaml", &cell->cell));
  const auto wrong = parse_program(replaced(kProgram, "  r2:", "  r3:"), "program.yaml", &cell->cell);
  ASSERT_FALSE(wrong);
  EXPECT_NE(to_string(wrong.error()).find("program.yaml:8:3: program.r3: unknown robot \"r3\", the cell has r1 or r2"), std::string::npos)
      << to_string(wrong.error());
  EXPECT_TRUE(parse_program(replaced(kProgram, "  r2:", "  r3:"), "program.yaml", nullptr)) << "without a cell any name goes";
}

TEST(Program, ANameIsAName) {
  const auto wrong = parse_program(replaced(kProgram, "  r2:", "  r/2:"), "program.yaml", nullptr);
  ASSERT_FALSE(wrong);
  EXPECT_NE(wrong.error().findings.at(0).rule.find("the name of a robot"), std::string::npos);
}

}  // namespace
}  // namespace interlace::app
