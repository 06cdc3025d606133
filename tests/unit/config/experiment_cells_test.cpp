#include <gtest/gtest.h>

#include "tests/unit/config/samples.hpp"

namespace interlace::app {
namespace {

using model::Vector3;

/// A command of the tables: mm and deg as printed, its roll about z and its pitch about y.
struct Row {
  double x, y, z, roll, pitch;
};
struct Experiment {
  const char* folder;
  std::vector<Row> r1, r2;
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
  ASSERT_EQ(loaded->cell.robots.size(), 2U);
  for (const auto& robot : loaded->cell.robots) {
    const double side = robot.name.str() == "r1" ? 1 : -1;
    const model::Pose X_WT = robot.X_WB * model::tcp_pose(robot.model, robot.start);
    EXPECT_TRUE(X_WT.translation().isApprox(Vector3{0.45, side * 0.25, 0.3}, 1e-9));
    EXPECT_DOUBLE_EQ(robot.tcp.velocity, 0.1);
    EXPECT_DOUBLE_EQ(robot.tcp.acceleration, 0.1);
    ASSERT_EQ(robot.model.capsules.size(), 4U);
    EXPECT_DOUBLE_EQ(robot.model.capsules[1].radius, 0.117);
  }
  const auto program = load_program(folder_ + "/program.yaml", &loaded->cell);
  ASSERT_TRUE(program) << to_string(program.error());
  ASSERT_EQ(program->robots.size(), 2U);
  const std::vector<std::vector<Row>> tables{GetParam().r1, GetParam().r2};
  for (std::size_t robot = 0; robot < 2; ++robot) {
    const auto& steps = program->robots[robot].second;
    const auto& rows = tables[robot];
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

INSTANTIATE_TEST_SUITE_P(Deployed, ExperimentCell,
                         testing::Values(Experiment{"exp-4-1", k41R1, k41R2}, Experiment{"exp-4-2", k42R1, k42R2},
                                         Experiment{"exp-4-2-latency", k42R1, k42R2}, Experiment{"exp-5-1", k51R1, k51R2}),
                         [](const testing::TestParamInfo<Experiment>& param_info) {
                           std::string name = param_info.param.folder;
                           for (auto& c : name) c = c == '-' ? '_' : c;
                           return name;
                         });

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
