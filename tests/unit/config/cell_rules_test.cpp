#include <gtest/gtest.h>

#include "tests/unit/config/samples.hpp"

namespace interlace::app {
namespace {

using samples::Broken;
using samples::kCell;
using samples::replaced;

class CellRule : public testing::TestWithParam<Broken> {};

TEST_P(CellRule, IsToldWithItsPlace) {
  const Broken& broken = GetParam();
  samples::expect_only(samples::cell_findings(replaced(kCell, broken.from, broken.to)), broken, "cell.yaml");
}

std::string case_name(const testing::TestParamInfo<Broken>& info) {
  return info.param.name;
}

INSTANTIATE_TEST_SUITE_P(
    Preamble, CellRule,
    testing::Values(Broken{"WrongVersion", "interlace: 1", "interlace: 2", 1, "interlace", "\"2\"", "expected 1"},
                    Broken{"NoVersion", "interlace: 1\n", "", 1, "interlace", "", "required key is missing"},
                    Broken{"NoUnits", "units: {length: mm, angle: deg}\n", "", 1, "units", "", "required key is missing"},
                    Broken{"NoLengthUnit", "length: mm, ", "", 2, "units.length", "", "required key is missing"},
                    Broken{"NoAngleUnit", ", angle: deg", "", 2, "units.angle", "", "required key is missing"},
                    Broken{"UnknownLength", "length: mm", "length: cm", 2, "units.length", "\"cm\"", "expected mm or m"},
                    Broken{"UnknownAngle", "angle: deg", "angle: grad", 2, "units.angle", "\"grad\"", "expected deg or rad"},
                    Broken{"UnitsNoMapping", "{length: mm, angle: deg}", "mm", 2, "units", "\"mm\"",
                           "expected a mapping with the keys length or angle"},
                    Broken{"NoName", "cell: sample\n", "", 1, "cell", "", "required key is missing"},
                    Broken{"BadName", "cell: sample", "cell: two words", 3, "cell", "\"two words\"", "expected a name"},
                    Broken{"EmptyName", "cell: sample", "cell:", 3, "cell", "nothing", "expected a name"},
                    Broken{"UnknownKey", "planning:", "robot: []\nplanning:", 47, "robot", "", "unknown key (did you mean \"robots\"?)"},
                    Broken{"UnknownKeyNearNothing", "planning:", "colour: []\nplanning:", 47, "colour", "", "unknown key"},
                    Broken{"DuplicateKey", "planning:", "cell: other\nplanning:", 47, "cell", "", "duplicate key"},
                    Broken{"KeyNoText", "planning:", "? [a, b]\n: 1\nplanning:", 47, "", "[a, b]", "expected a plain text as key"}),
    case_name);

INSTANTIATE_TEST_SUITE_P(
    Models, CellRule,
    testing::Values(
        Broken{"BadModelName", "cell: sample\nmodels:\n",
               "cell: sample\nmodels:\n  a/b: {kinematics: {type: opw, a1: 0, a2: 0, b: 0, c1: 1, c2: 1, "
               "c3: 1, c4: 1}, capsules: {chain: [1, 1, 1, 1]}}\n",
               5, "models.a/b", "", "the name of a model"},
        Broken{"DuplicateModel", "robots:\n", "  arm: {}\nrobots:\n", 29, "models.arm", "", "duplicate key"},
        Broken{"UnknownModelKey", "    tool:", "    tol:", 22, "models.arm.tol", "", "did you mean \"tool\"?"},
        Broken{"UnknownKinematics", "type: opw", "type: dh", 7, "models.arm.kinematics.type", "\"dh\"", "expected opw"},
        Broken{"MissingLength", "      c3: 270\n", "", 7, "models.arm.kinematics.c3", "", "required key is missing"},
        Broken{"NegativeLength", "c1: 290", "c1: -290", 11, "models.arm.kinematics.c1", "\"-290\"", "expected a number >= 0 (mm)"},
        Broken{"ZeroArm", "c2: 260", "c2: 0", 12, "models.arm.kinematics.c2", "\"0\"", "expected a number > 0 (mm)"},
        Broken{"NanLength", "c2: 260", "c2: .nan", 12, "models.arm.kinematics.c2", "\".nan\"", "expected a number > 0 (mm)"},
        Broken{"NanWord", "a1: 0", "a1: nan", 8, "models.arm.kinematics.a1", "\"nan\"", "expected a finite number (mm)"},
        Broken{"Infinite", "a2: 0", "a2: inf", 9, "models.arm.kinematics.a2", "\"inf\"", "expected a finite number (mm)"},
        Broken{"Overflowing", "b: 0", "b: 1e999", 10, "models.arm.kinematics.b", "\"1e999\"", "expected a finite number (mm)"},
        Broken{"Huge", "b: 0", "b: 1e300", 10, "models.arm.kinematics.b", "\"1e300\"", "expected at most 1e+06 mm"},
        Broken{"UnitInNumber", "c4: 90", "c4: 90mm", 14, "models.arm.kinematics.c4", "\"90mm\"", "expected a number >= 0 (mm)"},
        Broken{"FiveOffsets", "offsets: [0, 0, 0, 0, 0, 0]", "offsets: [0, 0, 0, 0, 0]", 15, "models.arm.kinematics.offsets",
               "[0, 0, 0, 0, 0]", "expected a list of 6 numbers (deg)"},
        Broken{"SevenSigns", "signs: [1, 1", "signs: [1, 1, 1", 16, "models.arm.kinematics.signs", "[1, 1, 1, 1, 1, 1, 1]",
               "expected a list of 6 signs"},
        Broken{"ZeroSign", "signs: [1, 1", "signs: [1, 0", 16, "models.arm.kinematics.signs[1]", "\"0\"", "expected 1 or -1"},
        Broken{"WrongSign", "signs: [1, 1", "signs: [1, 2", 16, "models.arm.kinematics.signs[1]", "\"2\"", "expected 1 or -1"},
        Broken{"MinAboveMax", "min: [-170, -90", "min: [-170, 190", 18, "models.arm.joints.min", "[-170, 190, -175, -180, -135, -360]",
               "expected min < max, but joint 2 has 190 deg and 180 deg"},
        Broken{"MinEqualsMax", "min: [-170", "min: [170", 18, "models.arm.joints.min", "[170, -90, -175, -180, -135, -360]",
               "expected min < max, but joint 1 has 170 deg and 170 deg"},
        Broken{"NoMax", "      max: [170, 180, 250, 180, 135, 360]\n", "", 18, "models.arm.joints.max", "", "required key is missing"},
        Broken{"JointSpeedZero", "velocity: [200, 200", "velocity: [200, 0", 20, "models.arm.joints.velocity[1]", "\"0\"",
               "expected a number > 0 (deg/s)"},
        Broken{"JointAcceleration", "acceleration: [1000", "acceleration: [-1", 21, "models.arm.joints.acceleration[0]", "\"-1\"",
               "expected a number > 0 (deg/s^2)"},
        Broken{"ToolTwoNumbers", "tool: {xyz: [0, 0, 0]", "tool: {xyz: [0, 0]", 22, "models.arm.tool.xyz", "[0, 0]",
               "expected a list of 3 numbers (mm)"},
        Broken{"ToolWithoutRpy", "tool: {xyz: [0, 0, 0], rpy: [0, -90, 0]}", "tool: {xyz: [0, 0, 0]}", 22, "models.arm.tool.rpy", "",
               "required key is missing"}),
    case_name);

const std::string kCapsules = R"(    capsules:
      - {name: base, link: 0, from: [0, 0, 0], to: [0, 0, 290], radius: 112}
      - {name: upper, link: 2, from: [0, 0, 0], to: [0, 0, 260], radius: 117}
      - {name: forearm, link: 3, from: [0, 0, 0], to: [0, 0, 270], radius: 100}
      - {name: hand, link: 6, from: [0, 0, -90], to: [0, 0, 0], radius: 48}
    self_collision: [[base, hand]]
)";

INSTANTIATE_TEST_SUITE_P(
    Capsules, CellRule,
    testing::Values(
        Broken{"None", kCapsules, "    capsules: []\n", 23, "models.arm.capsules", "[]", "expected 1 to 64 capsules"},
        Broken{"Missing", kCapsules, "", 6, "models.arm.capsules", "", "required key is missing"},
        Broken{"Text", kCapsules, "    capsules: four\n", 23, "models.arm.capsules", "\"four\"", "expected {chain: [4 radii]}"},
        Broken{"ThreeRadii", kCapsules, "    capsules: {chain: [112, 117, 100]}\n", 23, "models.arm.capsules.chain", "[112, 117, 100]",
               "expected a list of 4 numbers (mm)"},
        Broken{"NegativeRadius", "radius: 117", "radius: -117", 25, "models.arm.capsules[1].radius", "\"-117\"",
               "expected a number > 0 (mm)"},
        Broken{"ZeroRadius", kCapsules, "    capsules: {chain: [112, 117, 100, 0]}\n", 23, "models.arm.capsules.chain[3]", "\"0\"",
               "expected a number > 0 (mm)"},
        Broken{"LinkSeven", "link: 6", "link: 7", 27, "models.arm.capsules[3].link", "\"7\"", "expected a whole number from 0 to 6"},
        Broken{"LinkFraction", "link: 6", "link: 5.5", 27, "models.arm.capsules[3].link", "\"5.5\"", "expected a whole number from 0 to 6"},
        Broken{"NoRadius", ", radius: 48", "", 27, "models.arm.capsules[3].radius", "", "required key is missing"},
        Broken{"UnknownKey", "from: [0, 0, -90]", "form: [0, 0, -90], from: [0, 0, -90]", 27, "models.arm.capsules[3].form", "",
               "did you mean \"from\"?"},
        Broken{"SameName", "name: upper", "name: base", 25, "models.arm.capsules[1]", "", "there is another capsule \"base\""},
        Broken{"UnknownPair", "[[base, hand]]", "[[base, band]]", 28, "models.arm.self_collision[0][1]", "\"band\"",
               "did you mean \"hand\"?"},
        Broken{"PairWithItself", "[[base, hand]]", "[[base, base]]", 28, "models.arm.self_collision[0]", "[base, base]",
               "expected two different capsules"},
        Broken{"Triple", "[[base, hand]]", "[[base, hand, upper]]", 28, "models.arm.self_collision[0]", "[base, hand, upper]",
               "expected a list of two capsule names"}),
    case_name);

INSTANTIATE_TEST_SUITE_P(
    Robots, CellRule,
    testing::Values(
        Broken{"DuplicateName", "name: r2", "name: r1", 41, "robots[1].name", "\"r1\"", "robots[0] has it already"},
        Broken{"BadName", "name: r2", "name: r/2", 41, "robots[1].name", "\"r/2\"", "expected a name"},
        Broken{"NoName", "  - name: r2\n    model: arm", "  - model: arm", 41, "robots[1].name", "", "required key is missing"},
        Broken{"UnknownModel", "model: arm", "model: arn", 31, "robots[0].model", "\"arn\"", "did you mean \"arm\"?"},
        Broken{"NoBase", "    base: {xyz: [0, -250, 0], rpy: [0, 0, 0]}\n", "", 41, "robots[1].base", "", "required key is missing"},
        Broken{"NoStart", "    start: {xyz: [450, -250, 300], rpy: [0, 0, 0]}\n", "", 41, "robots[1].start", "", "required key is missing"},
        Broken{"NoTcp", "    tcp: {velocity: 100, acceleration: 100}\n", "", 41, "robots[1].tcp", "", "required key is missing"},
        Broken{"SpeedWord", "velocity: 100\n", "velocity: fast\n", 36, "robots[0].tcp.velocity", "\"fast\"",
               "expected a number > 0 (mm/s)"},
        Broken{"SpeedZero", "velocity: 100\n", "velocity: 0\n", 36, "robots[0].tcp.velocity", "\"0\"", "expected a number > 0 (mm/s)"},
        Broken{"SpeedNan", "velocity: 100\n", "velocity: nan\n", 36, "robots[0].tcp.velocity", "\"nan\"", "expected a number > 0 (mm/s)"},
        Broken{"SpeedTiny", "velocity: 100\n", "velocity: 1e-9\n", 36, "robots[0].tcp.velocity", "\"1e-9\"", "expected at least 0.01 mm/s"},
        Broken{"AccelerationZero", "acceleration: 200", "acceleration: -0", 37, "robots[0].tcp.acceleration", "\"-0\"",
               "expected a number > 0 (mm/s^2)"},
        Broken{"AngularZero", "angular_velocity: 90", "angular_velocity: 0", 38, "robots[0].tcp.angular_velocity", "\"0\"",
               "expected a number > 0 (deg/s)"},
        Broken{"AngularAlone", "      angular_acceleration: 180\n", "", 36, "robots[0].tcp.angular_acceleration", "",
               "required key is missing"},
        Broken{"LatencyNegative", "start_latency: 0.02", "start_latency: -1", 40, "robots[0].controller.start_latency", "\"-1\"",
               "expected a number >= 0 (s)"},
        Broken{"JitterAboveLatency", "start_jitter: 0.01", "start_jitter: 0.03", 40, "robots[0].controller.start_jitter", "\"0.03\"",
               "expected at most start_latency (0.02 s)"},
        Broken{"SpeedErrorLarge", "speed_error: 0.001", "speed_error: 0.9", 40, "robots[0].controller.speed_error", "\"0.9\"",
               "expected at most 0.5"},
        Broken{"PathErrorNegative", "path_error: 2", "path_error: -2", 40, "robots[0].controller.path_error", "\"-2\"",
               "expected a number >= 0 (mm)"},
        Broken{"FixturesNoList", "fixtures: []", "fixtures: table", 46, "fixtures", "\"table\"", "expected a list of fixtures"}),
    case_name);

INSTANTIATE_TEST_SUITE_P(
    Postures, CellRule,
    testing::Values(
        Broken{"Unreachable", "xyz: [450, -250, 300]", "xyz: [4500, -250, 300]", 44, "robots[1].start",
               "{xyz: [4500, -250, 300], rpy: [0, 0, 0]}", "unreachable for model arm: its wrist would be 4410.01 mm from its shoulder"},
        Broken{"HomeOutsideLimits", "joints: [0, 40, 94, 0, -44, 0]", "joints: [0, 40, 94, 0, -144, 0]", 34, "robots[0].home.joints",
               "[0, 40, 94, 0, -144, 0]", "joint 5 would be at -144 deg, outside its limits -135 deg to 135 deg"},
        Broken{"PostureWord", "elbow: up", "elbow: upp", 33, "robots[0].start.posture.elbow", "\"upp\"", "did you mean \"up\"?"},
        Broken{"PostureKey", "elbow: up", "elbo: up", 33, "robots[0].start.posture.elbo", "", "did you mean \"elbow\"?"},
        Broken{"JointsAndPose", "home: {joints: [0, 40, 94, 0, -44, 0]}", "home: {joints: [0, 40, 94, 0, -44, 0], rpy: [0, 0, 0]}", 34,
               "robots[0].home", "{joints: [0, 40, 94, 0, -44, 0], rpy: [0, 0, 0]}", "either joints or a pose"},
        Broken{"FiveJoints", "joints: [0, 40, 94, 0, -44, 0]", "joints: [0, 40, 94, 0, -44]", 34, "robots[0].home.joints",
               "[0, 40, 94, 0, -44]", "expected a list of 6 numbers (deg)"},
        Broken{"StartsCollide", "xyz: [450, -250, 300]", "xyz: [400, 50, 300]", 44, "robots[1].start",
               "{xyz: [400, 50, 300], rpy: [0, 0, 0]}", "in collision with robots[0].start: clearance of r2."},
        Broken{"HomesCollide", "joints: [0, 40, 94, 0, -44, 0]", "joints: [-70, 40, 94, 0, -44, 0]", 44, "robots[1].start",
               "{xyz: [450, -250, 300], rpy: [0, 0, 0]}", "in collision with robots[0].home: clearance of r2."},
        Broken{"CloserThanMargin", "margin: 5", "margin: 400", 44, "robots[1].start", "{xyz: [450, -250, 300], rpy: [0, 0, 0]}",
               "expected > 402 mm"},
        Broken{"SelfCollision", "joints: [0, 40, 94, 0, -44, 0]", "joints: [0, -10, 170, 0, 70, 0]", 34, "robots[0].home",
               "{joints: [0, -10, 170, 0, 70, 0]}", "collides with itself: clearance of r1.base and r1.hand would be"}),
    case_name);

INSTANTIATE_TEST_SUITE_P(
    Planning, CellRule,
    testing::Values(
        Broken{"ResolutionZero", "resolution: 0.02", "resolution: 0", 48, "planning.resolution", "\"0\"", "expected more than 0.0005 s"},
        Broken{"ResolutionAtBorder", "resolution: 0.02", "resolution: 0.0005", 48, "planning.resolution", "\"0.0005\"",
               "expected more than 0.0005 s"},
        Broken{"ResolutionCoarse", "resolution: 0.02", "resolution: 1.01", 48, "planning.resolution", "\"1.01\"", "expected at most 1 s"},
        Broken{"MarginNegative", "margin: 5", "margin: -5", 49, "planning.margin", "\"-5\"", "expected a number >= 0 (mm)"},
        Broken{"UnknownStrategy", "strategy: direct", "strategy: evnt", 50, "planning.strategy", "\"evnt\"", "did you mean \"event\"?"},
        Broken{"BudgetNegative", "strategy: direct", "strategy: direct\n  budget: -1", 51, "planning.budget", "\"-1\"",
               "expected a number >= 0 (s)"},
        Broken{"PromiseNegative", "strategy: direct", "strategy: direct\n  promise: -1", 51, "planning.promise", "\"-1\"",
               "expected a number >= 0 (s)"},
        Broken{"LeadNegative", "lead: 0.05", "lead: -0.05", 51, "planning.lead", "\"-0.05\"", "expected a number >= 0 (s)"},
        Broken{"ToleranceWord", "start_tolerance: 0.03", "start_tolerance: little", 52, "planning.start_tolerance", "\"little\"",
               "expected a number >= 0 (s)"},
        Broken{"UnknownKey", "strategy: direct", "strateg: direct", 50, "planning.strateg", "", "did you mean \"strategy\"?"},
        Broken{"EscapesWord", "escapes: false", "escapes: no", 53, "planning.escapes", "\"no\"", "expected true or false"},
        Broken{"EscapesList", "escapes: false", "escapes: [true]", 53, "planning.escapes", "[true]", "expected true or false"},
        Broken{"EscapesMistyped", "escapes: false", "escapes: fals", 53, "planning.escapes", "\"fals\"", "did you mean \"false\"?"},
        Broken{"ZoneNoMapping", "zone: {min: [100, -130, 0], max: [600, 130, 900]}", "zone: middle", 54, "planning.zone", "\"middle\"",
               "expected a mapping with the keys min or max"},
        Broken{"ZoneHalf", ", max: [600, 130, 900]}", "}", 54, "planning.zone.max", "", "required key is missing"},
        Broken{"ZoneUnknownKey", "zone: {min:", "zone: {mim: 1, min:", 54, "planning.zone.mim", "", "did you mean \"min\"?"},
        Broken{"ZoneTwoNumbers", "max: [600, 130, 900]", "max: [600, 130]", 54, "planning.zone.max", "[600, 130]",
               "expected a list of 3 numbers (mm)"},
        Broken{"ZoneWord", "min: [100,", "min: [left,", 54, "planning.zone.min[0]", "\"left\"", "expected a finite number (mm)"},
        Broken{"ZoneUpsideDown", "max: [600, 130, 900]", "max: [600, 130, -1]", 54, "planning.zone.max", "[600, 130, -1]",
               "expected min < max, but z has 0 mm and -1 mm"},
        Broken{"ZoneFlat", "max: [600, 130, 900]", "max: [600, -130, 900]", 54, "planning.zone.max", "[600, -130, 900]",
               "expected min < max, but y has -130 mm and -130 mm"},
        Broken{"NoMapping",
               "planning:\n  resolution: 0.02\n  margin: 5\n  strategy: direct\n  lead: 0.05\n  start_tolerance: 0.03\n  escapes: false\n  "
               "zone: {min: [100, "
               "-130, 0], max: [600, 130, 900]}\n",
               "planning: fast\n", 47, "planning", "\"fast\"", "expected a mapping"}),
    case_name);

TEST(CellRules, ChainNeedsAnArmWithoutOffsets) {
  const std::string text = replaced(replaced(kCell, kCapsules, "    capsules: {chain: [112, 117, 100, 48]}\n"), "a1: 0", "a1: 30");
  const Broken expected{"", "", "", 23, "models.arm.capsules.chain", "[112, 117, 100, 48]", "arm without offsets"};
  samples::expect_only(samples::cell_findings(text), expected, "cell.yaml");
}

TEST(CellRules, StartOutsideTheJointLimitsNamesJointAngleAndLimits) {
  const auto findings = samples::cell_findings(replaced(kCell, "max: [170, 180", "max: [170, 40.01"));
  ASSERT_EQ(findings.size(), 2U) << to_string(ConfigError{findings});
  EXPECT_EQ(findings[0].line, 33);
  EXPECT_EQ(findings[0].key, "robots[0].start");
  EXPECT_EQ(findings[0].rule,
            "outside the joint limits of model arm in every posture: at best joint 2 would be at 40.0355 deg, outside its limits -90 deg "
            "to 40.01 deg");
  EXPECT_EQ(findings[1].key, "robots[1].start");
}

TEST(CellRules, TooManyRobots) {
  std::string robots = "robots:\n";
  for (std::size_t i = 0; i <= kMaxRobots; ++i) robots += "  - {}\n";
  const auto findings = samples::cell_findings("interlace: 1\nunits: {length: mm, angle: deg}\ncell: x\n" + robots + "models: {a: {}}\n");
  ASSERT_FALSE(findings.empty());
  EXPECT_NE(to_string(ConfigError{findings}).find("expected 1 to 128 robots"), std::string::npos) << to_string(ConfigError{findings});
}

TEST(CellRules, NoRobots) {
  const auto at = kCell.find("robots:\n");
  const auto end = kCell.find("fixtures:");
  const auto findings = samples::cell_findings(kCell.substr(0, at) + "robots: []\n" + kCell.substr(end));
  samples::expect_only(findings, {"", "", "", 29, "robots", "[]", "expected 1 to 128 robots"}, "cell.yaml");
}

TEST(CellRules, AllMistakesAreToldAtOnceInTheOrderOfTheFile) {
  std::string text = replaced(kCell, "margin: 5", "margin: nan");
  text = replaced(text, "velocity: 100\n", "velocity: fast\n");
  text = replaced(text, "length: mm", "length: inch");
  const auto findings = samples::cell_findings(text);
  ASSERT_EQ(findings.size(), 3U) << to_string(ConfigError{findings});
  EXPECT_EQ(findings[0].line, 2);
  EXPECT_EQ(findings[1].line, 36);
  EXPECT_EQ(findings[2].line, 49);
  EXPECT_EQ(to_string(findings[1]), "cell.yaml:36:17: robots[0].tcp.velocity: found \"fast\", expected a number > 0 (mm/s)");
}

TEST(CellRules, AFloodOfMistakesIsCut) {
  std::string text = kCell;
  for (int i = 0; i < 1000; ++i) text += "wrong" + std::to_string(i) + ": 1\n";
  const auto findings = samples::cell_findings(text);
  ASSERT_EQ(findings.size(), Findings::kMost + 1);
  EXPECT_EQ(findings.back().rule, "and 950 more");
}

TEST(CellRules, LongAndStrangeValuesAreShortenedToOneLine) {
  const auto findings = samples::cell_findings(replaced(kCell, "velocity: 100\n", "velocity: \"" + std::string(5000, 'x') + "\\n\"\n"));
  ASSERT_EQ(findings.size(), 1U);
  EXPECT_LT(to_string(findings[0]).size(), 200U);
  EXPECT_EQ(to_string(findings[0]).find('\n'), std::string::npos);
}

}  // namespace
}  // namespace interlace::app
