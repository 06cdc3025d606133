#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/config/samples.hpp"

namespace interlace::app {
namespace {

using model::Vector3;

/// A command of the tables: mm and deg as printed, its roll about z and its pitch about y.
struct Row {
  double x, y, z, roll, pitch;
};
/// Start of a robot's TCP [mm], always 300 mm high and turned by its `roll` about z [deg], and its commands.
struct RobotTable {
  double x, y, roll;
  std::vector<Row> rows;
};
struct Experiment {
  const char* folder;
  std::vector<RobotTable> robots;
};

class ExperimentCell : public testing::TestWithParam<Experiment> {
 protected:
  const std::string folder_ = std::string{INTERLACE_CELLS_DIR} + "/" + GetParam().folder;
};

void expect_target(const model::ProgramStep& step, const Row& row) {
  const auto* line = std::get_if<model::LinearTarget>(&step.motion.target);
  ASSERT_NE(line, nullptr);
  EXPECT_TRUE(line->X_WT.translation().isApprox(Vector3{row.x, row.y, row.z} / 1000, 1e-12)) << line->X_WT.translation().transpose();
  const double degree = model::kPi / 180;
  const Eigen::Matrix3d R =
      (Eigen::AngleAxisd{row.roll * degree, Vector3::UnitZ()} * Eigen::AngleAxisd{row.pitch * degree, Vector3::UnitY()}).toRotationMatrix();
  EXPECT_TRUE(line->X_WT.linear().isApprox(R, 1e-12)) << line->X_WT.linear();
}

TEST_P(ExperimentCell, LoadsWithItsProgram) {
  const auto loaded = load_cell(folder_ + "/cell.yaml");
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  EXPECT_EQ(loaded->cell.name, GetParam().folder);
  const auto& tables = GetParam().robots;
  ASSERT_EQ(loaded->cell.robots.size(), tables.size());
  for (std::size_t i = 0; i < tables.size(); ++i) {
    const auto& robot = loaded->cell.robots[i];
    EXPECT_EQ(robot.name.str(), "r" + std::to_string(i + 1));
    const model::Pose X_WT = robot.X_WB * model::tcp_pose(robot.model, robot.start);
    EXPECT_TRUE(X_WT.translation().isApprox(Vector3{tables[i].x, tables[i].y, 300} / 1000, 1e-9)) << X_WT.translation().transpose();
    const double roll = tables[i].roll * model::kPi / 180;
    EXPECT_TRUE(X_WT.linear().col(0).isApprox(Vector3{std::cos(roll), std::sin(roll), 0}, 1e-9)) << X_WT.linear();
    EXPECT_TRUE(robot.home == robot.start);
    EXPECT_TRUE(robot.model.joints.min == model::JointLimits{}.min && robot.model.joints.max == model::JointLimits{}.max);
    EXPECT_FALSE(robot.model.joints.velocity.has_value()) << "the dissertation gives no joint limits";
    EXPECT_DOUBLE_EQ(robot.tcp.velocity, 0.1);
    EXPECT_DOUBLE_EQ(robot.tcp.acceleration, 0.1);
    ASSERT_EQ(robot.model.capsules.size(), 4U);
    EXPECT_DOUBLE_EQ(robot.model.capsules[1].radius, 0.117);
  }
  const auto program = load_program(folder_ + "/program.yaml", &loaded->cell);
  ASSERT_TRUE(program) << to_string(program.error());
  ASSERT_EQ(program->robots.size(), tables.size());
  for (std::size_t robot = 0; robot < tables.size(); ++robot) {
    const auto& steps = program->robots[robot].second;
    const auto& rows = tables[robot].rows;
    ASSERT_EQ(steps.size(), 2 * rows.size()) << "the programs are doubled";
    for (std::size_t i = 0; i < steps.size(); ++i) expect_target(steps[i], rows[i % rows.size()]);
  }
}

const std::vector<Row> k41R1{
    {300, 250, 300, 0, 0}, {500, -50, 360, 0, -20}, {300, 250, 300, 0, 0}, {500, 15, 360, 0, 0}, {300, 250, 300, 0, 0}};
const std::vector<Row> k41R2{
    {300, -250, 300, 0, 0}, {500, 0, 250, 0, -20}, {300, -250, 300, 0, 0}, {500, -15, 300, 0, 0}, {300, -250, 300, 0, 0}};
const std::vector<Row> k42R1{{300, 250, 330, 0, 0}, {350, 0, 200, 0, 0}, {350, -51, 200, 0, 0}, {400, 250, 330, 0, 0}};
const std::vector<Row> k42R2{{300, -250, 330, 0, 0}, {350, 0, 200, 0, 0}, {350, 51, 200, 0, 0}, {400, -250, 330, 0, 0}};
const std::vector<Row> k51R1{
    {300, 250, 300, -90, 0}, {400, -50, 300, -90, 0}, {400, -50, 100, -90, 0}, {400, 400, 100, 0, 0}, {300, 250, 300, 0, 0}};
const std::vector<Row> k51R2{
    {300, -250, 300, 90, 0}, {400, 50, 300, 90, 0}, {400, 50, 100, 90, 0}, {400, -400, 100, 0, 0}, {300, -250, 300, 0, 0}};

const std::vector<Row> k61R1{{300, 250, 300, 0, 0}, {300, 400, 360, 30, 0}, {300, 0, 150, 0, 0}, {300, 250, 300, 0, 0}};
const std::vector<Row> k61R2{{300, -250, 300, 0, 0}, {300, -400, 150, -30, 0}, {300, 0, 150, 0, 0}, {300, -250, 300, 0, 0}};
const std::vector<Row> k61R3{{300, 0, 300, -180, 0}, {200, 0, 200, -180, 0}, {450, -300, 200, 90, 0}, {300, 0, 300, -180, 0}};
const std::vector<Row> k62R1{{300, 750, 300, 0, 0}, {400, 1000, 150, 30, 0}, {400, 500, 150, -30, 0}, {400, 750, 300, 0, 0}};
const std::vector<Row> k62R2{{300, 250, 300, 0, 0}, {400, 0, 150, -30, 0}, {400, 500, 150, 30, 0}, {400, 250, 300, 0, 0}};
const std::vector<Row> k62R3{{300, -250, 300, 0, 0}, {400, 0, 200, 30, 0}, {400, -500, 200, -30, 0}, {400, -250, 300, 0, 0}};
const std::vector<Row> k62R4{{300, -750, 300, 0, 0}, {400, -1000, 200, -30, 0}, {400, -500, 200, 30, 0}, {400, -750, 300, 0, 0}};

Experiment two_robots(const char* folder, const std::vector<Row>& r1, const std::vector<Row>& r2) {
  return {folder, {{450, 250, 0, r1}, {450, -250, 0, r2}}};
}

template <typename T>
std::string test_name(const testing::TestParamInfo<T>& param_info) {
  std::string name = param_info.param.folder;
  for (auto& c : name) c = c == '-' ? '_' : c;
  return name;
}

INSTANTIATE_TEST_SUITE_P(
    Deployed, ExperimentCell,
    testing::Values(two_robots("exp-4-1", k41R1, k41R2), two_robots("exp-4-2", k42R1, k42R2), two_robots("exp-4-2-latency", k42R1, k42R2),
                    two_robots("exp-5-1", k51R1, k51R2), two_robots("exp-5-2", k42R1, k42R2),
                    Experiment{"exp-6-1", {{450, 250, 0, k61R1}, {450, -250, 0, k61R2}, {150, 0, -180, k61R3}}},
                    Experiment{"exp-6-2", {{450, 750, 0, k62R1}, {450, 250, 0, k62R2}, {450, -250, 0, k62R3}, {450, -750, 0, k62R4}}}),
    test_name<Experiment>);

struct Pattern {
  const char* folder;
  std::size_t robots;
  double nearest;  // distance of the two nearest bases [m]
};

class PatternCell : public testing::TestWithParam<Pattern> {};

TEST_P(PatternCell, LoadsWithArmsOfTheDissertation) {
  const auto loaded = load_cell(std::string{INTERLACE_CELLS_DIR} + "/" + GetParam().folder + "/cell.yaml");
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  const model::Cell& cell = loaded->cell;
  EXPECT_EQ(cell.name, GetParam().folder);
  ASSERT_EQ(cell.robots.size(), GetParam().robots);
  double nearest = 1e9;
  for (std::size_t i = 0; i < cell.robots.size(); ++i) {
    const auto& robot = cell.robots[i];
    EXPECT_DOUBLE_EQ(robot.tcp.velocity, 0.1);
    EXPECT_TRUE(robot.model.joints.velocity && robot.model.joints.acceleration) << "joint moves need them";
    for (std::size_t j = 0; j < i; ++j) nearest = std::min(nearest, (robot.X_WB.translation() - cell.robots[j].X_WB.translation()).norm());
    // Tucked: the TCP stands 200 mm in front of the base and 500 mm high.
    const Vector3 p_BT = model::tcp_pose(robot.model, robot.home).translation();
    EXPECT_TRUE(p_BT.isApprox(Vector3{0.2, 0, 0.5}, 1e-4)) << p_BT.transpose();
  }
  EXPECT_NEAR(nearest, GetParam().nearest, 1e-4);
}

INSTANTIATE_TEST_SUITE_P(Deployed, PatternCell,
                         testing::Values(Pattern{"pattern-triangle-3", 3, 0.5}, Pattern{"pattern-serial-3", 3, 0.5},
                                         Pattern{"pattern-zigzag-4", 4, 0.5}, Pattern{"pattern-square-4", 4, 0.5},
                                         Pattern{"pattern-serial-4", 4, 0.5}, Pattern{"pattern-ring-5", 5, 0.5},
                                         Pattern{"pattern-serial-6", 6, 0.5}, Pattern{"pattern-serial-8", 8, 0.5}),
                         test_name<Pattern>);

TEST(ExperimentCells, TheLatencyVariantHasLatency) {
  const auto loaded = load_cell(std::string{INTERLACE_CELLS_DIR} + "/exp-4-2-latency/cell.yaml");
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  for (const auto& robot : loaded->cell.robots) {
    EXPECT_DOUBLE_EQ(robot.controller.start_latency, 0.02);
    EXPECT_DOUBLE_EQ(robot.controller.start_jitter, 0.01);
  }
}

}  // namespace
}  // namespace interlace::app
