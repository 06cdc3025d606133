#include <gtest/gtest.h>

#include "tests/integration/dds/peers.hpp"
#include "tests/integration/dds/samples.hpp"

// Each message type crosses the wire and arrives as it was. Numbers are compared exactly: CDR carries the bits. Rotations go through a
// quaternion and are compared within 1e-12.
namespace interlace::test {
namespace {

void expect_same(const model::Pose& sent, const model::Pose& got) {
  EXPECT_TRUE(sent.isApprox(got, 1e-12)) << got.matrix();
}

void expect_same(const model::MotionRequest& sent, const model::MotionRequest& got) {
  ASSERT_EQ(sent.target.index(), got.target.index());
  if (const auto* linear = std::get_if<model::LinearTarget>(&sent.target)) {
    expect_same(linear->X_WT, std::get<model::LinearTarget>(got.target).X_WT);
  } else {
    EXPECT_EQ(std::get<model::JointTarget>(sent.target).q, std::get<model::JointTarget>(got.target).q);
  }
  EXPECT_EQ(sent.velocity, got.velocity);
  EXPECT_EQ(sent.acceleration, got.acceleration);
  ASSERT_EQ(sent.tools.has_value(), got.tools.has_value());
  if (!sent.tools) return;
  EXPECT_EQ(sent.tools->attach, got.tools->attach);
  EXPECT_EQ(sent.tools->detach, got.tools->detach);
  EXPECT_EQ(sent.tools->when, got.tools->when);
}

void expect_same(const std::vector<model::Conflict>& sent, const std::vector<model::Conflict>& got) {
  ASSERT_EQ(sent.size(), got.size());
  for (std::size_t i = 0; i < sent.size(); ++i) {
    EXPECT_EQ(sent[i].blocker, got[i].blocker);
    EXPECT_EQ(sent[i].own_link, got[i].own_link);
    EXPECT_EQ(sent[i].blocker_link, got[i].blocker_link);
    EXPECT_EQ(sent[i].from, got[i].from);
    EXPECT_EQ(sent[i].until, got[i].until);
    EXPECT_EQ(sent[i].clearance, got[i].clearance);
    EXPECT_EQ(sent[i].place, got[i].place);
  }
}

void expect_same(const std::vector<model::EscapeRefusal>& sent, const std::vector<model::EscapeRefusal>& got) {
  ASSERT_EQ(sent.size(), got.size());
  for (std::size_t i = 0; i < sent.size(); ++i) {
    EXPECT_EQ(sent[i].robot, got[i].robot);
    EXPECT_EQ(sent[i].way, got[i].way);
    EXPECT_EQ(sent[i].text, got[i].text);
  }
}

void expect_same(const model::CommandSubmitted& sent, const model::CommandSubmitted& got) {
  EXPECT_EQ(sent.id, got.id);
  EXPECT_EQ(sent.robot, got.robot);
  EXPECT_EQ(sent.priority, got.priority);
  EXPECT_EQ(sent.deadline, got.deadline);
  expect_same(sent.motion, got.motion);
}

TEST(RoundTrip, Command) {
  Pair pair{dds::topics::command("cell", kRobot)};
  ASSERT_TRUE(pair.match());
  for (const dds::CommandMessage& sent : {linear_command(), joint_command()}) {
    const auto got = pair.pass(sent);
    ASSERT_TRUE(got) << pair.writer.last_refusal() << pair.reader.counters().last_refusal;
    EXPECT_EQ(got->client, "tester");
    const auto& a = std::get<model::CommandSubmitted>(sent.request);
    const auto& b = std::get<model::CommandSubmitted>(got->request);
    expect_same(a, b);
  }
  const auto cancelled = pair.pass(cancel_command());
  ASSERT_TRUE(cancelled);
  EXPECT_EQ(std::get<model::CommandCancelled>(cancelled->request).id.str(), "c-1");
  const auto stopped = pair.pass(stop_command());
  ASSERT_TRUE(stopped);
  EXPECT_EQ(std::get<model::StopRequested>(stopped->request).id.str(), "s-1");
  const auto held = pair.pass(hold_command());
  ASSERT_TRUE(held);
  EXPECT_EQ(std::get<model::HoldRequested>(held->request).id.str(), "h-1");
  const auto resumed = pair.pass(resume_command());
  ASSERT_TRUE(resumed);
  EXPECT_EQ(std::get<model::ResumeRequested>(resumed->request).id.str(), "h-2");
  EXPECT_EQ(pair.reader.counters().received, 6u);
  EXPECT_EQ(pair.reader.counters().refused, 0u);
}

TEST(RoundTrip, Replacement) {
  Pair pair{dds::topics::command("cell", kRobot)};
  ASSERT_TRUE(pair.match());
  dds::CommandMessage message = replace_command();
  auto& sent = std::get<model::QueueReplaced>(message.request);
  const auto got = pair.pass(message);
  ASSERT_TRUE(got) << pair.writer.last_refusal() << pair.reader.counters().last_refusal;
  const auto& replaced = std::get<model::QueueReplaced>(got->request);
  EXPECT_EQ(replaced.id.str(), "q-1");
  ASSERT_EQ(replaced.commands.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) expect_same(sent.commands[i], replaced.commands[i]);

  // The largest is far above one UDP datagram; one more is refused before it is sent.
  sent.commands.assign(100, sent.commands[0]);
  const auto large = pair.pass(message);
  ASSERT_TRUE(large) << pair.writer.last_refusal();
  EXPECT_EQ(std::get<model::QueueReplaced>(large->request).commands.size(), 100u);
  sent.commands.push_back(sent.commands[0]);
  EXPECT_FALSE(pair.writer.write(message));
  EXPECT_NE(pair.writer.last_refusal().find("queue: 101 are too many"), std::string::npos) << pair.writer.last_refusal();
}

TEST(RoundTrip, CommandStatus) {
  Pair pair{dds::topics::command_status("cell", kRobot)};
  ASSERT_TRUE(pair.match());
  const dds::StatusMessage sent = status();
  const auto got = pair.pass(sent);
  ASSERT_TRUE(got) << pair.writer.last_refusal();
  EXPECT_EQ(got->planner_incarnation, sent.planner_incarnation);
  EXPECT_EQ(got->status.id, sent.status.id);
  EXPECT_EQ(got->status.robot, sent.status.robot);
  EXPECT_EQ(got->status.escape, sent.status.escape);
  EXPECT_EQ(got->status.serves, sent.status.serves);
  EXPECT_EQ(got->status.state, sent.status.state);
  EXPECT_EQ(got->status.reason, sent.status.reason);
  EXPECT_EQ(got->status.text, sent.status.text);
  EXPECT_EQ(got->status.submitted, sent.status.submitted);
  EXPECT_EQ(got->status.start, sent.status.start);
  EXPECT_EQ(got->status.end, sent.status.end);
  EXPECT_EQ(got->status.delay, sent.status.delay);
  expect_same(sent.status.conflicts, got->status.conflicts);
  expect_same(sent.status.refusals, got->status.refusals);
  EXPECT_EQ(got->status.verdict, sent.status.verdict);
  EXPECT_EQ(got->status.deadline, sent.status.deadline);

  dds::StatusMessage wordy = status();
  wordy.status.start.reset();
  wordy.status.text = std::string(300, 'x') + "\n";
  wordy.status.conflicts.assign(40, conflict());
  wordy.status.serves = model::CommandId{};
  wordy.status.verdict = model::DeadlineVerdict::none;
  wordy.status.deadline.reset();
  // An umlaut across the bound: it goes as a whole.
  wordy.status.refusals.assign(17, {model::RobotName{"r2"}, model::EscapeWay::retreat, std::string(255, 'x') + "ä"});
  wordy.status.refusals.front().way = model::EscapeWay::plus_x;
  const auto cut = pair.pass(wordy);
  ASSERT_TRUE(cut) << pair.writer.last_refusal();
  EXPECT_EQ(cut->status.text.size(), 256u);
  EXPECT_EQ(cut->status.conflicts.size(), 16u);
  EXPECT_FALSE(cut->status.start);
  EXPECT_FALSE(cut->status.deadline);
  EXPECT_TRUE(cut->status.serves.empty());
  ASSERT_EQ(cut->status.refusals.size(), 16u);
  EXPECT_EQ(cut->status.refusals.front().way, model::EscapeWay::plus_x) << "the first ones are kept";
  EXPECT_EQ(cut->status.refusals.back().text, std::string(255, 'x'));
}

TEST(RoundTrip, Dispatch) {
  Pair pair{dds::topics::dispatch("cell", kRobot)};
  ASSERT_TRUE(pair.match());
  const auto executed = pair.pass(execute());
  ASSERT_TRUE(executed) << pair.writer.last_refusal();
  EXPECT_EQ(executed->planner_incarnation, 42u);
  EXPECT_EQ(executed->fingerprint, 0xFEEDFACECAFEBEEF);
  const auto message = execute();
  const auto& sent = std::get<model::Dispatch>(message.order);
  const auto& got = std::get<model::Dispatch>(executed->order);
  EXPECT_EQ(got.id, sent.id);
  EXPECT_EQ(got.robot, sent.robot);
  EXPECT_EQ(got.attempt, sent.attempt);
  EXPECT_EQ(got.from, sent.from);
  EXPECT_EQ(got.earliest, sent.earliest);
  EXPECT_EQ(got.latest, sent.latest);
  EXPECT_EQ(got.duration, sent.duration);
  EXPECT_EQ(got.holds, sent.holds);
  expect_same(sent.motion, got.motion);

  const auto withdrawn = pair.pass(withdrawal());
  ASSERT_TRUE(withdrawn);
  EXPECT_EQ(std::get<model::Withdrawal>(withdrawn->order).attempt, 7u);
  EXPECT_EQ(std::get<model::Withdrawal>(withdrawn->order).id.str(), "c-1");

  const auto beaten = pair.pass(heartbeat());
  ASSERT_TRUE(beaten);
  const auto& echo = std::get<dds::Heartbeat>(beaten->order);
  EXPECT_EQ(echo.robot, kRobot);
  EXPECT_EQ(echo.proxy_incarnation, 99u);
  EXPECT_EQ(echo.proxy_sent.count(), 123'456'789'012);
  EXPECT_EQ(echo.planner_received, at(3.1));
  EXPECT_EQ(echo.planner_sent, at(3.2));
  EXPECT_TRUE(echo.held);
}

TEST(RoundTrip, Execution) {
  Pair pair{dds::topics::execution("cell", kRobot)};
  ASSERT_TRUE(pair.match());
  const dds::ExecutionMessage sent = execution();
  const auto got = pair.pass(sent);
  ASSERT_TRUE(got) << pair.writer.last_refusal();
  EXPECT_EQ(got->planner_incarnation, 42u);
  EXPECT_EQ(got->proxy_incarnation, 99u);
  EXPECT_EQ(got->report.id, sent.report.id);
  EXPECT_EQ(got->report.robot, sent.report.robot);
  EXPECT_EQ(got->report.attempt, sent.report.attempt);
  EXPECT_EQ(got->report.state, sent.report.state);
  EXPECT_EQ(got->report.at, sent.report.at);
  EXPECT_EQ(got->report.uncertainty, sent.report.uncertainty);
  EXPECT_EQ(got->report.joints, sent.report.joints);
  EXPECT_EQ(got->report.text, sent.report.text);
  EXPECT_EQ(got->report.holds, sent.report.holds);
}

TEST(RoundTrip, Posture) {
  Pair pair{dds::topics::posture("cell", kRobot)};
  ASSERT_TRUE(pair.match());
  const dds::PostureMessage sent = posture();
  const auto got = pair.pass(sent);
  ASSERT_TRUE(got) << pair.writer.last_refusal();
  EXPECT_EQ(got->fingerprint, sent.fingerprint);
  EXPECT_EQ(got->proxy_incarnation, 99u);
  EXPECT_EQ(got->planner_incarnation, 42u);
  EXPECT_EQ(got->proxy_sent, sent.proxy_sent);
  EXPECT_EQ(got->posture.robot, kRobot);
  EXPECT_EQ(got->posture.at, sent.posture.at);
  EXPECT_EQ(got->posture.uncertainty, sent.posture.uncertainty);
  EXPECT_EQ(got->posture.joints, sent.posture.joints);
  expect_same(sent.posture.X_WT, got->posture.X_WT);
  EXPECT_TRUE(got->posture.moving);
  EXPECT_FALSE(got->posture.ready);
  EXPECT_EQ(got->posture.motion.str(), "c-1");
  EXPECT_EQ(got->posture.holds, sent.posture.holds);
  EXPECT_TRUE(got->held);
}

TEST(RoundTrip, PlannerState) {
  Pair pair{dds::topics::planner_state("cell")};
  ASSERT_TRUE(pair.match());
  model::PlannerState sent = planner_state("cell");
  const auto got = pair.pass(sent);
  ASSERT_TRUE(got) << pair.writer.last_refusal();
  EXPECT_EQ(got->cell, sent.cell);
  EXPECT_EQ(got->fingerprint, sent.fingerprint);
  EXPECT_EQ(got->incarnation, sent.incarnation);
  EXPECT_EQ(got->at, sent.at);
  EXPECT_EQ(got->strategy, sent.strategy);
  EXPECT_EQ(got->accepted, 16u);
  EXPECT_EQ(got->rejected, 1u);
  EXPECT_EQ(got->completed, 15u);
  EXPECT_EQ(got->refused_samples, 2u);
  ASSERT_EQ(got->robots.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(got->robots[i].name, sent.robots[i].name);
    EXPECT_EQ(got->robots[i].mode, sent.robots[i].mode);
    EXPECT_EQ(got->robots[i].queued, sent.robots[i].queued);
    EXPECT_EQ(got->robots[i].current, sent.robots[i].current);
    EXPECT_EQ(got->robots[i].serves, sent.robots[i].serves);
    EXPECT_EQ(got->robots[i].reason, sent.robots[i].reason);
    EXPECT_EQ(got->robots[i].text, sent.robots[i].text);
    expect_same(sent.robots[i].conflicts, got->robots[i].conflicts);
    expect_same(sent.robots[i].refusals, got->robots[i].refusals);
    EXPECT_EQ(got->robots[i].holds, sent.robots[i].holds);
    EXPECT_TRUE(got->robots[i].held);
  }
}

// The largest state a cell can have is far above one UDP datagram.
TEST(RoundTrip, LargestPlannerState) {
  Pair pair{dds::topics::planner_state("cell")};
  ASSERT_TRUE(pair.match());
  model::PlannerState sent = planner_state("cell");
  sent.robots.clear();
  for (int r = 0; r < 128; ++r) {
    sent.robots.push_back(robot_status("robot-" + std::to_string(r)));
    sent.robots.back().text = std::string(256, 't');
    sent.robots.back().conflicts.assign(16, conflict());
    sent.robots.back().holds.assign(32, model::ToolName{std::string(64, 't')});
    sent.robots.back().refusals.assign(16, {model::RobotName{std::string(64, 'r')}, model::EscapeWay::home, std::string(256, 'w')});
  }
  const auto got = pair.pass(sent);
  ASSERT_TRUE(got) << pair.writer.last_refusal();
  ASSERT_EQ(got->robots.size(), 128u);
  EXPECT_EQ(got->robots[127].conflicts.size(), 16u);
  expect_same(sent.robots[127].refusals, got->robots[127].refusals);

  sent.robots.push_back(robot_status("one-too-many"));
  EXPECT_FALSE(pair.writer.write(sent));
  EXPECT_NE(pair.writer.last_refusal().find("129 are too many"), std::string::npos) << pair.writer.last_refusal();
}

TEST(Wait, ReturnsAtTheDeadlineAndAtWake) {
  dds::Wait wait;
  const auto start = Clock::now();
  EXPECT_FALSE(wait.until(start + 50ms));
  EXPECT_GE(Clock::now() - start, 50ms);
  wait.wake();
  EXPECT_TRUE(wait.until(start + 1h));
  EXPECT_FALSE(wait.until(Clock::now() - 1s)) << "one wake() ends one until()";
}

TEST(Participant, RefusesADomainWithoutPorts) {
  EXPECT_THROW((dds::Participant{{233, "nobody"}}), std::invalid_argument);
}

TEST(Participant, TalksWithSharedMemoryAddedToo) {
  dds::Participant sender{{unique_domain(), "sender", true}};
  dds::Participant receiver{{unique_domain(), "receiver", true}};
  dds::Writer<dds::PostureMessage> writer{sender, dds::topics::posture("shm", kRobot)};
  dds::Reader<dds::PostureMessage> reader{receiver, dds::topics::posture("shm", kRobot)};
  dds::Wait wait;
  wait.attach(reader);
  ASSERT_TRUE(writer.write(posture()));
  EXPECT_TRUE(wait_until(wait, [&] { return reader.take([](dds::PostureMessage&&) {}) > 0; }));
}

TEST(Topics, RefuseNamesThatAreNone) {
  EXPECT_EQ(dds::topics::posture("cell", kRobot).name, "cell/r1/posture");
  EXPECT_EQ(dds::topics::planner_state("cell").name, "cell/planner_state");
  EXPECT_THROW(static_cast<void>(dds::topics::posture("a/b", kRobot)), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(dds::topics::posture("cell", model::RobotName{""})), std::invalid_argument);
}

}  // namespace
}  // namespace interlace::test
