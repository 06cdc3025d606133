#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <functional>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "common/dds/codec.hpp"
#include "common/dds/participant.hpp"
#include "common/dds/writer.hpp"
#include "planner/core/journal.hpp"
#include "recording/recording_reader.hpp"
#include "recording/recording_writer.hpp"
#include "recording/replay.hpp"
#include "tests/e2e/cells.hpp"
#include "tests/e2e/running_cell.hpp"
#include "tests/e2e/scratch.hpp"
#include "tests/integration/dds/samples.hpp"

// Recordings of real processes and of virtual time: read by a library that is not ours, replayed, and changed to see that it is noticed.
namespace interlace::test {
namespace {

using recording::RecordedSample;
using recording::RecordingReader;
using recording::RecordingWriter;

const std::string kCell = std::string{INTERLACE_CELLS_DIR} + "/exp-4-2/cell.yaml";
const std::string kProgram = std::string{INTERLACE_CELLS_DIR} + "/exp-4-2/program.yaml";
constexpr const char* kShort =
    "interlace: 1\nunits: {length: mm, angle: deg}\nprogram:\n  r1:\n    - {move: linear, to: {xyz: [400, 250, 300], rpy: [0, 0, 0]}}\n"
    "  r2:\n    - {move: linear, to: {xyz: [400, -250, 300], rpy: [0, 0, 0]}}\n";

std::string bits(double value) {
  std::uint64_t number = 0;
  std::memcpy(&number, &value, sizeof number);
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(number));
  return text;
}
std::int64_t ns(model::Instant t) {
  return t.time_since_epoch().count();
}

/// What tests/integration/mcap/read.mjs prints of a message, from what our own reader makes of it.
struct Fields {
  std::ostringstream& out;

