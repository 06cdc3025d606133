#include <gtest/gtest.h>

#include <iostream>
#include <variant>

#include "tests/integration/dds/peers.hpp"
#include "tests/integration/dds/samples.hpp"
#include "tests/support/process.hpp"

// Another vendor's DDS, with types made from the same IDL, on the other end of our endpoints.
namespace interlace::test {
namespace {

std::vector<std::string> cyclone_peer(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), {CYCLONE_PEER, std::to_string(unique_domain()), "foreign", kRobot.str()});
  return arguments;
}

TEST(Cyclone, ReadsOurPostures) {
  dds::Participant ours{{unique_domain(), "proxy"}};
  dds::Writer<dds::PostureMessage> writer{ours, dds::topics::posture("foreign", kRobot)};
  dds::Wait pause;
  Process peer{cyclone_peer({"postures", "20", "20"}), true};
  std::optional<int> exit_code;
  const auto deadline = Clock::now() + kPatience + 5s;
  while (!exit_code && Clock::now() < deadline) {
    ASSERT_TRUE(writer.write(posture()));
    pause.until(Clock::now() + dds::kPosturePeriod);
    exit_code = peer.wait(0ms);
  }
  ASSERT_EQ(exit_code, 0);
  const std::string text = peer.output();
  const std::string line = "r1 joints 0.700000 0.800000 0.900000 1.000000 1.100000 1.200000 position 0.450000 -0.250000 0.300000 moving\n";
  EXPECT_EQ(text.substr(0, line.size()), line);
  EXPECT_EQ(text.size(), 20 * line.size()) << text;
}

/// Answers every command with the two statuses given, as a planner would.
class StandIn {
 public:
  explicit StandIn(model::CommandState outcome)
      : commands_(participant_, dds::topics::command("foreign", kRobot)),
        statuses_(participant_, dds::topics::command_status("foreign", kRobot)),
        outcome_(outcome) {
    wait_.attach(commands_);
  }

  /// Serves until `peer` ends; its exit code.
  std::optional<int> serve(Process& peer) {
    const auto deadline = Clock::now() + kPatience + 5s;
    std::optional<int> exit_code;
    while (!exit_code && Clock::now() < deadline) {
      wait_.until(Clock::now() + 20ms);
      // Each side matches by itself: the peer's command may be here before its reader is known, and an answer would be lost to it.
      if (statuses_.matched() > 0) {
        commands_.take([&](dds::CommandMessage&& m) {
          seen.push_back(m);
          answer(std::get<model::CommandSubmitted>(m.request).id);
        });
      }
      exit_code = peer.wait(0ms);
    }
    return exit_code;
  }

  std::vector<dds::CommandMessage> seen;
  [[nodiscard]] const dds::ReaderCounters& counters() const { return commands_.counters(); }

 private:
  void answer(const model::CommandId& id) {
    for (const model::CommandState state : {model::CommandState::queued, model::CommandState::started, outcome_}) {
      dds::StatusMessage message = status();
      message.status.id = id;
      message.status.state = state;
      EXPECT_TRUE(statuses_.write(message)) << statuses_.last_refusal();
    }
  }

  dds::Participant participant_{{unique_domain(), "planner"}};
  dds::Reader<dds::CommandMessage> commands_;
  dds::Writer<dds::StatusMessage> statuses_;
  dds::Wait wait_;
  model::CommandState outcome_;
};

std::vector<std::string> command_arguments(const std::string& id) {
  return cyclone_peer({"command", id, "0.3", "0.25", "0.33", "0.6", "0", "0.8", "0", "20"});
}

TEST(Cyclone, SubmitsACommandAndHearsItsEnd) {
  StandIn planner{model::CommandState::completed};
  Process peer{command_arguments("cyclone-1"), true};
  EXPECT_EQ(planner.serve(peer), 0);
  ASSERT_FALSE(planner.seen.empty()) << planner.counters().last_refusal;
  EXPECT_EQ(planner.seen[0].client, "cyclone_peer");
  const auto& command = std::get<model::CommandSubmitted>(planner.seen[0].request);
  EXPECT_EQ(command.id.str(), "cyclone-1");
  EXPECT_EQ(command.robot, kRobot);
  EXPECT_FALSE(command.motion.velocity);
  EXPECT_EQ(command.deadline, 3600);
  const auto& target = std::get<model::LinearTarget>(command.motion.target);
  EXPECT_TRUE(target.X_WT.isApprox(model::make_pose({0.3, 0.25, 0.33}, model::Quaternion{0.6, 0, 0.8, 0}), 1e-12));
  const std::string text = peer.output();
  EXPECT_NE(text.find("cyclone-1 queued"), std::string::npos) << text;
  EXPECT_NE(text.find("cyclone-1 completed"), std::string::npos) << text;
}

TEST(Cyclone, TellsACommandThatDidNotComplete) {
  StandIn planner{model::CommandState::rejected};
  Process peer{command_arguments("cyclone-2"), true};
  EXPECT_EQ(planner.serve(peer), 1);
  EXPECT_NE(peer.output().find("cyclone-2 rejected"), std::string::npos);
}

TEST(Cyclone, NoPlannerNoWaitingForEver) {
  Process peer{cyclone_peer({"command", "c", "0", "0", "0", "1", "0", "0", "0", "0.5"})};
  EXPECT_EQ(peer.wait(10s), 1);
}

// A foreign command that breaks a rule is refused like any other.
TEST(Cyclone, ItsNaNIsRefused) {
  StandIn planner{model::CommandState::completed};
  Process peer{cyclone_peer({"command", "bad", "nan", "0", "0.3", "1", "0", "0", "0", "3"})};
  EXPECT_EQ(planner.serve(peer), 1);
  EXPECT_TRUE(planner.seen.empty());
  EXPECT_GE(planner.counters().refused, 1u);
  EXPECT_NE(planner.counters().last_refusal.find("motion.position.x: nan"), std::string::npos) << planner.counters().last_refusal;
}

}  // namespace
}  // namespace interlace::test
