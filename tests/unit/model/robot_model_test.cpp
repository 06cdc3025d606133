#include "common/model/robot_model.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "tests/support/motions.hpp"

namespace interlace::test {
namespace {

using model::Branch;
using model::Joints;
using model::Vector3;

TEST(RobotModel, AtZeroTheArmStandsUpright) {
  const auto X = arm4().kinematics.forward(Joints::Zero());
  EXPECT_TRUE(X[3].translation().isApprox(Vector3{0, 0, 0.55}));
  EXPECT_TRUE(X[4].translation().isApprox(Vector3{0, 0, 0.82}));
  EXPECT_TRUE(X[6].translation().isApprox(Vector3{0, 0, 0.91}));
  EXPECT_TRUE(X[6].linear().isIdentity(1e-12));
}

TEST(RobotModel, TheChainOfCapsulesFollowsTheAxes) {
  const auto m = arm4();
  std::vector<model::Capsule> bodies;
  Seed seed;
  for (int i = 0; i < 100; ++i) {
    const Joints q = random_joints(seed, m);
    const auto X = m.kinematics.forward(q);
    model::place_capsules(m, model::Pose::Identity(), q, bodies);
    ASSERT_EQ(bodies.size(), 4U);
    EXPECT_TRUE(bodies[0].a.isZero(1e-12));
    for (std::size_t k = 1; k < bodies.size(); ++k)
      EXPECT_LE((bodies[k].a - bodies[k - 1].b).norm(), 1e-12) << "no gap between the sections";
    EXPECT_LE((bodies[2].b - X[4].translation()).norm(), 1e-12);
    EXPECT_LE((bodies[3].b - model::tcp_pose(m, q).translation()).norm(), 1e-12);
    EXPECT_EQ(bodies[1].radius, 0.117);
  }
}

TEST(RobotModel, AChainIsOnlyForArmsWithoutOffsets) {
  EXPECT_THROW((void)model::chain_capsules(offset_arm_parameters(), model::Pose::Identity(), {1, 1, 1, 1}), std::invalid_argument);
}

TEST(RobotModel, SelfPairsLeaveOutNeighbours) {
  const auto m = arm4();
  EXPECT_EQ(m.self_pairs, (std::vector<std::pair<std::size_t, std::size_t>>{{0, 3}})) << "base and gripper";
}

TEST(RobotModel, PreferredPostureIsElbowUpAndWithinItsLimits) {
  const auto cell = experiment_cell();
  for (const auto& robot : cell->robots) {
    EXPECT_FALSE(model::joint_outside_limits(robot.model.joints, robot.start));
    const Branch branch = robot.model.kinematics.branch_of(robot.start);
    EXPECT_EQ(branch.elbow, Branch::Elbow::up);
    EXPECT_EQ(branch.shoulder, Branch::Shoulder::front);
    const auto X = robot.model.kinematics.forward(robot.start);
    const Vector3 shoulder = X[2].translation();
    const Vector3 wrist = X[4].translation();
    const double share = (X[3].translation() - shoulder).head<2>().norm() / (wrist - shoulder).head<2>().norm();
    EXPECT_GT(X[3].translation().z(), shoulder.z() + share * (wrist.z() - shoulder.z())) << "above the line shoulder → wrist";
  }
}

TEST(RobotModel, PreferredPostureReachesEveryPoseThatAPostureHas) {
  Seed seed{5};
  const auto m = arm4();
  for (int i = 0; i < 2000; ++i) {
    const auto X = model::tcp_pose(m, random_joints(seed, m));
    const auto q = model::preferred_posture(m, X);
    ASSERT_TRUE(q);
    EXPECT_FALSE(model::joint_outside_limits(m.joints, *q));
    EXPECT_LE((model::tcp_pose(m, *q).matrix() - X.matrix()).cwiseAbs().maxCoeff(), 1e-9);
  }
}

TEST(RobotModel, PreferredPostureTakesOnlyBranchesThatAreAdmitted) {
  const auto m = arm4();
  const auto X = model::tcp_pose(m, experiment_cell()->robots[0].start);
  const auto down = model::preferred_posture(m, X, [](const Branch& b) { return b.elbow == Branch::Elbow::down; });
  EXPECT_TRUE(!down || m.kinematics.branch_of(*down).elbow == Branch::Elbow::down);
  EXPECT_FALSE(model::preferred_posture(m, X, [](const Branch&) { return false; }));
}

TEST(RobotModel, OutOfReachHasNoPosture) {
  auto X = model::Pose::Identity();
  X.translation() = Vector3{2, 0, 0.3};
  EXPECT_FALSE(model::preferred_posture(arm4(), X));
}

TEST(Kinematics, EveryBranchIsRecognised) {
  Seed seed{6};
  const auto m = arm4();
  for (int i = 0; i < 1000; ++i) {
    const auto X = m.kinematics.flange(random_joints(seed, m));
    for (const Branch& branch : model::all_branches()) {
      const auto q = m.kinematics.inverse(X, branch);
      ASSERT_TRUE(q);
      EXPECT_TRUE(m.kinematics.branch_of(*q) == branch);
    }
  }
}

}  // namespace
}  // namespace interlace::test