  void operator()(const dds::CommandMessage& m) const {
    double x = 0;
    std::size_t kind = m.request.index() + 1;
    if (const auto* c = std::get_if<model::CommandSubmitted>(&m.request)) {
      const auto* linear = std::get_if<model::LinearTarget>(&c->motion.target);
      kind = linear ? 0 : 1;
      if (linear) x = linear->X_WT.translation().x();
    }
    out << "Command 4 " << kind << ' ';
    std::visit([&](const auto& r) { out << r.id.str() << ' ' << r.robot.str(); }, m.request);
    out << ' ' << bits(x);
  }
  void operator()(const dds::StatusMessage& m) const {
    const auto& s = m.status;
    out << "CommandStatus 4 " << s.id.str() << ' ' << static_cast<int>(s.state) << ' ' << static_cast<int>(s.reason) << ' '
        << ns(s.submitted) << ' ' << bits(s.delay) << ' ' << s.conflicts.size() << ' ' << s.text;
  }
  void operator()(const dds::DispatchMessage& m) const {
    out << "Dispatch 4 " << m.order.index() << ' ';
    if (const auto* d = std::get_if<model::Dispatch>(&m.order)) {
      out << d->robot.str() << ' ' << d->id.str() << ' ' << ns(d->earliest) << ' ' << bits(d->duration);
    } else if (const auto* w = std::get_if<model::Withdrawal>(&m.order)) {
      out << w->robot.str() << ' ' << w->id.str() << " 0 " << bits(0);
    } else {
      out << std::get<dds::Heartbeat>(m.order).robot.str() << "  0 " << bits(0);
    }
  }
  void operator()(const dds::ExecutionMessage& m) const {
    const auto& r = m.report;
    out << "Execution 4 " << r.id.str() << ' ' << static_cast<int>(r.state) << ' ' << ns(r.at) << ' ' << bits(r.joints[5]);
  }
  void operator()(const dds::PostureMessage& m) const {
    const auto& p = m.posture;
    out << "Posture 4 " << p.robot.str() << ' ' << ns(p.at);
    for (const double q : p.joints) out << ' ' << bits(q);
    out << ' ' << bits(p.X_WT.translation().x()) << ' ' << (p.moving ? "true" : "false") << ' ' << p.motion.str();
  }
  void operator()(const model::PlannerState& s) const {
    out << "PlannerState 4 " << s.cell << ' ' << ns(s.at) << ' ' << s.strategy << ' ';
    for (std::size_t i = 0; i < s.robots.size(); ++i) out << (i > 0 ? "," : "") << s.robots[i].name.str();
    out << ' ' << s.completed;
  }
  void operator()(const model::PlannerJournal& j) const {
    out << "PlannerJournal 4 " << j.first << ' ' << j.calls.size() << ' ' << ns(j.calls.back().now) << ' ' << j.calls.back().decided.digest;
  }
};

std::vector<RecordedSample> read_all(const std::string& file, bool expect_cut_off = false) {
  std::vector<RecordedSample> samples;
  auto reader = RecordingReader::open(file);
  EXPECT_TRUE(reader) << reader.error();
  while (reader) {
    auto next = (*reader)->next();
    EXPECT_TRUE(next) << next.error();
    if (!next || !*next) break;
    samples.push_back(std::move(**next));
  }
  EXPECT_TRUE(!reader || (*reader)->cut_off() == expect_cut_off);
  return samples;
}

std::vector<std::string> read_with_node(const std::string& file, const std::string& mode) {
  std::vector<std::string> arguments{INTERLACE_NODE, std::string{INTERLACE_MCAP_DIR} + "/read.mjs", file};
  if (!mode.empty()) arguments.push_back(mode);
  return arguments;
}

/// Lines of our reader and of the independent one are the same.
void expect_same_as_node(const std::string& file, bool cut_off = false) {
  std::ostringstream ours;
  const auto samples = read_all(file, cut_off);
  for (const RecordedSample& s : samples) {
    ours << s.topic << ' ' << s.log_time << ' ' << s.publish_time << " interlace/msg/";
    std::visit(Fields{ours}, s.message);
    ours << '\n';
  }
  if (!cut_off) ours << "indexed " << samples.size() << ' ' << samples.size() << '\n';
  Process node{read_with_node(file, cut_off ? "--stream" : ""), true};
  ASSERT_EQ(node.wait(std::chrono::seconds{60}), 0) << node.errors();
  std::istringstream a{ours.str()};
  std::istringstream b{node.output()};
  std::size_t n = 0;
  for (std::string x, y; std::getline(a, x); ++n) {
    ASSERT_TRUE(std::getline(b, y)) << "line " << n;
    ASSERT_EQ(x, y) << "line " << n;
  }
  EXPECT_GT(n, 100);
}

/// The recording again, with its journal changed; `change` says whether a message is kept.
void rewrite(const std::string& from, const std::string& to, const std::function<bool(model::PlannerJournal&)>& change) {
  auto out = RecordingWriter::create(to, false);
  ASSERT_TRUE(out);
  (*out)->attach_cell(read_text(kCell), 0);
  for (RecordedSample& s : read_all(from)) {
    auto* journal = std::get_if<model::PlannerJournal>(&s.message);
    if (journal && change(*journal)) {
      (*out)->write(dds::topics::planner_journal(journal->cell), s.log_time, s.publish_time, dds::encode(*journal));
    }
  }
  ASSERT_TRUE((*out)->close());
}

Outcome run_client(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), kClient);
  Process process{std::move(arguments), true};
  return outcome(process, kPatience);
}

std::string simulated(const Scratch& scratch) {
  const std::string file = scratch.path("sim.mcap");
  Process sim{{kSim, kCell, kProgram, "--record", file}, true};
  EXPECT_EQ(sim.wait(kPatience), 0) << sim.errors();
  return file;
}

/// Waits until `holds`; whether it does.
template <typename Condition>
bool until(const Condition& holds) {
  for (const auto end = std::chrono::steady_clock::now() + kPatience; std::chrono::steady_clock::now() < end;) {
    if (holds()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds{20});
  }
  return holds();
}

/// A recorder of `cell_file`, once it has told that it records.
std::unique_ptr<Process> recorder_of(const std::string& file, std::uint32_t domain, const std::string& cell_file = kCell) {
  auto recorder = std::make_unique<Process>(
      std::vector<std::string>{kClient, "record", file, "--cell", cell_file, "--domain", std::to_string(domain)}, true);
  EXPECT_TRUE(until([&] { return recorder->output().find("recording cell") != std::string::npos; })) << recorder->errors();
  return recorder;
}

