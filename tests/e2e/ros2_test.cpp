#include <fmt/format.h>
#include <gtest/gtest.h>

#include <thread>

#include "tests/e2e/cells.hpp"
#include "tests/e2e/running_cell.hpp"
#include "tests/e2e/scratch.hpp"
#include "tests/e2e/view.hpp"

// The real monitor shows a running cell to what could be RViz or `ros2 topic echo`: another vendor's reader with ROS 2's names and types.
namespace interlace::test {
namespace {

std::string ros2_cell() {
  CellText cell;
  cell.name = "fast-2";  // ROS 2 allows no '-' in a topic
  cell.fixtures = "  - {name: table, type: box, size: [100, 200, 40], pose: {xyz: [-900, 0, 20], rpy: [0, 0, 0]}}\n";
  return cell_text(cell);
}

class Ros2Tools : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(cell_.start());
    ASSERT_FALSE(cell_.start_monitor({"--page", scratch_.path(""), "--ros2-domain", std::to_string(ros2_.id())}).empty());
  }

  [[nodiscard]] static std::vector<std::string> peer_on(std::uint32_t domain) {
    return {INTERLACE_ROS2_PEER, std::to_string(domain), "fast_2", "100"};
  }
  /// Waits until `peer` has printed `text` at least `times` times after its first `from` bytes.
  [[nodiscard]] static bool reads(const Process& peer, const std::string& text, std::size_t from = 0, std::size_t times = 1) {
    const auto deadline = std::chrono::steady_clock::now() + kPatience;
    while (Process::count(peer.output().substr(from), text) < times) {
      if (std::chrono::steady_clock::now() > deadline) return false;
      std::this_thread::sleep_for(50ms);
    }
    return true;
  }
  /// The joints of a robot as the test itself hears them, the way the reader prints them.
  [[nodiscard]] std::string joints_of(const std::string& robot) const {
    std::string text;
    for (std::size_t i = 0; i < model::kJoints; ++i) {
      text += fmt::format(" {}_joint{}={:.6f}", robot, i + 1, view_.posture(robot)->posture.joints[static_cast<Eigen::Index>(i)]);
    }
    return text;
  }
  [[nodiscard]] bool both_stand_at(const model::Vector3& r1, const model::Vector3& r2) {
    return view_.until([&] { return view_.stands_at("r1", r1) && view_.stands_at("r2", r2); });
  }

  Scratch scratch_;
  std::string page_ = scratch_.file("index.html", "<!doctype html><title>page</title>");
  RunningCell cell_{unique_domain(), "fast-2", scratch_.file("cell.yaml", ros2_cell())};
  Domain ros2_;  // of its own
  View view_{unique_domain(), "fast-2"};
};

