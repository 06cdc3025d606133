#include "monitor/ros2/robot_description.hpp"

#include <gtest/gtest.h>
#include <urdf_parser/urdf_parser.h>

#include <algorithm>

#include "monitor/ros2/frames.hpp"
#include "tests/support/arms.hpp"

// What ROS 2's own reader makes of our URDF is the arm that we plan with.
namespace interlace::test {
namespace {

using model::Pose;

constexpr double kPlace = 1e-12;     // [m]
constexpr double kRotation = 1e-12;  // [rad], and of matrices their elements

Pose pose_of(const urdf::Pose& X) {
  return model::make_pose({X.position.x, X.position.y, X.position.z},
                          model::Quaternion{X.rotation.w, X.rotation.x, X.rotation.y, X.rotation.z});
}

/// Pose of a link in the root, with every joint turned by what `angle` says of it.
template <typename Angle>
Pose placed(const urdf::ModelInterface& urdf, const std::string& link, Angle&& angle) {
  const auto joint = urdf.getLink(link)->parent_joint;
  if (!joint) return Pose::Identity();
  Pose X = placed(urdf, joint->parent_link_name, angle) * pose_of(joint->parent_to_joint_origin_transform);
  if (joint->type == urdf::Joint::REVOLUTE)
    X.rotate(Eigen::AngleAxisd{angle(joint->name), model::Vector3{joint->axis.x, joint->axis.y, joint->axis.z}});
  return X;
}

void expect_same(const Pose& is, const Pose& should, const std::string& what) {
  EXPECT_LE((is.translation() - should.translation()).norm(), kPlace) << what;
  EXPECT_LE((is.linear() - should.linear()).cwiseAbs().maxCoeff(), kRotation) << what;
}

/// A cell of arms that stand anywhere, turned anyhow.
model::Cell random_cell(Seed& seed) {
  model::Cell cell;
  cell.name = "exp-6.2:a";
  for (const char* name : {"r1", "left-arm.2"}) {
    cell.robots.push_back(robot_at(name, random_arm(seed), random_point(seed, 2)));
    cell.robots.back().X_WB.rotate(random_rotation(seed));
  }
  return cell;
}

TEST(RobotDescription, MovesAsOurKinematicsDo) {
  Seed seed{71};
  for (std::size_t n = scaled(200); n > 0; --n) {
    const model::Cell cell = random_cell(seed);
    const auto urdf = urdf::parseURDF(monitor::robot_description(cell));
    ASSERT_TRUE(urdf);
    EXPECT_EQ(urdf->getName(), cell.name);
    EXPECT_EQ(urdf->getRoot()->name, monitor::kWorldFrame);
    for (const model::Robot& robot : cell.robots) {
      model::Joints q;
      for (double& angle : q) angle = seed.uniform(-kPi, kPi);
      const auto angle_of = [&](const std::string& joint) {
        for (std::size_t i = 0; i < model::kJoints; ++i) {
          if (joint == monitor::joint_name(robot.name, i)) return q[static_cast<Eigen::Index>(i)];
        }
        ADD_FAILURE() << "no joint of " << robot.name.str() << ": " << joint;
        return 0.0;
      };
      const model::LinkFrames X = robot.model.kinematics.forward(q);
      for (std::size_t link = 0; link < X.size(); ++link) {
        const std::string name = monitor::link_frame(robot.name, link);
        expect_same(placed(*urdf, name, angle_of), robot.X_WB * X[link], name);
      }
      expect_same(placed(*urdf, monitor::tcp_frame(robot.name), angle_of), robot.X_WB * model::tcp_pose(robot.model, q), "tcp");
    }
  }
}

/// The spheres and the ends of the cylinders of a link, as points with radii.
struct Ends {
  std::vector<std::pair<model::Vector3, double>> spheres, cylinders;

  template <typename Part>
  void add(const Part& part) {
    const Pose X = pose_of(part.origin);
    if (part.geometry->type == urdf::Geometry::SPHERE) {
      spheres.emplace_back(X.translation(), static_cast<const urdf::Sphere&>(*part.geometry).radius);
    } else if (part.geometry->type == urdf::Geometry::CYLINDER) {
      const auto& cylinder = static_cast<const urdf::Cylinder&>(*part.geometry);
      for (const double side : {-0.5, 0.5}) cylinders.emplace_back(X * model::Vector3{0, 0, side * cylinder.length}, cylinder.radius);
    }
  }
};

bool holds(const std::vector<std::pair<model::Vector3, double>>& ends, const model::Vector3& p, double radius) {
  return std::any_of(ends.begin(), ends.end(), [&](const auto& end) { return (end.first - p).norm() <= kPlace && end.second == radius; });
}

TEST(RobotDescription, HasEveryCapsuleToSeeAndToCollideWith) {
  Seed seed{72};
  for (std::size_t n = scaled(200); n > 0; --n) {
    const model::Cell cell = random_cell(seed);
    const auto urdf = urdf::parseURDF(monitor::robot_description(cell));
    ASSERT_TRUE(urdf);
    for (const model::Robot& robot : cell.robots) {
      for (const model::LinkCapsule& c : robot.model.capsules) {
        const auto link = urdf->getLink(monitor::link_frame(robot.name, c.link));
        Ends seen, hit;
        for (const auto& part : link->visual_array) seen.add(*part);
        for (const auto& part : link->collision_array) hit.add(*part);
        for (const Ends& ends : {seen, hit}) {
          for (const model::Vector3& p : {c.a, c.b}) {
            EXPECT_TRUE(holds(ends.spheres, p, c.radius)) << c.name;
            EXPECT_EQ(holds(ends.cylinders, p, c.radius), c.a != c.b) << c.name;
          }
        }
      }
    }
  }
}

TEST(RobotDescription, HasTheLimits) {
  model::Cell cell;
  cell.name = "c";
  cell.robots.push_back(robot_at("r1", arm4(), model::Vector3::Zero()));
  cell.robots.back().model.joints.velocity = model::Joints::Constant(1.25);
  const auto urdf = urdf::parseURDF(monitor::robot_description(cell));
  ASSERT_TRUE(urdf);
  for (std::size_t i = 0; i < model::kJoints; ++i) {
    const auto joint = urdf->getJoint(monitor::joint_name(cell.robots[0].name, i));
    ASSERT_TRUE(joint && joint->limits);
    EXPECT_EQ(joint->limits->lower, cell.robots[0].model.joints.min[static_cast<Eigen::Index>(i)]);
    EXPECT_EQ(joint->limits->upper, cell.robots[0].model.joints.max[static_cast<Eigen::Index>(i)]);
    EXPECT_EQ(joint->limits->velocity, 1.25);
  }
}

}  // namespace
}  // namespace interlace::test
