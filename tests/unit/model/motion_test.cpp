#include "common/model/motion.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/motions.hpp"

namespace interlace::test {
namespace {

using model::Joints;
using model::Motion;
using model::Reason;

model::Robot one_robot() {
  return experiment_cell()->robots[0];
}

TEST(LinearMotion, MovesTheTcpOnAStraightLine) {
  Seed seed{7};
  const auto robot = one_robot();
  for (int i = 0; i < 200; ++i) {
    const Motion motion = random_linear(seed, robot);
    if (motion.duration() == 0) continue;
    const auto X0 = motion.tcp(0);
    const auto X1 = motion.tcp(motion.duration());
    for (double share = 0; share <= 1; share += 0.05) {
      const double t = share * motion.duration();
      const auto X = motion.tcp(t);
      // The joints put the TCP where the motion says it is.
      EXPECT_LE(((robot.X_WB * model::tcp_pose(robot.model, motion.joints(t))).matrix() - X.matrix()).cwiseAbs().maxCoeff(), 1e-9);
      const model::Vector3 line = X1.translation() - X0.translation();
      EXPECT_LE((X.translation() - X0.translation()).cross(line).norm(), 1e-9);
      EXPECT_NEAR(motion.length(t), (X.translation() - X0.translation()).norm(), 1e-9);
    }
  }
}

TEST(LinearMotion, JointsAreContinuousAndKeepTheBranch) {
  Seed seed{8};
  const auto robot = one_robot();
  for (int i = 0; i < 200; ++i) {
    const Motion motion = random_linear(seed, robot);
    const auto branch = robot.model.kinematics.branch_of(motion.from());
    Joints before = motion.from();
    for (int k = 1; k <= 2000; ++k) {
      const Joints q = motion.joints(motion.duration() * k / 2000);
      EXPECT_LE((q - before).cwiseAbs().maxCoeff(), 0.2) << "step " << k;
      EXPECT_TRUE(robot.model.kinematics.branch_of(q) == branch || std::abs(std::sin(q[4])) < 1e-6);
      before = q;
    }
    EXPECT_EQ(motion.joints(motion.duration()), motion.to());
    EXPECT_EQ(motion.joints(-1), motion.from());
    EXPECT_EQ(motion.joints(motion.duration() + 1), motion.to());
  }
}

TEST(LinearMotion, TakesTheTimeOfATrapezoid) {
  const auto robot = one_robot();
  const auto motion = model::plan_motion(robot, robot.start, line_to(pose_mm(300, 250, 300)));
  ASSERT_TRUE(motion);
  EXPECT_NEAR(motion->duration(), 0.15 / 0.1 + 0.1 / 0.1, 1e-9) << "150 mm at 100 mm/s and 100 mm/s²";
  auto slow = line_to(pose_mm(300, 250, 300));
  slow.velocity = 0.05;
  EXPECT_NEAR(model::plan_motion(robot, robot.start, slow)->duration(), 0.15 / 0.05 + 0.05 / 0.1, 1e-9);
}

TEST(LinearMotion, ToWhereItStandsTakesNoTime) {
  const auto robot = one_robot();
  const auto motion = model::plan_motion(robot, robot.start, line_to(robot.X_WB * model::tcp_pose(robot.model, robot.start)));
  ASSERT_TRUE(motion);
  EXPECT_EQ(motion->duration(), 0);
  EXPECT_EQ(motion->to(), robot.start);
}

TEST(LinearMotion, AngularLimitsStretchTheWholeMotion) {
  auto robot = one_robot();
  robot.tcp.angular_velocity = 0.1;
  robot.tcp.angular_acceleration = 1;
  const auto motion = model::plan_motion(robot, robot.start, line_to(pose_mm(430, 250, 300, 0, -30)));
  ASSERT_TRUE(motion);
  EXPECT_NEAR(motion->duration(), kPi / 6 / 0.1 + 0.1, 1e-6) << "the turn takes longer than the 20 mm";
}

TEST(LinearMotion, RefusesWithThePlaceOnThePath) {
  const auto robot = one_robot();
  const auto far = model::plan_motion(robot, robot.start, line_to(pose_mm(900, 250, 300)));
  ASSERT_FALSE(far);
  EXPECT_EQ(far.error().reason, Reason::unreachable);
  EXPECT_GT(far.error().progress, 0.3);
  EXPECT_LT(far.error().progress, 0.5) << "the arm is stretched at 620 mm";
  EXPECT_NEAR(far.error().p_WTcp.x(), 0.62, 0.01);
  EXPECT_NE(far.error().text.find("out of reach"), std::string::npos);
}

TEST(LinearMotion, RefusesASingularityOnItsWay) {
  // From the front over the first axis to the back: the arm would have to turn half a turn at once.
  const auto robot = one_robot();
  const auto over = model::plan_motion(robot, robot.start, line_to(pose_mm(-300, 250, 300)));
  ASSERT_FALSE(over);
  EXPECT_NE(over.error().reason, Reason::none);
  EXPECT_GT(over.error().progress, 0.1);
}

TEST(LinearMotion, RefusesJointLimitsAndSpeeds) {
  auto robot = one_robot();
  robot.model.joints.velocity = Joints::Constant(0.05);
  const auto fast = model::plan_motion(robot, robot.start, line_to(pose_mm(300, 250, 330)));
  ASSERT_FALSE(fast);
  EXPECT_EQ(fast.error().reason, Reason::joint_speed);
  robot = one_robot();
  robot.model.joints.max[1] = robot.start[1] + 0.01;
  robot.model.joints.min[1] = robot.start[1] - 0.01;
  const auto bent = model::plan_motion(robot, robot.start, line_to(pose_mm(300, 250, 330)));
  ASSERT_FALSE(bent);
  EXPECT_EQ(bent.error().reason, Reason::joint_limit);
  EXPECT_NE(bent.error().text.find("joint 2"), std::string::npos) << bent.error().text;
}

TEST(LinearMotion, RefusesBadValues) {
  const auto robot = one_robot();
  auto request = line_to(pose_mm(300, 250, 330));
  for (const double bad : {0.0, -1.0, 0.11, std::nan(""), HUGE_VAL}) {
    request.velocity = bad;
    const auto motion = model::plan_motion(robot, robot.start, request);
    ASSERT_FALSE(motion) << bad;
    EXPECT_EQ(motion.error().reason, Reason::bad_request);
  }
}

TEST(JointMotion, IsSynchronisedAndKeepsItsLimits) {
  Seed seed{9};
  auto robot = one_robot();
  give_joint_rates(robot, 1.0, 2.0);
  for (int i = 0; i < 200; ++i) {
    const Motion motion = random_joint_move(seed, robot);
    EXPECT_EQ(motion.joints(0), motion.from());
    EXPECT_EQ(motion.joints(motion.duration()), motion.to());
    const double step = motion.duration() / 500;
    Joints before = motion.from();
    for (int k = 1; k <= 500; ++k) {
      const Joints q = motion.joints(step * k);
      for (std::size_t j = 0; j < model::kJoints; ++j) {
        EXPECT_LE(std::abs(q[j] - before[j]), 1.0 * step * (1 + 1e-6) + 1e-12);
        EXPECT_GE((q[j] - before[j]) * (motion.to()[j] - motion.from()[j]), -1e-12) << "never turns back";
      }
      before = q;
    }
    EXPECT_GE(motion.length(motion.duration()), (motion.tcp(motion.duration()).translation() - motion.tcp(0).translation()).norm() - 1e-9);
  }
}

TEST(JointMotion, NeedsRatesAndLimits) {
  auto robot = one_robot();
  EXPECT_EQ(model::plan_motion(robot, robot.start, joints_to(robot.home)).error().reason, Reason::bad_request);
  give_joint_rates(robot);
  Joints outside = robot.start;
  outside[0] = 3.1;
  EXPECT_EQ(model::plan_motion(robot, robot.start, joints_to(outside)).error().reason, Reason::joint_limit);
}

TEST(Rest, IsWhereItIsForever) {
  const auto robot = one_robot();
  const Motion rest = Motion::rest(robot, robot.start);
  EXPECT_EQ(rest.duration(), 0);
  EXPECT_EQ(rest.joints(5), robot.start);
  EXPECT_EQ(rest.length(5), 0);
  std::vector<double> bound;
  rest.displacement(0, 0, 0, bound);
  EXPECT_EQ(bound, std::vector<double>(4, 0.0));
}

}  // namespace
}  // namespace interlace::test