TEST_F(Ros2Tools, SeeJointsFramesBodiesAndDiagnosticsOfARunningCell) {
  Process peer{peer_on(ros2_.id()), true};
  const Process on_the_cells_domain{peer_on(unique_domain()), true};
  ASSERT_TRUE(both_stand_at({0.45, 0.25, 0.3}, {0.45, -0.25, 0.3}));
  EXPECT_TRUE(reads(peer, joints_of("r1") + joints_of("r2") + " velocities 0 efforts 0\n")) << peer.output().substr(0, 4000);
  EXPECT_TRUE(reads(peer, "robot_description of "));
  EXPECT_TRUE(reads(peer, "<robot name=\"fast-2\">"));
  EXPECT_TRUE(reads(peer, "capsules 24: [r1 0 in world type 2 at 0.0000 0.2500 0.0000 size 0.2240 0.2240 0.2240 "));
  EXPECT_TRUE(reads(peer, "fixtures 1: [table 0 in world type 1 at -0.9000 0.0000 0.0200 size 0.1000 0.2000 0.0400 "));
  EXPECT_TRUE(reads(peer, "/tf_static 4: [r1_base in world at 0.0000 0.2500 0.0000 "));
  EXPECT_TRUE(reads(peer, "/tf 12: [r1_link1 in r1_base at "));
  EXPECT_TRUE(reads(peer, "[0 fast-2: planner | planner | heard | strategy=event "));
  EXPECT_TRUE(reads(peer, "[0 fast-2: r1 | r1 | stands | heard=yes ready=yes moving=no "));
  EXPECT_TRUE(reads(peer, "[0 fast-2: alarms | cell | none |]"));
  for (const char* type : {"rt/fast_2/joint_states type sensor_msgs::msg::dds_::JointState_ user data typehash=RIHS01_a13ee3a330e346c9",
                           "rt/fast_2/robot_description type std_msgs::msg::dds_::String_ user data typehash=RIHS01_df668c740482bbd4",
                           "rt/fast_2/capsules type visualization_msgs::msg::dds_::MarkerArray_ user data typehash=RIHS01_86cb8800b6fb05b5",
                           "rt/diagnostics type diagnostic_msgs::msg::dds_::DiagnosticArray_ user data typehash=RIHS01_5a8a36efb05fb250",
                           "rt/tf type tf2_msgs::msg::dds_::TFMessage_ user data typehash=RIHS01_e369d0f05a23ae52"}) {
    EXPECT_TRUE(reads(peer, type)) << type;
  }

  (void)cell_.send("r1", "there", {300, 250, 330});
  ASSERT_TRUE(both_stand_at({0.3, 0.25, 0.33}, {0.45, -0.25, 0.3}));
  EXPECT_TRUE(reads(peer, joints_of("r1") + joints_of("r2"))) << "where r1 went";
  EXPECT_EQ(on_the_cells_domain.output(), "") << "the monitor writes nothing there";
}

TEST_F(Ros2Tools, HearThatARobotIsSilent) {
  Process peer{peer_on(ros2_.id()), true};
  ASSERT_TRUE(reads(peer, "[0 fast-2: r2 | r2 | stands | "));
  ASSERT_TRUE(reads(peer, " r2_joint1="));
  cell_.proxy("r2").kill(SIGKILL);
  ASSERT_TRUE(reads(peer, "[3 fast-2: r2 | r2 | not heard from: it could be anywhere in its reach | heard=no"));
  // Topics keep no order between them, so what counts comes after the first joint states without it.
  ASSERT_TRUE(view_.until([&] { return view_.posture("r1") != nullptr; }));
  ASSERT_TRUE(reads(peer, joints_of("r1") + " velocities"));
  const std::size_t from = peer.output().size();
  EXPECT_TRUE(reads(peer, " r1_joint6=", from, 10));
  EXPECT_EQ(Process::count(peer.output().substr(from), " r2_joint1="), 0U) << "what it said last is told as if it were so now";
  EXPECT_TRUE(reads(peer, "[0 fast-2: r1 | r1 | ", from)) << "r1 is as well as before";
  (void)cell_.start_proxy("r2");
  EXPECT_TRUE(reads(peer, "[0 fast-2: r2 | r2 | ", from)) << "it is heard again";
}

TEST_F(Ros2Tools, OneThatStandsStillDisturbsNoOther) {
  Process still{peer_on(ros2_.id()), true};
  Process other{peer_on(ros2_.id()), true};
  ASSERT_TRUE(reads(still, "joint_states at "));
  ASSERT_TRUE(reads(other, "joint_states at "));
  still.kill(SIGSTOP);
  const std::size_t from = other.output().size();
  EXPECT_TRUE(reads(other, "joint_states at ", from, 100)) << "ten times as many as are kept for the one that does not read";
  still.kill(SIGCONT);
  EXPECT_TRUE(reads(still, "joint_states at ", still.output().size())) << "it goes on with what is new";
}

TEST(Ros2Domain, IsNotTheCells) {
  const Outcome o = run({kMonitor, deployed("exp-4-2/cell.yaml"), "--domain", "42", "--ros2-domain", "42"});
  EXPECT_EQ(o.exit_code, 2) << o;
  EXPECT_TRUE(o.says("--ros2-domain 42: found the cell's own domain, expected another one")) << o;
}

}  // namespace
}  // namespace interlace::test