/// Messages that can be read of a file that is still written to.
std::size_t messages_in(const std::string& file) {
  std::size_t count = 0;
  auto reader = RecordingReader::open(file);
  while (reader) {
    const auto next = (*reader)->next();
    if (!next || !*next) break;
    ++count;
  }
  return count;
}

std::string hex(const std::vector<std::uint8_t>& bytes) {
  std::string text;
  for (const std::uint8_t b : bytes) text += fmt::format("{:02x}", b);
  return text;
}

/// Publishes on one topic and keeps what it published.
template <typename Message>
struct Publisher {
  Publisher(dds::Participant& participant, const dds::Topic<Message>& its_topic) : topic(its_topic), writer(participant, its_topic) {}

  void publish(const Message& message) {
    ASSERT_TRUE(writer.write(message)) << writer.last_refusal();
    const std::vector<std::uint8_t> bytes = dds::encode(message);
    lines.push_back(fmt::format("{} {} {}", topic.name, lines.size(), hex(dds::encode(dds::decode<Message>(bytes, topic.owner).value()))));
  }
  /// A line of read.mjs --bytes with its gaps between members made 0: what was in them on the way has no meaning.
  [[nodiscard]] std::string plain(const std::string& line) const {
    const auto begin = line.rfind(' ') + 1;
    std::vector<std::uint8_t> bytes;
    for (std::size_t i = begin; i + 1 < line.size(); i += 2)
      bytes.push_back(static_cast<std::uint8_t>(std::stoi(line.substr(i, 2), nullptr, 16)));
    const auto message = dds::decode<Message>(bytes, topic.owner);
    return line.substr(0, begin) + (message ? hex(dds::encode(*message)) : message.error());
  }

  dds::Topic<Message> topic;
  dds::Writer<Message> writer;
  std::vector<std::string> lines;  // as read.mjs --bytes prints them and plain() makes them
};

TEST(Recording, HoldsEveryMessageThatWasPublishedInItsOrder) {
  const Scratch scratch;
  const std::string file = scratch.path("run.mcap");
  const std::uint32_t domain = unique_domain();
  const auto recorder = recorder_of(file, domain);
  dds::Participant participant{{domain, "publisher"}};
  const std::string cell = "exp-4-2";
  Publisher commands{participant, dds::topics::command(cell, kRobot)};
  Publisher statuses{participant, dds::topics::command_status(cell, kRobot)};
  Publisher dispatches{participant, dds::topics::dispatch(cell, kRobot)};
  Publisher executions{participant, dds::topics::execution(cell, kRobot)};
  Publisher postures{participant, dds::topics::posture(cell, kRobot)};
  Publisher states{participant, dds::topics::planner_state(cell)};
  ASSERT_TRUE(until([&] {
    return commands.writer.matched() + statuses.writer.matched() + dispatches.writer.matched() + executions.writer.matched() +
               postures.writer.matched() + states.writer.matched() ==
           6;
  }));
  constexpr std::size_t kRounds = 200;
  for (std::size_t i = 0; i < kRounds; ++i) {
    commands.publish(i % 2 == 0 ? linear_command(fmt::format("c-{}", i)) : replace_command());
    statuses.publish(status());
    dispatches.publish(i % 3 == 0 ? execute() : i % 3 == 1 ? withdrawal() : heartbeat());
    executions.publish(execution());
    dds::PostureMessage where = posture();
    where.posture.at = at(0.01 * static_cast<double>(i));
    postures.publish(where);
    states.publish(planner_state(cell));
    std::this_thread::sleep_for(std::chrono::milliseconds{2});  // a state is sent again only if nothing newer took its place
  }
  ASSERT_TRUE(until([&] { return messages_in(file) == 6 * kRounds; })) << messages_in(file);
  recorder->kill(SIGINT);
  ASSERT_EQ(recorder->wait(kPatience), 0) << recorder->errors();

  Process node{read_with_node(file, "--bytes"), true};
  ASSERT_EQ(node.wait(std::chrono::seconds{60}), 0) << node.errors();
  std::map<std::string, std::vector<std::string>> read;  // by topic
  std::istringstream all{node.output()};
  for (std::string line; std::getline(all, line);) read[line.substr(0, line.find(' '))].push_back(line);
  const auto expect = [&](const auto& publisher) {
    const auto& lines = read[publisher.topic.name];
    ASSERT_EQ(lines.size(), publisher.lines.size()) << publisher.topic.name;
    for (std::size_t i = 0; i < lines.size(); ++i) ASSERT_EQ(publisher.plain(lines[i]), publisher.lines[i]);
  };
  expect(commands);
  expect(statuses);
  expect(dispatches);
  expect(executions);
  expect(postures);
  expect(states);
  EXPECT_EQ(read.size(), 6);
}

