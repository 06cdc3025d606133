#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "monitor/clearance_observer.hpp"
#include "recording/recorded_cell.hpp"
#include "recording/recording_reader.hpp"
#include "recording/replay.hpp"

namespace interlace::recording {
namespace {

constexpr const char* kHowTo =
    "to replay a run record it from its start: start `interlace record FILE --cell CELL_FILE` first, it waits for the planner";

constexpr double kStep = 0.001;    // between two measurements of the clearance [s]
constexpr double kPatience = 0.5;  // silence after which a robot is left out of it [s]

using Failure = model::unexpected<std::string>;

/// The journal's messages put together.
class Lives {
 public:
  /// A sentence when something is missing.
  std::optional<std::string> add(model::PlannerJournal&& j) {
    if (lives_.empty() || lives_.back().incarnation != j.incarnation) lives_.push_back({j.fingerprint, j.incarnation, j.settings, {}});
    PlannerLife& life = lives_.back();
    if (j.first != life.calls.size()) {
      if (life.calls.empty()) return fmt::format("its journal begins at call {} of the planner; {}", j.first, kHowTo);
      return fmt::format("its journal has a gap, calls {} to {} are missing; record again on a less busy machine", life.calls.size(),
                         j.first - 1);
    }
    std::move(j.calls.begin(), j.calls.end(), std::back_inserter(life.calls));
    return std::nullopt;
  }

  [[nodiscard]] std::vector<PlannerLife>& all() { return lives_; }

 private:
  std::vector<PlannerLife> lives_;
};

/// Time of the first request, the origin of the run's report.
model::Instant first_request(const PlannerLife& life) {
  const auto found = std::find_if(life.calls.begin(), life.calls.end(),
                                  [](const model::PlannerCall& c) { return std::holds_alternative<model::ClientRequest>(c.event); });
  return found == life.calls.end() ? model::Instant{} : found->now;
}

app::RunReport report_of(const model::Cell& cell, const PlannerLife& life, const std::vector<dds::StatusMessage>& statuses,
                         const std::vector<dds::PostureMessage>& postures) {
  const model::Instant origin = first_request(life);
  app::ReportCollector collector{origin};
  const auto note = [&](const model::CommandSubmitted& c, model::Instant at) {
    collector.on_submitted(c.id, c.robot, model::to_seconds(at - origin));
  };
  for (const model::PlannerCall& call : life.calls) {
    const auto* request = std::get_if<model::ClientRequest>(&call.event);
    if (request == nullptr) continue;
    if (const auto* c = std::get_if<model::CommandSubmitted>(request)) note(*c, call.now);
    if (const auto* r = std::get_if<model::QueueReplaced>(request)) {
      for (const auto& c : r->commands) note(c, call.now);
    }
  }
  for (const auto& s : statuses) {
    if (s.planner_incarnation == life.incarnation) collector.on_status(s.status);
  }
  app::RunReport report = collector.finish(life.settings.strategy);
  monitor::ClearanceObserver observer{cell, kStep, kPatience};
  for (const auto& p : postures) {
    const auto robot = cell.find(p.posture.robot);
    if (!robot || p.fingerprint != life.fingerprint || p.planner_incarnation != life.incarnation) continue;
    observer.on_posture(*robot, model::to_seconds(p.posture.at - origin), p.posture.joints, cell.set_of(p.posture.holds));
  }
  report.collisions = observer.contacts();
  report.least_clearance = observer.least_clearance();
  return report;
}

}  // namespace

model::Result<Recorded, std::string> read_recorded(const std::string& path, const std::string& cell_file) {
  auto reader = RecordingReader::open(path);
  if (!reader) return Failure{reader.error()};
  Lives lives;
  std::vector<dds::StatusMessage> statuses;
  std::vector<dds::PostureMessage> postures;
  for (;;) {
    auto next = (*reader)->next();
    if (!next) return Failure{next.error()};
    if (!*next) break;
    RecordedMessage& message = (*next)->message;
    if (auto* journal = std::get_if<model::PlannerJournal>(&message)) {
      if (const auto missing = lives.add(std::move(*journal))) return Failure{path + ": " + *missing};
    } else if (auto* status = std::get_if<dds::StatusMessage>(&message)) {
      statuses.push_back(std::move(*status));
    } else if (auto* posture = std::get_if<dds::PostureMessage>(&message)) {
      postures.push_back(std::move(*posture));
    }
  }
  if (lives.all().empty()) return Failure{fmt::format("{}: holds nothing of a planner's journal; {}", path, kHowTo)};
  auto cell = recorded_cell(**reader, path, cell_file);
  if (!cell) return Failure{cell.error()};
  for (const PlannerLife& life : lives.all()) {
    if (life.fingerprint != cell->fingerprint)
      return Failure{fmt::format("{}: the planner worked with another cell file than the one at hand", path)};
  }
  Recorded recorded{std::move(*cell), std::move(lives.all()), {}, (*reader)->cell_file().has_value(), std::nullopt};
  if ((*reader)->cut_off()) recorded.cut_off = (*reader)->whole();
  recorded.report = report_of(recorded.cell.cell, recorded.lives.front(), statuses, postures);
  return recorded;
}

}  // namespace interlace::recording
