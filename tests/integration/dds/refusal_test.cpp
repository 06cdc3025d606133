#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "common/dds/convert.hpp"
#include "tests/integration/dds/peers.hpp"
#include "tests/integration/dds/raw_writer.hpp"
#include "tests/integration/dds/samples.hpp"

// Every rule of idl/README.md, broken by a foreign writer: the sample is refused and counted with the field's name, and a good sample
// after it still arrives.
namespace interlace::test {
namespace {

namespace wire = ::interlace;

const double kNaN = std::numeric_limits<double>::quiet_NaN();
const double kInfinity = std::numeric_limits<double>::infinity();

template <typename Wire>
struct BadSample {
  std::string refusal;  // what the counted reason must say
  std::function<void(Wire&)> spoil;
};

template <typename Message>
void expect_refusals(const dds::Topic<Message>& topic, const Message& good, const std::vector<BadSample<dds::WireOf<Message>>>& bad) {
  dds::Participant foreign{{unique_domain(), "foreign"}};
  dds::Participant ours{{unique_domain(), "ours"}};
  RawWriter<dds::WireOf<Message>> writer{foreign, topic.name, dds::WireTraits<Message>::stream};
  dds::Reader<Message> reader{ours, topic};
  dds::Wait wait;
  wait.attach(reader);
  std::uint64_t passed_on = 0;
  const auto take = [&] { reader.take([&](Message&&) { ++passed_on; }); };
  ASSERT_TRUE(wait_until(wait, [&] {
    take();
    return reader.counters().writers == 1;
  }));
  // The reader may know the writer before the writer knows it: the first sample, on a volatile topic, must not be lost to that.
  const dds::WireOf<Message> good_wire = dds::to_wire(good);
  ASSERT_TRUE(wait_until(wait, [&] {
    take();
    return passed_on > 0 || !writer.write(good_wire);
  }));
  for (const auto& sample : bad) {
    SCOPED_TRACE(sample.refusal);
    take();
    const std::uint64_t before = reader.counters().refused;
    const std::uint64_t passed_before = passed_on;
    dds::WireOf<Message> spoilt = good_wire;
    sample.spoil(spoilt);
    ASSERT_TRUE(writer.write(spoilt));
    ASSERT_TRUE(wait_until(wait, [&] {
      take();
      return reader.counters().refused > before || passed_on > passed_before + 100;
    })) << "neither refused nor passed on";
    EXPECT_EQ(reader.counters().refused, before + 1);
    EXPECT_NE(reader.counters().last_refusal.find(sample.refusal), std::string::npos) << reader.counters().last_refusal;
    EXPECT_EQ(reader.counters().last_refusal.rfind(topic.name + ": ", 0), 0u) << reader.counters().last_refusal;

    const std::uint64_t good_before = passed_on;
    ASSERT_TRUE(writer.write(good_wire));
    ASSERT_TRUE(wait_until(wait, [&] {
      take();
      return passed_on > good_before;
    })) << "a good sample after the bad one is lost";
  }
}

TEST(Refusal, Command) {
  expect_refusals<dds::CommandMessage>(dds::topics::command("cell", kRobot), linear_command(),
                                       {
                                           {"version: 1", [](auto& c) { c.version(1); }},
                                           {"version 0", [](auto& c) { c.version(0); }},
                                           {"kind: 7", [](auto& c) { c.kind(static_cast<wire::CommandKind>(7)); }},
                                           {"deadline: nan", [](auto& c) { c.deadline(kNaN); }},
                                           {"deadline: -1", [](auto& c) { c.deadline(-1); }},
                                           {"deadline: 100000000", [](auto& c) { c.deadline(1e8); }},
                                           {"kind: 4294967295", [](auto& c) { c.kind(static_cast<wire::CommandKind>(0xFFFFFFFF)); }},
                                           {"id: ''", [](auto& c) { c.id(""); }},
                                           {"id: 'a b'", [](auto& c) { c.id("a b"); }},
                                           {"id: 'xxx", [](auto& c) { c.id(std::string(65, 'x')); }},
                                           {"robot: 'r2' on the topic of 'r1'", [](auto& c) { c.robot("r2"); }},
                                           {"client: ''", [](auto& c) { c.client(""); }},
                                           {"client: 'me?you'", [](auto& c) { c.client("me\nyou"); }},
                                           {"motion.position.x: nan", [](auto& c) { c.motion().position().x(kNaN); }},
                                           {"motion.position.y: inf", [](auto& c) { c.motion().position().y(kInfinity); }},
                                           {"motion.position.z: -100000", [](auto& c) { c.motion().position().z(-1e5); }},
                                           {"motion.orientation: 0.9",
                                            [](auto& c) {
                                              auto& q = c.motion().orientation();
                                              q.w(0.9);
                                              q.x(0);
                                              q.y(0);
                                              q.z(0);
                                            }},
                                           {"motion.orientation: nan", [](auto& c) { c.motion().orientation().w(kNaN); }},
                                           {"motion.velocity: nan", [](auto& c) { c.motion().velocity(kNaN); }},
                                           {"motion.acceleration: inf", [](auto& c) { c.motion().acceleration(kInfinity); }},
                                           {"motion.attach: 'a b'", [](auto& c) { c.motion().attach("a b"); }},
                                           {"motion.detach: 'a/b'", [](auto& c) { c.motion().detach("a/b"); }},
                                           {"motion.tool_time: 2", [](auto& c) { c.motion().tool_time(static_cast<wire::ToolTime>(2)); }},
                                       });
}

TEST(Refusal, Replacement) {
  expect_refusals<dds::CommandMessage>(dds::topics::command("cell", kRobot), replace_command(),
                                       {
                                           {"malformed", [](auto& c) { c.queue().resize(101); }},
                                           {"queue.id: 'a b'", [](auto& c) { c.queue()[1].id("a b"); }},
                                           {"queue.kind: 2", [](auto& c) { c.queue()[0].kind(wire::COMMAND_CANCEL); }},
                                           {"motion.position.x: nan", [](auto& c) { c.queue()[0].motion().position().x(kNaN); }},
                                           {"deadline: inf", [](auto& c) { c.queue()[0].deadline(kInfinity); }},
                                       });
}

TEST(Refusal, JointCommand) {
  expect_refusals<dds::CommandMessage>(dds::topics::command("cell", kRobot), joint_command(),
                                       {
                                           {"motion.joints[0]: nan", [](auto& c) { c.motion().joints()[0] = kNaN; }},
                                           {"motion.joints[5]: 1001", [](auto& c) { c.motion().joints()[5] = 1001; }},
                                       });
}

TEST(Refusal, CommandStatus) {
  expect_refusals<dds::StatusMessage>(
      dds::topics::command_status("cell", kRobot), status(),
      {
          {"version: 7", [](auto& s) { s.version(7); }},
          {"id: 'a/b'", [](auto& s) { s.id("a/b"); }},
          {"robot: 'r9'", [](auto& s) { s.robot("r9"); }},
          {"serves: 'a b'", [](auto& s) { s.serves("a b"); }},
          {"serves: 'xxx", [](auto& s) { s.serves(std::string(65, 'x')); }},
          {"state: 8", [](auto& s) { s.state(static_cast<wire::CommandState>(8)); }},
          {"reason: 24", [](auto& s) { s.reason(static_cast<wire::ReasonCode>(24)); }},
          {"verdict: 5", [](auto& s) { s.verdict(static_cast<wire::DeadlineVerdict>(5)); }},
          {"deadline: 3000000000000000001", [](auto& s) { s.deadline(3'000'000'000'000'000'001); }},
          {"text: 'two?lines' holds control", [](auto& s) { s.text("two\nlines"); }},
          {"text: '?' holds control characters or is not UTF-8", [](auto& s) { s.text("\xC0"); }},
          {"is too long", [](auto& s) { s.text(std::string(257, 't')); }},
          {"submitted: 9223372036854775807", [](auto& s) { s.submitted(std::numeric_limits<std::int64_t>::max()); }},
          {"start: -9223372036854775808", [](auto& s) { s.start(std::numeric_limits<std::int64_t>::min()); }},
          {"end: 3000000000000000001", [](auto& s) { s.end(3'000'000'000'000'000'001); }},
          {"delay: nan", [](auto& s) { s.delay(kNaN); }},
          {"malformed", [](auto& s) { s.conflicts().resize(17); }},
          {"conflicts.blocker: ''", [](auto& s) { s.conflicts()[1].blocker(""); }},
          {"conflicts.own_link: '?", [](auto& s) { s.conflicts()[0].own_link("\x01"); }},
          {"conflicts.blocker_link: 'lll", [](auto& s) { s.conflicts()[0].blocker_link(std::string(65, 'l')); }},
          {"conflicts.from: 4", [](auto& s) { s.conflicts()[0].from(4'000'000'000'000'000'000); }},
          {"conflicts.clearance: -inf", [](auto& s) { s.conflicts()[0].clearance(-kInfinity); }},
          {"conflicts.place.z: nan", [](auto& s) { s.conflicts()[0].place().z(kNaN); }},
          {"malformed", [](auto& s) { s.refusals().resize(17); }},
          {"refusals.robot: ''", [](auto& s) { s.refusals()[1].robot(""); }},
          {"refusals.way: 8", [](auto& s) { s.refusals()[1].way(static_cast<wire::EscapeWay>(8)); }},
          {"refusals.text: 'a?b' holds control", [](auto& s) { s.refusals()[0].text("a\tb"); }},
          {"is too long", [](auto& s) { s.refusals()[0].text(std::string(257, 't')); }},
      });
}

TEST(Refusal, Dispatch) {
  expect_refusals<dds::DispatchMessage>(dds::topics::dispatch("cell", kRobot), execute(),
                                        {
                                            {"version: 1", [](auto& d) { d.version(1); }},
                                            {"planner_incarnation: 0", [](auto& d) { d.planner_incarnation(0); }},
                                            {"kind: 3", [](auto& d) { d.kind(static_cast<wire::DispatchKind>(3)); }},
                                            {"motion_kind: 2", [](auto& d) { d.motion_kind(static_cast<wire::MotionKind>(2)); }},
                                            {"robot: 'r2'", [](auto& d) { d.robot("r2"); }},
                                            {"id: ''", [](auto& d) { d.id(""); }},
                                            {"motion.joints[3]: inf", [](auto& d) { d.motion().joints()[3] = kInfinity; }},
                                            {"from[2]: nan", [](auto& d) { d.from()[2] = kNaN; }},
                                            {"latest: before earliest", [](auto& d) { d.latest(d.earliest() - 1); }},
                                            {"earliest: 9223372036854775807", [](auto& d) { d.earliest(wire::FOREVER); }},
                                            {"duration: -1", [](auto& d) { d.duration(-1); }},
                                            {"holds: 'a b'", [](auto& d) { d.holds()[1] = "a b"; }},
                                            {"malformed", [](auto& d) { d.holds().resize(33); }},
                                        });
}

TEST(Refusal, Execution) {
  expect_refusals<dds::ExecutionMessage>(dds::topics::execution("cell", kRobot), execution(),
                                         {
                                             {"version: 1", [](auto& e) { e.version(1); }},
                                             {"robot: 'r2'", [](auto& e) { e.robot("r2"); }},
                                             {"id: ''", [](auto& e) { e.id(""); }},
                                             {"state: 6", [](auto& e) { e.state(static_cast<wire::ExecutionState>(6)); }},
                                             {"at: 9223372036854775807", [](auto& e) { e.at(wire::FOREVER); }},
                                             {"uncertainty: -0.1", [](auto& e) { e.uncertainty(-0.1); }},
                                             {"joints[1]: nan", [](auto& e) { e.joints()[1] = kNaN; }},
                                             {"is too long", [](auto& e) { e.text(std::string(257, 't')); }},
                                             {"holds: ''", [](auto& e) { e.holds()[0] = ""; }},
                                             {"malformed", [](auto& e) { e.holds().resize(33); }},
                                         });
}

TEST(Refusal, Posture) {
  expect_refusals<dds::PostureMessage>(dds::topics::posture("cell", kRobot), posture(),
                                       {
                                           {"version: 1", [](auto& p) { p.version(1); }},
                                           {"robot: 'r2'", [](auto& p) { p.robot("r2"); }},
                                           {"proxy_incarnation: 0", [](auto& p) { p.proxy_incarnation(0); }},
                                           {"proxy_sent: 9223372036854775807", [](auto& p) { p.proxy_sent(wire::FOREVER); }},
                                           {"at: 9223372036854775807", [](auto& p) { p.at(wire::FOREVER); }},
                                           {"uncertainty: nan", [](auto& p) { p.uncertainty(kNaN); }},
                                           {"joints[4]: -2000", [](auto& p) { p.joints()[4] = -2000; }},
                                           {"position.x: nan", [](auto& p) { p.position().x(kNaN); }},
                                           {"orientation: 0.0", [](auto& p) { p.orientation(wire::Quaternion{}); }},
                                           {"motion: 'a b'", [](auto& p) { p.motion("a b"); }},
                                           {"holds: 'a b'", [](auto& p) { p.holds()[0] = "a b"; }},
                                           {"malformed", [](auto& p) { p.holds().resize(33); }},
                                       });
}

TEST(Refusal, PlannerState) {
  expect_refusals<model::PlannerState>(
      dds::topics::planner_state("cell"), planner_state("cell"),
      {
          {"version: 1", [](auto& s) { s.version(1); }},
          {"cell: 'other'", [](auto& s) { s.cell("other"); }},
          {"incarnation: 0", [](auto& s) { s.incarnation(0); }},
          {"at: -9223372036854775808", [](auto& s) { s.at(std::numeric_limits<std::int64_t>::min()); }},
          {"strategy: ''", [](auto& s) { s.strategy(""); }},
          {"robots.name: ''", [](auto& s) { s.robots()[1].name(""); }},
          {"robots.mode: 4", [](auto& s) { s.robots()[0].mode(static_cast<wire::RobotMode>(4)); }},
          {"robots.current: 'a b'", [](auto& s) { s.robots()[0].current("a b"); }},
          {"robots.serves: 'a b'", [](auto& s) { s.robots()[1].serves("a b"); }},
          {"robots.reason: 99", [](auto& s) { s.robots()[0].reason(static_cast<wire::ReasonCode>(99)); }},
          {"robots.text: '?'", [](auto& s) { s.robots()[0].text("\x7f"); }},
          {"conflicts.place.y: nan", [](auto& s) { s.robots()[1].conflicts()[0].place().y(kNaN); }},
          {"malformed", [](auto& s) { s.robots()[0].refusals().resize(17); }},
          {"refusals.robot: 'a b'", [](auto& s) { s.robots()[1].refusals()[0].robot("a b"); }},
          {"refusals.way: 9", [](auto& s) { s.robots()[1].refusals()[1].way(static_cast<wire::EscapeWay>(9)); }},
          {"robots.holds: 'a b'", [](auto& s) { s.robots()[1].holds()[1] = "a b"; }},
          {"malformed", [](auto& s) { s.robots()[1].holds().resize(33); }},
      });
}

/// Sends each of `bad` as bytes of `type_name` and expects it refused as malformed, then the good sample accepted.
template <typename Message>
void expect_malformed(const dds::Topic<Message>& topic, const char* type_name, bool keyed, const Message& good,
                      const std::vector<Bytes>& bad) {
  dds::Participant foreign{{unique_domain(), "foreign"}};
  dds::Participant ours{{unique_domain(), "ours"}};
  BytesWriter writer{foreign, topic.name, type_name, dds::WireTraits<Message>::stream, keyed};
  dds::Reader<Message> reader{ours, topic};
  dds::Wait wait;
  wait.attach(reader);
  std::uint64_t passed_on = 0;
  const auto take = [&] { reader.take([&](Message&&) { ++passed_on; }); };
  const Bytes good_bytes = serialised(dds::to_wire(good));
  ASSERT_TRUE(wait_until(wait, [&] {
    take();
    return passed_on > 0 || !writer.write(good_bytes);
  }));
  for (std::size_t i = 0; i < bad.size(); ++i) {
    SCOPED_TRACE(i);
    const std::uint64_t before = reader.counters().refused;
    ASSERT_TRUE(writer.write(bad[i]));
    ASSERT_TRUE(wait_until(wait, [&] {
      take();
      return reader.counters().refused > before;
    }));
    EXPECT_EQ(reader.counters().refused, before + 1);
    const std::uint64_t good_before = passed_on;
    ASSERT_TRUE(writer.write(good_bytes));
    ASSERT_TRUE(wait_until(wait, [&] {
      take();
      return passed_on > good_before;
    }));
  }
}

Bytes cut(Bytes bytes, std::size_t length) {
  bytes.resize(length);
  return bytes;
}

/// `bytes` with the four bytes at `at` replaced, little endian as the encapsulation says.
Bytes patched(Bytes bytes, std::size_t at, std::uint32_t value) {
  for (std::size_t i = 0; i < 4; ++i) bytes.at(at + i) = static_cast<unsigned char>(value >> (8 * i));
  return bytes;
}

TEST(Malformed, Command) {
  const Bytes good = serialised(dds::to_wire(linear_command()));
  constexpr std::size_t kIdLength = 4 + 8;  // after the encapsulation, version and kind
  Bytes bad_boolean = good;
  constexpr std::size_t kHasVelocity = 4 + 40 + 24 + 32 + 48;  // after the encapsulation, the head, position, orientation and joints
  ASSERT_EQ(good.at(kHasVelocity), 1) << "the test looks at the wrong place";
  bad_boolean.at(kHasVelocity) = 7;
  expect_malformed(dds::topics::command("cell", kRobot), "interlace::Command", false, linear_command(),
                   {Bytes{0, 1, 0, 0}, cut(good, good.size() / 2), cut(good, good.size() - 4), patched(good, kIdLength, 0xFFFFFFFF),
                    Bytes(300, 0xFF), bad_boolean, patched(good, good.size() - 4, 101), patched(good, good.size() - 4, 0xFFFFFFFF)});
}

TEST(Malformed, CommandStatusThatClaimsTooMuch) {
  dds::StatusMessage none = status();
  none.status.conflicts.clear();
  none.status.refusals.clear();
  const Bytes good = serialised(dds::to_wire(none));
  const std::size_t refusals = good.size() - 4 - 4 - 4 - 8;  // the sequences come before the verdict, padding and the deadline
  const std::size_t conflicts = refusals - 4;
  expect_malformed(dds::topics::command_status("cell", kRobot), "interlace::CommandStatus", false, none,
                   {patched(good, conflicts, 17), patched(good, conflicts, 100'000'000), patched(good, conflicts, 0xFFFFFFFF),
                    patched(good, refusals, 17), patched(good, refusals, 100'000'000), patched(good, refusals, 0xFFFFFFFF)});
}

TEST(Malformed, PostureThatClaimsTooMuch) {
  dds::PostureMessage bare = posture();
  bare.posture.holds.clear();
  const Bytes good = serialised(dds::to_wire(bare));
  const std::size_t tools = good.size() - 1 - 4;  // the sequence comes before one flag
  expect_malformed(dds::topics::posture("cell", kRobot), "interlace::Posture", true, bare,
                   {patched(good, tools, 33), patched(good, tools, 100'000'000), patched(good, tools, 0xFFFFFFFF)});
}

TEST(Malformed, ExecutionThatClaimsTooMuch) {
  dds::ExecutionMessage bare = execution();
  bare.report.holds.clear();
  const Bytes good = serialised(dds::to_wire(bare));
  const std::size_t tools = good.size() - 4;
  expect_malformed(dds::topics::execution("cell", kRobot), "interlace::Execution", false, bare,
                   {patched(good, tools, 33), patched(good, tools, 100'000'000), patched(good, tools, 0xFFFFFFFF)});
}

TEST(Malformed, PlannerStateThatClaimsTooMuch) {
  model::PlannerState empty = planner_state("cell");
  empty.robots.clear();
  const Bytes good = serialised(dds::to_wire(empty));
  // The count of robots comes before four 64-bit counters, which are aligned to 8 behind the 4 bytes of encapsulation.
  constexpr std::size_t kCounters = 32;
  const Bytes two_robots = serialised(dds::to_wire(planner_state("cell")));
  std::size_t count = good.size() - kCounters - 4;
  if (two_robots.at(count) != 2) count -= 4;  // padding
  ASSERT_EQ(two_robots.at(count), 2) << "the test looks at the wrong place";
  expect_malformed(dds::topics::planner_state("cell"), "interlace::PlannerState", true, empty,
                   {patched(good, count, 129), patched(good, count, 50'000'000), patched(good, count, 0xFFFFFFFF)});
}

// What this process would send and its readers would refuse is refused here, with the reason.
TEST(Refusal, WriterChecksItself) {
  dds::Participant ours{{unique_domain(), "ours"}};
  dds::Writer<dds::PostureMessage> writer{ours, dds::topics::posture("cell", kRobot)};
  dds::PostureMessage message = posture();
  message.posture.joints[2] = kNaN;
  EXPECT_FALSE(writer.write(message));
  EXPECT_NE(writer.last_refusal().find("cell/r1/posture: joints[2]: nan"), std::string::npos) << writer.last_refusal();
  EXPECT_TRUE(writer.write(posture()));
  EXPECT_EQ(writer.last_refusal(), "");
  EXPECT_FALSE(writer.write(posture(model::RobotName{"r2"})));
}

}  // namespace
}  // namespace interlace::test