/// What was recorded of `Message`, robot by robot, as lines.
template <typename Message>
std::map<std::string, std::vector<std::string>> recorded_of(const std::vector<RecordedSample>& samples) {
  std::map<std::string, std::vector<std::string>> lines;
  for (const RecordedSample& s : samples) {
    if (const auto* m = std::get_if<Message>(&s.message)) lines[s.topic].push_back(hex(dds::encode(*m)));
  }
  return lines;
}

/// The bytes a reader would make of `message` again.
template <typename Message>
std::string as_received(const Message& message, const model::RobotName& robot) {
  return hex(dds::encode(dds::decode<Message>(dds::encode(message), robot.str()).value()));
}

TEST(Recording, OfARunningCellHasAllThatThePlannerDecided) {
  const Scratch scratch;
  const std::string file = scratch.path("run.mcap");
  const std::string cell_file = scratch.file("cell.yaml", cell_text());
  RunningCell cell{unique_domain(), "fast", cell_file};
  const auto recorder = recorder_of(file, cell.domain(), cell_file);
  ASSERT_TRUE(cell.start({"--strategy", "lookahead"}));
  // Every kind of request, with priorities and deadlines.
  const std::string program = scratch.file("program.yaml", table_4_4());
  ASSERT_EQ(outcome(cell.send("r1", "out", {350, 0, 200}, {"--priority", "3", "--deadline", "0.01"})).exit_code, 0);
  ASSERT_EQ(cell.ask({"hold", "r1"}).exit_code, 0);
  Process& in = cell.send("r2", "in", {350, 0, 200});
  ASSERT_TRUE(until([&] { return (in.output() + in.errors()).find("held") != std::string::npos; }));
  ASSERT_EQ(outcome(cell.send("r2", "last", {400, -250, 330}, {"--no-wait"})).exit_code, 0);
  ASSERT_EQ(cell.ask({"cancel", "r2", "last"}).exit_code, 0);
  ASSERT_EQ(cell.ask({"resume", "r1"}).exit_code, 0);
  ASSERT_EQ(outcome(in).exit_code, 0);
  const std::string queue = "interlace: 1\nunits: {length: mm, angle: deg}\nprogram:\n  r1:\n    - " + linear(420, 250, 330) + "\n";
  ASSERT_EQ(cell.ask({"replace", "r1", scratch.file("queue.yaml", queue)}).exit_code, 0);
  ASSERT_EQ(cell.ask({"run", program}).exit_code, 0);
  ASSERT_EQ(cell.ask({"stop"}).exit_code, 0);
  cell.planner().kill(SIGTERM);
  ASSERT_EQ(cell.planner().wait(kPatience), 0);
  recorder->kill(SIGINT);
  ASSERT_EQ(recorder->wait(kPatience), 0) << recorder->errors();

  const auto recorded = recording::read_recorded(file, {});
  ASSERT_TRUE(recorded) << recorded.error();
  ASSERT_EQ(recorded->lives.size(), 1);
  const recording::PlannerLife& life = recorded->lives[0];
  EXPECT_EQ(life.settings.strategy, "lookahead");
  const auto model_cell = std::make_shared<const model::Cell>(recorded->cell.cell);
  const recording::Replay replay = recording::replay(model_cell, life);
  ASSERT_FALSE(replay.difference) << replay.difference->told << " -> " << replay.difference->decided;

  // What the planner decides again is what it published then, and nothing of it was lost.
  std::map<std::string, std::vector<std::string>> statuses, orders, requests, reports;
  core::Planner planner{model_cell, core::options_of(life.settings)};
  for (const model::PlannerCall& call : life.calls) {
    const core::Decisions d = core::apply(planner, call.event, call.now);
    const auto order = [&](const auto& o) {
      orders[dds::topics::dispatch("fast", o.robot).name].push_back(
          as_received(dds::DispatchMessage{life.incarnation, life.fingerprint, o}, o.robot));
    };
    for (const auto& w : d.withdrawals) order(w);
    for (const auto& x : d.dispatches) order(x);
    for (const auto& s : d.statuses)
      statuses[dds::topics::command_status("fast", s.robot).name].push_back(as_received(dds::StatusMessage{life.incarnation, s}, s.robot));
    if (const auto* request = std::get_if<model::ClientRequest>(&call.event)) {
      const model::RobotName robot = std::visit([](const auto& r) { return r.robot; }, *request);
      requests[dds::topics::command("fast", robot).name].push_back(std::visit([](const auto& r) { return r.id.str(); }, *request));
    }
    if (const auto* report = std::get_if<model::ExecutionReported>(&call.event))
      reports[dds::topics::execution("fast", report->robot).name].push_back(report->id.str() + to_string(report->state));
  }
  std::vector<RecordedSample> samples = read_all(file);
  std::map<std::string, std::vector<std::string>> recorded_requests, recorded_reports;
  for (const RecordedSample& s : samples) {
    if (const auto* c = std::get_if<dds::CommandMessage>(&s.message))
      recorded_requests[s.topic].push_back(std::visit([](const auto& r) { return r.id.str(); }, c->request));
    if (const auto* e = std::get_if<dds::ExecutionMessage>(&s.message))
      recorded_reports[s.topic].push_back(e->report.id.str() + to_string(e->report.state));
  }
  samples.erase(std::remove_if(samples.begin(), samples.end(),
                               [](const RecordedSample& s) {
                                 const auto* m = std::get_if<dds::DispatchMessage>(&s.message);
                                 return m && std::holds_alternative<dds::Heartbeat>(m->order);
                               }),
                samples.end());
  EXPECT_EQ(recorded_of<dds::StatusMessage>(samples), statuses);
  EXPECT_EQ(recorded_of<dds::DispatchMessage>(samples), orders);
  EXPECT_EQ(recorded_reports, reports);
  // A client that comes and goes may be heard by the planner before it is by the recorder; the journal has what it asked for anyway.
  for (const auto& [topic, ids] : recorded_requests) {
    for (const std::string& id : ids) EXPECT_EQ(std::count(requests[topic].begin(), requests[topic].end(), id) > 0, true) << topic << id;
  }
  EXPECT_GE(requests.size(), 2);
}

