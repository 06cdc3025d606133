#include <gtest/gtest.h>

#include "tests/unit/config/samples.hpp"

namespace interlace::app {
namespace {

using model::kPi;
using samples::kCell;
using samples::replaced;

constexpr double kDegree = kPi / 180;
constexpr double kExact = 1e-12;  // [m], [rad] rounding of the conversion of units

model::Cell accepted(const std::string& text) {
  const auto loaded = parse_cell(text, "cell.yaml");
  EXPECT_TRUE(loaded) << (loaded ? "" : to_string(loaded.error()));
  return loaded ? loaded->cell : model::Cell{};
}

TEST(CellValues, EveryKeyArrivesInSiUnits) {
  const auto cell = accepted(kCell);
  EXPECT_EQ(cell.name, "sample");
  ASSERT_EQ(cell.robots.size(), 2U);
  const auto& r1 = cell.robots[0];
  EXPECT_EQ(r1.name.str(), "r1");
  const auto& p = r1.model.kinematics.parameters();
  EXPECT_DOUBLE_EQ(p.c1, 0.290);
  EXPECT_DOUBLE_EQ(p.c2, 0.260);
  EXPECT_DOUBLE_EQ(p.c3, 0.270);
  EXPECT_DOUBLE_EQ(p.c4, 0.090);
  EXPECT_NEAR(r1.model.joints.min[0], -170 * kDegree, kExact);
  EXPECT_NEAR(r1.model.joints.max[2], 250 * kDegree, kExact);
  ASSERT_TRUE(r1.model.joints.velocity && r1.model.joints.acceleration);
  EXPECT_NEAR((*r1.model.joints.velocity)[5], 400 * kDegree, kExact);
  EXPECT_NEAR((*r1.model.joints.acceleration)[5], 1000 * kDegree, kExact);
  ASSERT_EQ(r1.model.capsules.size(), 4U);
  EXPECT_EQ(r1.model.capsules[3].name, "hand");
  EXPECT_EQ(r1.model.capsules[3].link, 6U);
  EXPECT_TRUE(r1.model.capsules[3].a.isApprox(model::Vector3{0, 0, -0.09}, kExact));
  EXPECT_DOUBLE_EQ(r1.model.capsules[3].radius, 0.048);
  EXPECT_EQ(r1.model.self_pairs, (std::vector<std::pair<std::size_t, std::size_t>>{{0, 3}}));
  EXPECT_TRUE(r1.X_WB.translation().isApprox(model::Vector3{0, 0.25, 0}, kExact));
  EXPECT_NEAR(r1.home[1], 40 * kDegree, kExact);
  EXPECT_DOUBLE_EQ(r1.tcp.velocity, 0.1);
  EXPECT_DOUBLE_EQ(r1.tcp.acceleration, 0.2);
  EXPECT_NEAR(r1.tcp.angular_velocity.value_or(0), 90 * kDegree, kExact);
  EXPECT_NEAR(r1.tcp.angular_acceleration.value_or(0), 180 * kDegree, kExact);
  EXPECT_DOUBLE_EQ(r1.controller.start_latency, 0.02);
  EXPECT_DOUBLE_EQ(r1.controller.start_jitter, 0.01);
  EXPECT_DOUBLE_EQ(r1.controller.speed_error, 0.001);
  EXPECT_DOUBLE_EQ(r1.controller.path_error, 0.002);
  EXPECT_DOUBLE_EQ(cell.planning.resolution, 0.02);
  EXPECT_DOUBLE_EQ(cell.planning.margin, 0.005);
  EXPECT_EQ(cell.planning.strategy, "direct");
  EXPECT_FALSE(cell.planning.escapes);
  EXPECT_DOUBLE_EQ(cell.planning.lead.value_or(0), 0.05);
  EXPECT_DOUBLE_EQ(cell.planning.start_tolerance.value_or(0), 0.03);
  ASSERT_TRUE(cell.planning.zone);
  EXPECT_TRUE(cell.planning.zone->min.isApprox(model::Vector3{0.1, -0.13, 0}, kExact));
  EXPECT_TRUE(cell.planning.zone->max.isApprox(model::Vector3{0.6, 0.13, 0.9}, kExact));
}

TEST(CellValues, WhatIsLeftOutHasItsDefault) {
  const auto cell = accepted(R"(interlace: 1
units: {length: m, angle: rad}
cell: small
models:
  arm:
    kinematics: {type: opw, a1: 0, a2: 0, b: 0, c1: 0.29, c2: 0.26, c3: 0.27, c4: 0.09}
    capsules: {chain: [0.112, 0.117, 0.1, 0.048]}
robots:
  - name: only
    model: arm
    base: {xyz: [0, 0, 0], rpy: [0, 0, 1.5]}
    start: {joints: [0, 0.7, 1.6, 0, 0.5, 0]}
    tcp: {velocity: 0.1, acceleration: 0.1}
)");
  ASSERT_EQ(cell.robots.size(), 1U);
  const auto& robot = cell.robots[0];
  EXPECT_EQ(robot.home, robot.start);
  EXPECT_DOUBLE_EQ(robot.start[1], 0.7);
  EXPECT_TRUE(robot.model.X_FT.isApprox(model::Pose::Identity(), kExact));
  EXPECT_DOUBLE_EQ(robot.model.joints.max[0], 2 * kPi);
  EXPECT_FALSE(robot.model.joints.velocity);
  EXPECT_FALSE(robot.tcp.angular_velocity);
  EXPECT_EQ(robot.controller.latest_start(), 0);
  EXPECT_EQ(robot.model.self_pairs, model::default_self_pairs(robot.model.capsules));
  EXPECT_FALSE(cell.planning.zone);
  EXPECT_EQ(cell.planning.strategy, "lookahead");
  EXPECT_EQ(cell.planning.promise, 0) << "who wants starts that rely on promised departures has to say so";
  EXPECT_TRUE(cell.planning.escapes);
  EXPECT_DOUBLE_EQ(cell.planning.resolution, 0.01);
  EXPECT_FALSE(cell.planning.lead);
}

TEST(CellValues, EveryStrategyAndItsBudget) {
  for (const std::string name : {"direct", "zone", "eef-map", "acm", "event", "lookahead"}) {
    const auto cell = accepted(replaced(kCell, "strategy: direct", "strategy: " + name + "\n  budget: 0.5\n  promise: 1.5"));
    EXPECT_EQ(cell.planning.strategy, name);
    EXPECT_EQ(cell.planning.budget, 0.5);
    EXPECT_EQ(cell.planning.promise, 1.5);
  }
}

TEST(CellValues, StartPoseIsReachedElbowUp) {
  const auto cell = accepted(kCell);
  const auto& r2 = cell.robots.at(1);
  const model::Pose X_WT = r2.X_WB * model::tcp_pose(r2.model, r2.start);
  EXPECT_TRUE(X_WT.translation().isApprox(model::Vector3{0.45, -0.25, 0.3}, 1e-9)) << X_WT.translation().transpose();
  EXPECT_TRUE(X_WT.linear().isApprox(Eigen::Matrix3d::Identity(), 1e-9));
  EXPECT_TRUE(r2.model.kinematics.branch_of(r2.start).elbow == model::Branch::Elbow::up);
}

TEST(CellValues, PostureKeyChoosesTheBranch) {
  std::string text = replaced(kCell, "elbow: up}", "elbow: down, wrist: positive}");
  text =
      replaced(text, "home: {joints: [0, 40, 94, 0, -44, 0]}", "home: {xyz: [450, 250, 300], rpy: [0, 0, 0], posture: {wrist: positive}}");
  const auto cell = accepted(text);
  const auto& r1 = cell.robots.at(0);
  EXPECT_TRUE(r1.model.kinematics.branch_of(r1.start) ==
              (model::Branch{model::Branch::Shoulder::front, model::Branch::Elbow::down, model::Branch::Wrist::positive}));
  EXPECT_TRUE(r1.model.kinematics.branch_of(r1.home) ==
              (model::Branch{model::Branch::Shoulder::front, model::Branch::Elbow::up, model::Branch::Wrist::positive}));
}

TEST(CellValues, OffsetsAndSignsArrive) {
  std::string text = replaced(kCell, "offsets: [0, 0, 0, 0, 0, 0]", "offsets: [0, 90, 0, 0, 0, -180]");
  text = replaced(text, "signs: [1, 1, 1, 1, 1, 1]", "signs: [1, -1, 1, 1, 1, 1]");
  text = replaced(text, "joints: [0, 40, 94, 0, -44, 0]", "joints: [0, -130, 94, 0, -44, 0]");
  text = replaced(text, "min: [-170, -90", "min: [-170, -190");
  const auto cell = accepted(text);
  const auto& p = cell.robots.at(0).model.kinematics.parameters();
  EXPECT_NEAR(p.offsets[1], kPi / 2, kExact);
  EXPECT_NEAR(p.offsets[5], -kPi, kExact);
  EXPECT_EQ(p.signs[1], -1);
  EXPECT_EQ(p.signs[0], 1);
}

TEST(CellValues, NumbersMayHaveAPlusAndAnExponent) {
  EXPECT_DOUBLE_EQ(accepted(replaced(kCell, "velocity: 100\n", "velocity: +1.5e2\n")).robots.at(0).tcp.velocity, 0.15);
}

TEST(CellValues, AnEmptySelfCollisionListChecksNothing) {
  const auto cell = accepted(replaced(kCell, "[[base, hand]]", "[]"));
  EXPECT_TRUE(cell.robots.at(0).model.self_pairs.empty());
}

}  // namespace
}  // namespace interlace::app
