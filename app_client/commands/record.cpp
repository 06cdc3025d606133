#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <memory>
#include <sstream>

#include "app_client/commands/recordings.hpp"
#include "common/app/command_line.hpp"
#include "common/app/config/cell_file.hpp"
#include "common/dds/raw_reader.hpp"
#include "common/dds/wait.hpp"
#include "recording/recording_writer.hpp"

namespace interlace::client::commands {

namespace {

using app::ExitCode;

struct RecordArguments {
  std::string file, cell;
  int domain = 0;
  double duration = 0;  // [s]; 0: until a signal
  bool overwrite = false;
};

/// What is to be recorded.
struct RecordedCell {
  std::string name;
  std::optional<std::string> text;  // of the cell file
  std::optional<app::LoadedCell> loaded;
};

/// Wall clock at the start and the monotonic clock since: a jump of the wall clock changes neither order nor distances.
class RecordClock {
 public:
  [[nodiscard]] std::uint64_t now() const {
    const auto since = std::chrono::steady_clock::now() - monotonic_;
    return static_cast<std::uint64_t>((wall_.time_since_epoch() + since) / std::chrono::nanoseconds{1});
  }

 private:
  std::chrono::system_clock::time_point wall_ = std::chrono::system_clock::now();
  std::chrono::steady_clock::time_point monotonic_ = std::chrono::steady_clock::now();
};

/// One topic that is recorded.
template <typename Message>
struct Track {
  Track(dds::Participant& participant, dds::Topic<Message> t) : topic(std::move(t)), reader(participant, topic) {}

  template <typename Each>
  void take(const RecordClock& clock, recording::RecordingWriter& out, Each&& each) {
    reader.take([&](const dds::RawSample& sample, const Message& message) {
      out.write(topic, clock.now(), static_cast<std::uint64_t>(std::max<std::int64_t>(sample.published, 0)), sample.cdr);
      each(message);
    });
  }
  void take(const RecordClock& clock, recording::RecordingWriter& out) {
    take(clock, out, [](const Message&) {});
  }

  dds::Topic<Message> topic;
  dds::RawReader<Message> reader;
};

struct RobotTracks {
  RobotTracks(dds::Participant& p, const std::string& cell, const model::RobotName& robot)
      : command(p, dds::topics::command(cell, robot)),
        status(p, dds::topics::command_status(cell, robot)),
        dispatch(p, dds::topics::dispatch(cell, robot)),
        execution(p, dds::topics::execution(cell, robot)),
        posture(p, dds::topics::posture(cell, robot)) {}

  Track<dds::CommandMessage> command;
  Track<dds::StatusMessage> status;
  Track<dds::DispatchMessage> dispatch;
  Track<dds::ExecutionMessage> execution;
  Track<dds::PostureMessage> posture;
};

class Recorder {
 public:
  Recorder(const RecordArguments& a, const RecordedCell& cell, recording::RecordingWriter& out)
      : a_(a),
        cell_(cell),
        out_(out),
        participant_({static_cast<std::uint32_t>(a.domain), "interlace-record " + cell.name}),
        state_(participant_, dds::topics::planner_state(cell.name)),
        journal_(participant_, dds::topics::planner_journal(cell.name)) {
    wait_.attach(state_.reader);
    wait_.attach(journal_.reader);
    if (!cell.loaded) return;
    for (const auto& robot : cell.loaded->cell.robots) follow(robot.name);
  }

  ExitCode run(Interrupts& interrupts) {
    using Clock = std::chrono::steady_clock;
    constexpr std::chrono::milliseconds kFlush{500};  // what is older is safe from a kill
    constexpr std::chrono::seconds kTell{2};
    const Interrupts::Scope scope{interrupts, [&] { wait_.wake(); }};
    const auto end = a_.duration > 0 ? after_seconds(a_.duration) : after_seconds(10.0 * 365 * 86400);
    auto next_flush = Clock::now() + kFlush;
    auto next_line = Clock::now() + kTell;
    while (!interrupts.requested() && Clock::now() < end) {
      (void)wait_.until(std::min(next_flush, end));
      take_all();
      if (Clock::now() < next_flush) continue;
      next_flush = Clock::now() + kFlush;
      if (!out_.flush()) return failed();
      if (Clock::now() >= next_line && isatty(STDERR_FILENO) != 0) {
        fmt::print(stderr, "\r{} messages, {:.1f} MB ", out_.messages(), 1e-6 * static_cast<double>(out_.size()));
        next_line = Clock::now() + kTell;
      }
    }
    take_all();
    if (!out_.close()) return failed();
    return finish();
  }

 private:
  void follow(const model::RobotName& robot) {
    auto& tracks = robots_[robot];
    if (tracks) return;
    tracks = std::make_unique<RobotTracks>(participant_, cell_.name, robot);
    wait_.attach(tracks->command.reader);
    wait_.attach(tracks->status.reader);
    wait_.attach(tracks->dispatch.reader);
    wait_.attach(tracks->execution.reader);
    wait_.attach(tracks->posture.reader);
  }

  void take_all() {
    journal_.take(clock_, out_, [&](const model::PlannerJournal& j) {
      if (j.first == 0) from_start_ = true;
    });
    std::vector<model::RobotName> heard;
    state_.take(clock_, out_, [&](const model::PlannerState& s) {
      if (cell_.loaded && s.fingerprint != cell_.loaded->fingerprint && !strange_) {
        strange_ = true;
        fmt::print(stderr, "the planner works with another cell file than {}\n", a_.cell);
      }
      for (const auto& robot : s.robots) heard.push_back(robot.name);
    });
    for (const auto& robot : heard) follow(robot);
    for (auto& [name, tracks] : robots_) {
      tracks->command.take(clock_, out_);
      tracks->status.take(clock_, out_);
      tracks->dispatch.take(clock_, out_);
      tracks->execution.take(clock_, out_);
      tracks->posture.take(clock_, out_);
    }
  }