TEST(Recording, ThatIsStoppedHoldsNobodyUp) {
  const Scratch scratch;
  const std::string file = scratch.path("run.mcap");
  const std::string cell_file = scratch.file("cell.yaml", cell_text());
  RunningCell cell{unique_domain(), "fast", cell_file};
  const auto recorder = recorder_of(file, cell.domain(), cell_file);
  ASSERT_TRUE(cell.start());
  recorder->kill(SIGSTOP);
  EXPECT_EQ(cell.ask({"run", scratch.file("program.yaml", table_4_4(4))}).exit_code, 0);
  recorder->kill(SIGCONT);
  recorder->kill(SIGINT);
  ASSERT_EQ(recorder->wait(kPatience), 0) << recorder->errors();
  EXPECT_GT(read_all(file).size(), 0);
}

TEST(Recording, OfARunningCellOpensInAnotherLibraryAndReplaysToTheSameDecisions) {
  const Scratch scratch;
  const std::string file = scratch.path("run.mcap");
  RunningCell cell{unique_domain(), "exp-4-2", kCell};
  const auto recorder = recorder_of(file, cell.domain());
  ASSERT_TRUE(cell.start());
  ASSERT_EQ(cell.ask({"run", scratch.file("program.yaml", kShort)}).exit_code, 0);
  cell.planner().kill(SIGTERM);
  ASSERT_EQ(cell.planner().wait(kPatience), 0);
  recorder->kill(SIGTERM);
  ASSERT_EQ(recorder->wait(kPatience), 0) << recorder->errors();

  expect_same_as_node(file);
  const Outcome replay = run_client({"replay", file});
  EXPECT_EQ(replay.exit_code, 0) << replay.errors;
  EXPECT_NE(replay.output.find("all identical"), std::string::npos) << replay.output;
  EXPECT_EQ(run_client({"record", file, "--cell", kCell}).exit_code, 2);  // it is there
}

