#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "planner/core/journal.hpp"
#include "recording/recording_writer.hpp"
#include "simulator/recording.hpp"

namespace interlace::recording {
namespace {

constexpr std::uint64_t kVirtual = 1;  // the incarnation of everything in virtual time

std::uint64_t nanoseconds_of(model::Instant t) {
  return static_cast<std::uint64_t>(t.time_since_epoch().count());
}

/// Writes what goes on in virtual time to a recording like one of a running cell: postures 100 times a second, commands, statuses,
/// dispatches, executions, the planner's state and its journal. Times are virtual ones, from 0 on.
class SimRecorder : public sim::Recording {
 public:
  SimRecorder(std::unique_ptr<RecordingWriter> out, const app::LoadedCell& cell)
      : out_(std::move(out)), cell_(cell.cell.name), fingerprint_(cell.fingerprint) {
    for (const model::Robot& robot : cell.cell.robots) robots_.push_back(robot.name);
  }

  void listen(sim::VirtualOptions& options) override;
  [[nodiscard]] std::optional<std::string> close() override;

 private:
  template <typename Message>
  void write(const dds::Topic<Message>& topic, model::Instant at, const Message& message) {
    last_ = std::max(last_, at);
    out_->write(topic, nanoseconds_of(at), nanoseconds_of(at), dds::encode(message));
  }
  void write_heartbeats(model::Instant now);
  void write_journal(model::Instant now);
  void write_call(model::Instant now, const model::PlannerEvent& event, const core::Decisions& decisions);

  std::unique_ptr<RecordingWriter> out_;
  std::string cell_;
  std::uint64_t fingerprint_;
  std::vector<model::RobotName> robots_;
  std::optional<core::JournalKeeper> journal_;
  model::Instant last_{};
};

void SimRecorder::listen(sim::VirtualOptions& options) {
  options.on_begin = [this](const core::PlannerOptions& o) {
    model::PlannerJournal head;
    head.cell = cell_;
    head.fingerprint = fingerprint_;
    head.incarnation = kVirtual;
    head.settings = core::settings_of(o);
    journal_.emplace(head);
    write_heartbeats({});
  };
  options.on_call = [this](model::Instant now, const model::PlannerEvent& event, const core::Decisions& d) { write_call(now, event, d); };
  options.on_row = [this](const model::PostureReported& p) {
    dds::PostureMessage m;
    m.fingerprint = fingerprint_;
    m.proxy_incarnation = m.planner_incarnation = kVirtual;
    m.proxy_sent = p.at.time_since_epoch();
    m.posture = p;
    write(dds::topics::posture(cell_, p.robot), p.at, m);
  };
  options.on_state = [this](const model::PlannerState& s) {
    model::PlannerState state = s;
    state.fingerprint = fingerprint_;
    state.incarnation = kVirtual;
    write(dds::topics::planner_state(cell_), s.at, state);
    write_heartbeats(s.at);
    write_journal(s.at);
  };
}

void SimRecorder::write_call(model::Instant now, const model::PlannerEvent& event, const core::Decisions& decisions) {
  if (const auto* request = std::get_if<model::ClientRequest>(&event)) {
    const model::RobotName robot = std::visit([](const auto& r) { return r.robot; }, *request);
    write(dds::topics::command(cell_, robot), now, dds::CommandMessage{*request, "interlace-sim"});
  }
  if (const auto* report = std::get_if<model::ExecutionReported>(&event))
    write(dds::topics::execution(cell_, report->robot), now, dds::ExecutionMessage{kVirtual, kVirtual, *report});
  for (const auto& w : decisions.withdrawals)
    write(dds::topics::dispatch(cell_, w.robot), now, dds::DispatchMessage{kVirtual, fingerprint_, w});
  for (const auto& d : decisions.dispatches)
    write(dds::topics::dispatch(cell_, d.robot), now, dds::DispatchMessage{kVirtual, fingerprint_, d});
  for (const auto& s : decisions.statuses) write(dds::topics::command_status(cell_, s.robot), now, dds::StatusMessage{kVirtual, s});
  journal_->note(now, event, decisions);
  while (journal_->full()) write(dds::topics::planner_journal(cell_), now, journal_->take().value());
}

/// Who reads the recording learns from them what the planner's times mean.
void SimRecorder::write_heartbeats(model::Instant now) {
  for (const model::RobotName& robot : robots_) {
    dds::Heartbeat beat;
    beat.robot = robot;
    beat.planner_received = beat.planner_sent = now;
    write(dds::topics::dispatch(cell_, robot), now, dds::DispatchMessage{kVirtual, fingerprint_, beat});
  }
}

/// All calls so far.
void SimRecorder::write_journal(model::Instant now) {
  while (const auto message = journal_->take()) write(dds::topics::planner_journal(cell_), now, *message);
}

std::optional<std::string> SimRecorder::close() {
  if (journal_) write_journal(last_);
  if (out_->close()) return std::nullopt;
  return out_->error();
}

}  // namespace
}  // namespace interlace::recording

namespace interlace::sim {

model::Result<std::unique_ptr<Recording>, std::string> start_recording(const std::string& path, const app::LoadedCell& cell,
                                                                       const std::string& text) {
  auto out = recording::RecordingWriter::create(path, true);
  if (!out) return model::unexpected{out.error()};
  (*out)->describe({{"cell", cell.cell.name}, {"fingerprint", fmt::format("{:016x}", cell.fingerprint)}, {"time", "virtual"}});
  (*out)->attach_cell(text, 0);
  return std::make_unique<recording::SimRecorder>(std::move(*out), cell);
}

}  // namespace interlace::sim