  [[nodiscard]] std::uint64_t refused() const {
    std::uint64_t count = state_.reader.counters().refused + journal_.reader.counters().refused;
    for (const auto& [name, t] : robots_) {
      count += t->command.reader.counters().refused + t->status.reader.counters().refused + t->dispatch.reader.counters().refused +
               t->execution.reader.counters().refused + t->posture.reader.counters().refused;
    }
    return count;
  }

  [[nodiscard]] ExitCode failed() const {
    fmt::print(stderr, "{}\nwhat came before can be read\n", out_.error());
    return ExitCode::fault;
  }

  [[nodiscard]] ExitCode finish() const {
    fmt::print("{}: {} messages, {:.1f} MB{}\n", a_.file, out_.messages(), 1e-6 * static_cast<double>(out_.size()),
               refused() > 0 ? fmt::format(", {} refused that break the wire contract", refused()) : "");
    if (out_.messages() == 0) {
      fmt::print(stderr, "nothing of cell {} was heard on domain {}\n", cell_.name, a_.domain);
      return ExitCode::unavailable;
    }
    if (!from_start_)
      fmt::print(stderr,
                 "the planner had run too long to be replayed from its first decision: start the recorder before it, or just after\n");
    return ExitCode::ok;
  }

  const RecordArguments& a_;
  const RecordedCell& cell_;
  recording::RecordingWriter& out_;
  RecordClock clock_;
  dds::Participant participant_;
  Track<model::PlannerState> state_;
  Track<model::PlannerJournal> journal_;
  std::map<model::RobotName, std::unique_ptr<RobotTracks>> robots_;
  bool from_start_ = false, strange_ = false;
  dds::Wait wait_;  // last: goes before the readers it waits for
};

std::string whole_file(const std::string& path) {
  std::ifstream in{path, std::ios::binary};
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

/// By the cell's file, or by its name alone. Empty: the reason has been printed.
std::optional<RecordedCell> find_cell(const std::string& cell) {
  std::error_code ignored;
  const bool is_file = cell.find('/') != std::string::npos || std::filesystem::is_regular_file(cell, ignored);
  if (!is_file) {
    if (model::is_valid_name(cell)) return RecordedCell{cell, std::nullopt, std::nullopt};
    fmt::print(stderr, "--cell: found \"{}\", expected a cell file or the name of a running cell\n", cell);
    return std::nullopt;
  }
  auto loaded = app::load_cell(cell);
  if (!loaded) {
    fmt::print(stderr, "{}\n", to_string(loaded.error()));
    return std::nullopt;
  }
  RecordedCell found{loaded->cell.name, whole_file(cell), std::nullopt};
  found.loaded = std::move(*loaded);
  return found;
}

ExitCode execute_record(const RecordArguments& a, Interrupts& interrupts) {
  const auto cell = find_cell(a.cell);
  if (!cell) return ExitCode::bad_input;
  auto out = recording::RecordingWriter::create(a.file, a.overwrite);
  if (!out) {
    fmt::print(stderr, "{}\n", out.error());
    return ExitCode::bad_input;
  }
  mcap::Text about{{"cell", cell->name}, {"domain", std::to_string(a.domain)}, {"time", "wall"}};
  if (cell->loaded) about["fingerprint"] = fmt::format("{:016x}", cell->loaded->fingerprint);
  (*out)->describe(about);
  if (cell->text) (*out)->attach_cell(*cell->text, RecordClock{}.now());
  Recorder recorder{a, *cell, **out};
  if (!(*out)->flush()) {
    fmt::print(stderr, "{}\n", (*out)->error());
    return ExitCode::fault;
  }
  std::cout << fmt::format("recording cell {} on domain {} to {}; Ctrl-C ends it\n", cell->name, a.domain, a.file) << std::flush;
  return recorder.run(interrupts);
}

}  // namespace

Command record(CLI::App& parent) {
  auto a = std::make_shared<RecordArguments>();
  auto* command = parent.add_subcommand("record", "everything a cell says, to an MCAP file");
  command->add_option("FILE", a->file, "file to write, as run.mcap")->required();
  command
      ->add_option("--cell", a->cell,
                   "cell file, which goes into the recording as well; or the name of a running cell, then replays need its file")
      ->required();
  app::add_domain(*command, a->domain);
  command->add_option("--duration", a->duration, "end after this many seconds; default: at Ctrl-C or SIGTERM")->check(CLI::Range(0.0, 1e7));
  command->add_flag("--overwrite", a->overwrite, "write over a file that is there");
  command->footer(
      "Start it before the planner, or within ten seconds after: then `interlace replay FILE` can make every decision again. It waits for\n"
      "the planner as long as it takes. When it is killed, all but the last second can still be read.\n"
      "Ends with 0; 2 when FILE is there already; 4 when nothing was heard; 5 when the disk is full.\n"
      "Opens in Foxglove, PlotJuggler and everything else that reads MCAP with ROS 2 messages.\n"
      "Example:\n  interlace record run.mcap --cell deploy/cells/exp-4-2/cell.yaml");
  return {command, [a](Interrupts& interrupts) { return execute_record(*a, interrupts); }};
}

}  // namespace interlace::client::commands