TEST(Recording, OfAKilledRecorderIsReadUpToItsLastSecond) {
  const Scratch scratch;
  const std::string file = scratch.path("run.mcap");
  RunningCell cell{unique_domain(), "exp-4-2", kCell};
  const auto recorder = recorder_of(file, cell.domain());
  ASSERT_TRUE(cell.start());
  ASSERT_EQ(cell.ask({"run", scratch.file("program.yaml", kShort)}).exit_code, 0);
  const std::size_t so_far = messages_in(file);
  ASSERT_TRUE(until([&] { return messages_in(file) > so_far; }));  // the next part was written
  recorder->kill(SIGKILL);
  expect_same_as_node(file, true);
  EXPECT_EQ(run_client({"replay", file}).exit_code, 0);
}

TEST(Recording, OfVirtualTimeIsTheSameKindOfFile) {
  const Scratch scratch;
  const std::string file = simulated(scratch);
  expect_same_as_node(file);
  EXPECT_EQ(run_client({"replay", file}).exit_code, 0);
}

TEST(Replay, NamesTheFirstDecisionThatDiffers) {
  const Scratch scratch;
  const std::string file = simulated(scratch);
  bool changed = false;
  rewrite(file, scratch.path("changed.mcap"), [&](model::PlannerJournal& j) {
    for (auto& call : j.calls) {
      if (changed || call.decided.dispatches == 0) continue;
      call.decided.digest ^= 1;
      changed = true;
    }
    return true;
  });
  ASSERT_TRUE(changed);
  const Outcome digest = run_client({"replay", scratch.path("changed.mcap")});
  EXPECT_EQ(digest.exit_code, 1);
  EXPECT_NE(digest.errors.find("decides differently"), std::string::npos) << digest.errors;

  changed = false;
  rewrite(file, scratch.path("moved.mcap"), [&](model::PlannerJournal& j) {
    for (auto& call : j.calls) {
      auto* request = std::get_if<model::ClientRequest>(&call.event);
      auto* command = request ? std::get_if<model::CommandSubmitted>(request) : nullptr;
      if (changed || !command) continue;
      std::get<model::LinearTarget>(command->motion.target).X_WT.translation().x() += 1e-12;
      changed = true;
    }
    return true;
  });
  ASSERT_TRUE(changed);
  EXPECT_EQ(run_client({"replay", scratch.path("moved.mcap")}).exit_code, 1);
}

TEST(Replay, RefusesARecordingThatBeginsTooLateOrHasAGap) {
  const Scratch scratch;
  const std::string file = simulated(scratch);
  rewrite(file, scratch.path("late.mcap"), [](const model::PlannerJournal& j) { return j.first > 0; });
  const Outcome late = run_client({"replay", scratch.path("late.mcap")});
  EXPECT_EQ(late.exit_code, 2);
  EXPECT_NE(late.errors.find("record it from its start"), std::string::npos) << late.errors;
  rewrite(file, scratch.path("gap.mcap"), [](model::PlannerJournal& j) {
    if (j.first > 0) j.first += 5;
    return true;
  });
  const Outcome gap = run_client({"replay", scratch.path("gap.mcap")});
  EXPECT_EQ(gap.exit_code, 2);
  EXPECT_NE(gap.errors.find("gap"), std::string::npos) << gap.errors;
  EXPECT_EQ(run_client({"replay", kCell}).exit_code, 2);
  EXPECT_EQ(run_client({"replay", scratch.path("nothing.mcap")}).exit_code, 2);
}

