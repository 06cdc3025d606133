#include <gtest/gtest.h>

#include "common/dds/codec.hpp"
#include "planner/core/journal.hpp"
#include "tests/integration/dds/samples.hpp"
#include "tests/support/seed.hpp"

// The planner's journal as bytes: nothing is rounded, and what breaks a rule is refused.
namespace interlace::test {
namespace {

model::PlannerJournal journal() {
  model::PlannerJournal j;
  j.cell = "cell";
  j.fingerprint = 7;
  j.incarnation = 9;
  j.settings.strategy = "event";
  j.settings.posture_timeout = std::chrono::milliseconds{500};
  j.settings.escape_prefix = "escape-";
  j.settings.queue_limit = 1000;
  j.first = 41;
  for (const auto& command :
       {linear_command(), joint_command(), cancel_command(), stop_command(), hold_command(), resume_command(), replace_command()}) {
    j.calls.push_back({at(1), command.request, {1, 2, 3, 4}});
  }
  model::PostureReported posture;
  posture.robot = kRobot;
  posture.at = at(2);
  posture.joints = joints(0.3);
  posture.X_WT = pose();
  posture.motion = model::CommandId{"c-1"};
  posture.holds = tools();
  j.calls.push_back({at(2), posture, {}});
  model::ExecutionReported report;
  report.id = model::CommandId{"c-1"};
  report.robot = kRobot;
  report.state = model::ExecutionState::completed;
  report.joints = joints(0.1);
  j.calls.push_back({at(3), report, {}});
  j.calls.push_back({at(4), model::TimePassed{}, {0, 0, 1, 5}});
  return j;
}

const model::Pose& target(const model::PlannerCall& call) {
  const auto& command = std::get<model::CommandSubmitted>(std::get<model::ClientRequest>(call.event));
  return std::get<model::LinearTarget>(command.motion.target).X_WT;
}

TEST(PlannerJournal, ComesBackToTheLastBit) {
  const auto sent = journal();
  const auto bytes = dds::encode(sent);
  const auto got = dds::decode<model::PlannerJournal>(bytes, "cell");
  ASSERT_TRUE(got) << got.error();
  EXPECT_EQ(dds::encode(*got), bytes);
  EXPECT_EQ(got->first, 41);
  ASSERT_EQ(got->calls.size(), sent.calls.size());
  EXPECT_EQ(target(got->calls[0]).matrix(), target(sent.calls[0]).matrix());
  EXPECT_EQ(std::get<model::PostureReported>(got->calls[7].event).X_WT.matrix(), pose().matrix());
  const auto& replaced = std::get<model::QueueReplaced>(std::get<model::ClientRequest>(got->calls[6].event));
  EXPECT_EQ(std::get<model::LinearTarget>(replaced.commands.at(0).motion.target).X_WT.matrix(), pose().matrix());
  EXPECT_EQ(got->calls[9].decided, sent.calls[9].decided);
  EXPECT_EQ(got->settings.posture_timeout, sent.settings.posture_timeout);
}

TEST(PlannerJournal, ThatBreaksARuleIsRefused) {
  const auto refused = [](const model::PlannerJournal& j) {
    const auto got = dds::decode<model::PlannerJournal>(dds::encode(j), "cell");
    return got ? std::string{} : got.error();
  };
  auto other = journal();
  other.cell = "another";
  EXPECT_EQ(refused(other), "cell: 'another' on the topic of 'cell'");
  auto nobody = journal();
  nobody.incarnation = 0;
  EXPECT_EQ(refused(nobody), "incarnation: 0 means no planner");
  auto scaled = journal();
  std::get<model::PostureReported>(scaled.calls[7].event).X_WT.linear() *= 1.001;
  EXPECT_EQ(refused(scaled), "rotations: one is not a rotation");
  auto nan = journal();
  std::get<model::PostureReported>(nan.calls[7].event).joints[2] = std::nan("");
  EXPECT_NE(refused(nan).find("calls.posture.joints[2]"), std::string::npos) << refused(nan);
}

TEST(PlannerJournal, CutOffOrChangedIsReadOrRefusedButNeverMore) {
  const auto bytes = dds::encode(journal());
  for (std::size_t n = 0; n + 4 < bytes.size(); n += 7) {
    EXPECT_FALSE(dds::decode<model::PlannerJournal>({bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(n)}, "cell")) << n;
  }
  Seed seed;
  for (int i = 0; i < 5000; ++i) {
    auto changed = bytes;
    for (std::size_t n = 1 + seed.below(4); n > 0; --n) changed[seed.below(changed.size())] = static_cast<std::uint8_t>(seed.below(256));
    const auto got = dds::decode<model::PlannerJournal>(changed, "cell");
    ASSERT_TRUE(got || !got.error().empty());
  }
}

/// What JournalKeeper reckons with: the largest messages it makes fit into one datagram.
TEST(PlannerJournal, TheLargestMessagesFitIntoADatagram) {
  const std::string name(64, 'n');
  model::PostureReported posture;
  posture.robot = model::RobotName{name};
  posture.motion = model::CommandId{name};
  posture.holds.assign(32, model::ToolName{name});
  model::ExecutionReported report;
  report.id = model::CommandId{name};
  report.robot = model::RobotName{name};
  report.text = std::string(256, 't');
  report.holds = posture.holds;
  model::CommandSubmitted command;
  command.id = model::CommandId{name};
  command.robot = model::RobotName{name};
  command.motion.tools = model::ToolChange{model::ToolName{name}, model::ToolName{name}, model::ToolTime::start};
  command.deadline = 1;
  const model::QueueReplaced replaced{command.id, command.robot, std::vector<model::CommandSubmitted>(100, command)};
  const std::vector<model::PlannerEvent> events{posture, report, model::ClientRequest{command}, model::ClientRequest{replaced}};
  for (std::size_t first = 0; first < events.size(); ++first) {
    model::PlannerJournal head = journal();
    head.cell = name;
    head.settings.strategy = head.settings.escape_prefix = name;
    head.calls.clear();
    core::JournalKeeper keeper{head};
    for (std::size_t i = 0; i < 300; ++i) keeper.note({}, events[i % 5 == 0 ? first : i % 4], {});
    while (const auto message = keeper.take()) EXPECT_LE(dds::encode(*message).size(), core::JournalKeeper::kLargest) << first;
  }
}

TEST(PlannerJournal, ACommandWithAForgedLengthTakesNoMemory) {
  auto bytes = dds::encode(cancel_command());
  for (std::size_t i = bytes.size() - 4; i < bytes.size(); ++i) bytes[i] = 0x7F;  // the queue is the last member
  const auto got = dds::decode<dds::CommandMessage>(bytes, kRobot.str());
  ASSERT_FALSE(got);
  EXPECT_EQ(got.error(), "sample: malformed, or version 0");
}

}  // namespace
}  // namespace interlace::test
