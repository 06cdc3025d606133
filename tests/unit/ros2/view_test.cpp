#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <memory>
#include <set>

#include "monitor/ros2/diagnostics.hpp"
#include "monitor/ros2/frames.hpp"
#include "monitor/ros2/markers.hpp"
#include "tests/support/arms.hpp"

namespace interlace::monitor {
namespace {

using ros2::DiagnosticStatus;
using ros2::Marker;

constexpr ros2::Time kNow{1'700'000'000, 250};
constexpr double kExact = 1e-12;

model::Vector3 place(const ros2::Vector3& p) {
  return {p.x, p.y, p.z};
}
model::Vector3 place(const ros2::Point& p) {
  return {p.x, p.y, p.z};
}
model::Quaternion rotation(const ros2::Quaternion& q) {
  return {q.w, q.x, q.y, q.z};
}

/// Two arms at their start; r2 with another posture than r1.
class Ros2View : public testing::Test {
 protected:
  Ros2View() {
    picture_.cell = cell_.get();
    picture_.planner_heard = true;
    for (const model::Robot& body : cell_->robots) {
      RobotPicture robot;
      robot.body = &body;
      robot.heard = true;
      robot.posture = model::PostureReported{};
      robot.posture->robot = body.name;
      robot.posture->joints = body.start;
      model::place_capsules(body.model, body.X_WB, body.start, robot.capsules);
      robot.clearance.assign(robot.capsules.size(), 0.3);
      picture_.robots.push_back(std::move(robot));
    }
  }

  [[nodiscard]] DiagnosticStatus told(const std::string& name) const {
    for (const DiagnosticStatus& status : diagnostics(picture_, kNow).status) {
      if (status.name == name) return status;
    }
    ADD_FAILURE() << "nothing is told of " << name;
    return {};
  }

  std::shared_ptr<model::Cell> cell_ = test::experiment_cell();
  CellPicture picture_;
};

TEST_F(Ros2View, JointsAreThoseOfTheRobotsThatAreHeard) {
  ros2::JointState joints = joint_states(picture_, kNow);
  ASSERT_EQ(joints.name.size(), 12U);
  ASSERT_EQ(joints.position.size(), 12U);
  EXPECT_TRUE(joints.velocity.empty() && joints.effort.empty());
  EXPECT_EQ(joints.name[0], "r1_joint1");
  EXPECT_EQ(joints.name[11], "r2_joint6");
  EXPECT_EQ(joints.position[7], cell_->robots[1].start[1]);
  EXPECT_EQ(joints.header.stamp.sec, kNow.sec);

  picture_.robots[0].heard = false;
  joints = joint_states(picture_, kNow);
  EXPECT_EQ(joints.name.size(), 6U);
  EXPECT_EQ(joints.name[0], "r2_joint1") << "what r1 said last is not told as if it were so now";
}

TEST_F(Ros2View, FramesLeadFromTheWorldToTheTcp) {
  std::map<std::string, std::pair<std::string, model::Pose>> tree;  // by child
  for (const ros2::TFMessage& message : {fixed_frames(*cell_, kNow), moving_frames(picture_, kNow)}) {
    for (const ros2::TransformStamped& t : message.transforms) {
      const model::Pose X = model::make_pose(place(t.transform.translation), rotation(t.transform.rotation));
      EXPECT_TRUE(tree.emplace(t.child_frame_id, std::make_pair(t.header.frame_id, X)).second) << t.child_frame_id << " hangs twice";
    }
  }
  for (const model::Robot& robot : cell_->robots) {
    model::Pose X = model::Pose::Identity();
    std::string frame = tcp_frame(robot.name);
    std::size_t steps = 0;
    for (; frame != kWorldFrame && tree.count(frame) == 1; ++steps) {
      X = tree[frame].second * X;
      frame = tree[frame].first;
    }
    EXPECT_EQ(frame, kWorldFrame);
    EXPECT_EQ(steps, 8U);
    EXPECT_TRUE(X.isApprox(robot.X_WB * model::tcp_pose(robot.model, robot.start), kExact));
  }

  picture_.robots[1].heard = false;
  EXPECT_EQ(moving_frames(picture_, kNow).transforms.size(), 6U);
}

TEST_F(Ros2View, ACapsuleIsACylinderAndTwoSpheres) {
  const auto markers = capsule_markers(picture_, kNow).markers;
  ASSERT_EQ(markers.size(), 2U * 4 * 3);
  std::set<std::pair<std::string, std::int32_t>> ids;
  for (const Marker& m : markers) {
    EXPECT_TRUE(ids.emplace(m.ns, m.id).second) << m.ns << " " << m.id << " is there twice";
    EXPECT_EQ(m.header.frame_id, "world");
    EXPECT_GT(m.lifetime.sec, 0) << "it would stay when nobody tells it any more";
  }
  const model::Capsule& c = picture_.robots[1].capsules[2];
  const auto of = [&](std::int32_t id) {
    return *std::find_if(markers.begin(), markers.end(), [&](const Marker& m) { return m.ns == "r2" && m.id == id; });
  };
  EXPECT_EQ(of(6).type, Marker::kSphere);
  EXPECT_LE((place(of(6).pose.position) - c.a).norm(), kExact);
  EXPECT_LE((place(of(7).pose.position) - c.b).norm(), kExact);
  EXPECT_EQ(of(7).scale.y, 2 * c.radius);
  EXPECT_EQ(of(8).type, Marker::kCylinder);
  const model::Vector3 half = rotation(of(8).pose.orientation) * model::Vector3{0, 0, of(8).scale.z / 2};
  EXPECT_LE((place(of(8).pose.position) - half - c.a).norm(), kExact);
  EXPECT_LE((place(of(8).pose.position) + half - c.b).norm(), kExact);
}

TEST_F(Ros2View, ColoursSayWhatIsNearAndWhoIsSilent) {
  const auto colour_of_first = [&] {
    const ros2::ColorRGBA c = capsule_markers(picture_, kNow).markers[0].color;
    return std::vector<float>{c.r, c.g, c.b, c.a};
  };
  std::set<std::vector<float>> colours{colour_of_first()};
  for (const double clearance : {0.04, -0.01}) {
    picture_.robots[0].clearance[0] = clearance;
    EXPECT_TRUE(colours.insert(colour_of_first()).second) << clearance;
  }
  picture_.robots[0].heard = false;
  EXPECT_TRUE(colours.insert(colour_of_first()).second) << "silent";
}

TEST_F(Ros2View, ARobotThatWasNeverHeardHasNoMarkersAndIsStale) {
  picture_.robots[0] = RobotPicture{};
  picture_.robots[0].body = &cell_->robots[0];
  for (const Marker& m : capsule_markers(picture_, kNow).markers) EXPECT_EQ(m.ns, "r2");
  EXPECT_EQ(told("experiment: r1").level, DiagnosticStatus::kStale);
  EXPECT_EQ(told("experiment: r1").message, "never heard from");
}

TEST_F(Ros2View, FixturesAreDrawnWhereTheyAre) {
  const model::Pose X = model::make_pose({1, 2, 3}, model::rotation_from_rpy({0.1, 0.2, 0.3}));
  auto mesh =
      std::make_shared<model::TriangleMesh>(std::vector<model::Vector3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                            std::vector<model::TriangleMesh::Triangle>{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}, true);
  cell_->fixtures = {{"ball", X, model::SphereShape{0.2}},
                     {"box", X, model::BoxShape{{0.1, 0.2, 0.3}}},
                     {"post", X, model::CylinderShape{0.05, 0.4}},
                     {"floor", X, model::PlaneShape{model::Vector3{0, 0.6, 0.8}, -0.5}},
                     {"part", X, model::MeshShape{mesh}}};
  const auto markers = fixture_markers(*cell_, kNow).markers;
  ASSERT_EQ(markers.size(), 5U);
  EXPECT_EQ(markers[0].type, Marker::kSphere);
  EXPECT_EQ(markers[0].scale.x, 0.4);
  EXPECT_EQ(markers[1].type, Marker::kCube);
  EXPECT_EQ(markers[1].scale.z, 0.6);
  EXPECT_LE((place(markers[1].pose.position) - X.translation()).norm(), kExact);
  EXPECT_EQ(markers[2].type, Marker::kCylinder);
  EXPECT_EQ(markers[2].scale.z, 0.8);
  // The upper face of the sheet lies on the plane.
  const model::Pose X_WS = model::make_pose(place(markers[3].pose.position), rotation(markers[3].pose.orientation));
  for (const double side : {-1.0, 1.0}) {
    const model::Vector3 p_O = X.inverse() * (X_WS * model::Vector3{side, side / 2, markers[3].scale.z / 2});
    EXPECT_NEAR(p_O.dot(model::Vector3{0, 0.6, 0.8}), -0.5, kExact);
  }
  EXPECT_EQ(markers[4].type, Marker::kTriangleList);
  EXPECT_EQ(markers[4].points.size(), 12U);
}

TEST_F(Ros2View, DiagnosticsAreFineWhenAllIsWell) {
  for (const DiagnosticStatus& status : diagnostics(picture_, kNow).status) {
    EXPECT_EQ(status.level, DiagnosticStatus::kOk) << status.name << ": " << status.message;
  }
  EXPECT_EQ(told("experiment: r1").hardware_id, "r1");
  EXPECT_EQ(told("experiment: r1").message, "stands");
  picture_.robots[0].waiting = "r1 waits for r2";
  EXPECT_EQ(told("experiment: r1").message, "r1 waits for r2");
}

TEST_F(Ros2View, ASilentRobotIsStaleAndNobodyElse) {
  const auto before = diagnostics(picture_, kNow);
  picture_.robots[1].heard = false;
  EXPECT_EQ(told("experiment: r2").level, DiagnosticStatus::kStale);
  EXPECT_EQ(told("experiment: r1").level, DiagnosticStatus::kOk);
  EXPECT_EQ(told("experiment: planner").level, DiagnosticStatus::kOk);
  EXPECT_TRUE(differ_in_level(before, diagnostics(picture_, kNow)));
  picture_.planner_heard = false;
  EXPECT_EQ(told("experiment: planner").level, DiagnosticStatus::kStale);
}

TEST_F(Ros2View, TroubleHasItsLevel) {
  picture_.robots[0].posture->ready = false;
  EXPECT_EQ(told("experiment: r1").level, DiagnosticStatus::kWarn);
  picture_.robots[1].status = model::RobotStatus{};
  picture_.robots[1].status->reason = model::Reason::deadlock;
  EXPECT_EQ(told("experiment: r2").level, DiagnosticStatus::kWarn);
  picture_.robots[1].stranger = true;
  EXPECT_EQ(told("experiment: r2").level, DiagnosticStatus::kError);

  Alarm over{"contact", true, {"r1", "r2"}, "they touched", 1, 2};
  picture_.alarms = {over};
  EXPECT_EQ(told("experiment: alarms").level, DiagnosticStatus::kOk) << "it is over";
  over.ended.reset();
  picture_.alarms = {over};
  EXPECT_EQ(told("experiment: alarms").level, DiagnosticStatus::kError);
  EXPECT_EQ(told("experiment: alarms").message, "they touched");
}

}  // namespace
}  // namespace interlace::monitor