TEST(Replay, RefusesABrokenFileAndNamesThePlace) {
  const Scratch scratch;
  const std::string whole = read_text(simulated(scratch));
  std::string flipped = whole;
  flipped[whole.size() / 2] = static_cast<char>(flipped[whole.size() / 2] ^ 0x40);
  const Outcome broken = run_client({"replay", scratch.file("flipped.mcap", flipped)});
  EXPECT_EQ(broken.exit_code, 2);
  EXPECT_TRUE(broken.says("flipped.mcap: byte ") && broken.says("checksum does not agree")) << broken;
  const Outcome cut = run_client({"replay", scratch.file("cut.mcap", whole.substr(0, whole.size() / 2))});
  EXPECT_EQ(cut.exit_code, 0) << "what is whole can be replayed\n" << cut;
  EXPECT_TRUE(cut.says("was not ended properly, it is whole up to byte ")) << cut;
  const Outcome head = run_client({"replay", scratch.file("head.mcap", whole.substr(0, 5))});
  EXPECT_EQ(head.exit_code, 2);
  EXPECT_TRUE(head.says("head.mcap: byte 0: not an MCAP file")) << head;
}

/// Requests of every kind come back from the file and are decided as they were, whatever the strategy.
TEST(Replay, OfEveryStrategyIsIdentical) {
  const Scratch scratch;
  const std::string cell = scratch.file("cell.yaml", cell_text());
  const std::string program = scratch.file("program.yaml", table_4_4() +
                                                               "events:\n"
                                                               "  - {at: 0.5, hold: r1}\n  - {at: 1.5, resume: r1}\n"
                                                               "  - {at: 0.7, cancel: r2, command: 3}\n"
                                                               "  - at: 2\n    replace: r2\n    by:\n      - " +
                                                               linear(400, -250, 330) + "\n");
  Process sim{{kSim, cell, program, "--strategy", "all", "--record", scratch.path("run.mcap")}, true};
  ASSERT_TRUE(sim.wait(3 * kPatience)) << sim.output();
  for (const char* strategy : {"direct", "zone", "eef-map", "acm", "event", "lookahead"}) {
    const Outcome o = run_client({"replay", scratch.path(std::string{"run."} + strategy + ".mcap")});
    EXPECT_EQ(o.exit_code, 0) << strategy << '\n' << o;
    EXPECT_TRUE(o.says("all identical")) << o;
  }
}

TEST(Replay, ShowsWhatWouldHaveHappened) {
  const Scratch scratch;
  const std::string file = simulated(scratch);
  const std::string report = scratch.path("report.json");
  const Outcome same = run_client({"replay", file, "--strategy", "event", "--report", report});
  EXPECT_EQ(same.exit_code, 0) << same.errors;
  const auto json = nlohmann::json::parse(read_text(report));
  EXPECT_EQ(json["recorded"]["completed"], 16);
  EXPECT_NEAR(json["recorded"]["makespan_s"].get<double>(), json["simulated_changed"]["makespan_s"].get<double>(), 1e-9);
  const Outcome zone = run_client({"replay", file, "--strategy", "zone", "--report", report});
  EXPECT_EQ(zone.exit_code, 0) << zone.errors;
  const auto slower = nlohmann::json::parse(read_text(report));
  EXPECT_GT(slower["simulated_changed"]["makespan_s"].get<double>(), slower["recorded"]["makespan_s"].get<double>() + 1);
  EXPECT_EQ(run_client({"replay", file, "--strategy", "direct"}).exit_code, 3);
  EXPECT_EQ(run_client({"replay", file, "--strategy", "none"}).exit_code, 2);
}

TEST(Recording, SaysWhenTheDiskIsFull) {
  const Outcome full = run_client({"record", "/dev/full", "--overwrite", "--cell", kCell, "--domain", std::to_string(unique_domain())});
  EXPECT_EQ(full.exit_code, 5);
  EXPECT_NE(full.errors.find("No space left on device"), std::string::npos) << full.errors;
}

}  // namespace
}  // namespace interlace::test
