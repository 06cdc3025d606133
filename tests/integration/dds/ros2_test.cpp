#include <gtest/gtest.h>

#include <functional>

#include "common/dds/ros2_writer.hpp"
#include "tests/integration/dds/peers.hpp"
#include "tests/support/process.hpp"

// What we write under ROS 2's names, read by another vendor's DDS with types made from ROS 2's definitions.
namespace interlace::test {
namespace {

class Ros2 : public ::testing::Test {
 protected:
  /// Writes again and again until the reader has printed `text`.
  [[nodiscard]] bool until_read(const std::string& text, const std::function<void()>& write) {
    const auto deadline = Clock::now() + kPatience;
    dds::Wait pause;
    while (peer_.output().find(text) == std::string::npos) {
      if (Clock::now() > deadline || !peer_.running()) return false;
      write();
      pause.until(Clock::now() + 50ms);
    }
    return true;
  }

  dds::Participant ours_{{unique_domain(), "monitor"}};
  Process peer_{{ROS2_PEER, std::to_string(unique_domain()), "cell", "60"}, true};
};

TEST_F(Ros2, JointStatesAreReadAndTheTypesHashIsThePublishedOne) {
  dds::Ros2Writer<ros2::JointState> writer{ours_, {"/cell/joint_states"}};
  const ros2::JointState joints{{{1'700'000'000, 5}, ""}, {"r1_joint1", "r1_joint2"}, {0.5, -1.25}, {}, {}};
  EXPECT_TRUE(until_read("joint_states at 1700000000 r1_joint1=0.500000 r1_joint2=-1.250000 velocities 0 efforts 0\n",
                         [&] { ASSERT_TRUE(writer.write(joints)); }))
      << peer_.output() << peer_.errors();
  EXPECT_EQ(writer.matched(), 1);
  const std::string introduced =
      "writer of rt/cell/joint_states type sensor_msgs::msg::dds_::JointState_ user data "
      "typehash=RIHS01_a13ee3a330e346c9d87b5aa18d24e11690752bd33a0350f11c5882bc9179260e;\n";
  EXPECT_NE(peer_.output().find(introduced), std::string::npos) << peer_.output();
}

TEST_F(Ros2, FramesAreReadAndTheTypesHashIsThePublishedOne) {
  dds::Ros2Writer<ros2::TFMessage> moving{ours_, {"/tf", false, 100}};
  dds::Ros2Writer<ros2::TFMessage> fixed{ours_, {"/tf_static", true, 1}};
  const auto frame = [](const char* parent, const char* child) {
    return ros2::TFMessage{{{{{7, 8}, parent}, child, {{1, 2, 3}, {0, 0, 0.6, 0.8}}}}};
  };
  ASSERT_TRUE(fixed.write(frame("world", "r1_base")));
  EXPECT_TRUE(until_read("/tf 1: [r1_link1 in r1_base at 1.0000 2.0000 3.0000 turned 0.0000 0.0000 0.6000 0.8000]\n",
                         [&] { ASSERT_TRUE(moving.write(frame("r1_base", "r1_link1"))); }));
  EXPECT_TRUE(until_read("/tf_static 1: [r1_base in world", [] {})) << "written before anybody listened";
  const std::string introduced =
      " type tf2_msgs::msg::dds_::TFMessage_ user data "
      "typehash=RIHS01_e369d0f05a23ae52508854b66f6aa0437f3449d652e8cbf22d5abe85d020f087;\n";
  EXPECT_NE(peer_.output().find("writer of rt/tf" + introduced), std::string::npos) << peer_.output();
  EXPECT_NE(peer_.output().find("writer of rt/tf_static" + introduced), std::string::npos) << peer_.output();
}

TEST_F(Ros2, EveryMemberOfAMarkerIsReadInItsPlace) {
  dds::Ros2Writer<ros2::MarkerArray> writer{ours_, {"/cell/fixtures", true, 1}};
  ros2::MarkerArray message;
  for (const std::int32_t id : {4, 5}) {  // what comes behind the first shows that all of it had its place
    ros2::Marker m;
    m.header = {{1, 2}, "world"};
    m.ns = "table";
    m.id = id;
    m.type = ros2::Marker::kTriangleList;
    m.pose.position = {1, 2, 3};
    m.scale = {4, 5, 6};
    m.color = {0.25F, 0.5F, 0.75F, 1};
    m.lifetime.sec = 9;
    m.frame_locked = true;
    m.points.resize(3);
    m.colors.resize(3);
    m.texture_resource = "t";
    m.texture.data = {1, 2, 3};
    m.uv_coordinates.resize(1);
    m.text = "text";
    m.mesh_resource = "mesh";
    m.mesh_file = {"file", {7}};
    m.mesh_use_embedded_materials = true;
    message.markers.push_back(m);
  }
  const std::string rest =
      " in world type 11 at 1.0000 2.0000 3.0000 size 4.0000 5.0000 6.0000 colour 0.25 0.50 0.75 1.00 points 3 lifetime 9]";
  ASSERT_TRUE(writer.write(message));
  EXPECT_TRUE(until_read("fixtures 2: [table 4" + rest + " [table 5" + rest + "\n", [] {})) << peer_.output();
}

TEST_F(Ros2, DiagnosticsAreReadWithTheirLevels) {
  dds::Ros2Writer<ros2::DiagnosticArray> writer{ours_, {"/diagnostics"}};
  const ros2::DiagnosticArray message{{{3, 4}, ""},
                                      {{ros2::DiagnosticStatus::kStale, "cell: r1", "silent", "r1", {{"heard", "no"}}},
                                       {ros2::DiagnosticStatus::kOk, "cell: r2", "stands", "r2", {}}}};
  EXPECT_TRUE(until_read("/diagnostics at 3: [3 cell: r1 | r1 | silent | heard=no] [0 cell: r2 | r2 | stands |]\n", [&] {
    ASSERT_TRUE(writer.write(message));
  })) << peer_.output();
}

// Longer than a packet may be: the URDF of a large cell.
TEST_F(Ros2, ALongDescriptionIsReadByWhoComesLater) {
  dds::Ros2Writer<ros2::String> writer{ours_, {"/cell/robot_description", true, 1}};
  ros2::String message{"<robot>"};
  while (message.data.size() < 400'000) message.data += "<link name=\"" + std::to_string(message.data.size()) + "\"/>";
  message.data += "</robot>";
  ASSERT_TRUE(writer.write(message));
  EXPECT_TRUE(until_read("robot_description of " + std::to_string(message.data.size()) + " bytes: " + message.data + "\n", [] {}));
}

}  // namespace
}  // namespace interlace::test
