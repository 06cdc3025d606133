#include <gtest/gtest.h>

#include <cstring>
#include <functional>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "common/dds/codec.hpp"
#include "recording/recording_reader.hpp"
#include "recording/recording_writer.hpp"
#include "tests/e2e/cells.hpp"
#include "tests/e2e/running_cell.hpp"
#include "tests/e2e/scratch.hpp"

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
  if (reader) EXPECT_EQ((*reader)->cut_off(), expect_cut_off);
  return samples;
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
  Process node{{INTERLACE_NODE, std::string{INTERLACE_MCAP_DIR} + "/read.mjs", file, cut_off ? "--stream" : ""}, true};
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

TEST(Recording, OfARunningCellOpensInAnotherLibraryAndReplaysToTheSameDecisions) {
  const Scratch scratch;
  const std::string file = scratch.path("run.mcap");
  RunningCell cell{unique_domain(), "exp-4-2", kCell};
  Process recorder{{kClient, "record", file, "--cell", kCell, "--domain", std::to_string(cell.domain())}, true};
  ASSERT_TRUE(cell.start());
  ASSERT_EQ(cell.ask({"run", scratch.file("program.yaml", kShort)}).exit_code, 0);
  cell.planner().kill(SIGTERM);
  ASSERT_EQ(cell.planner().wait(kPatience), 0);
  recorder.kill(SIGTERM);
  ASSERT_EQ(recorder.wait(kPatience), 0) << recorder.errors();

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
  Process recorder{{kClient, "record", file, "--cell", kCell, "--domain", std::to_string(cell.domain())}, true};
  ASSERT_TRUE(cell.start());
  ASSERT_EQ(cell.ask({"run", scratch.file("program.yaml", kShort)}).exit_code, 0);
  std::this_thread::sleep_for(std::chrono::seconds{1});
  recorder.kill(SIGKILL);
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
