#include "common/app/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>

#include "common/app/evidence.hpp"

namespace interlace::app {

using model::CommandState;

DurationStatistics statistics_of(std::vector<double> seconds) {
  DurationStatistics s;
  s.count = seconds.size();
  if (seconds.empty()) return s;
  std::sort(seconds.begin(), seconds.end());
  const auto quantile = [&](double q) {
    return 1e3 * seconds[static_cast<std::size_t>(std::lround(q * static_cast<double>(seconds.size() - 1)))];
  };
  s.mean = 1e3 * std::accumulate(seconds.begin(), seconds.end(), 0.0) / static_cast<double>(seconds.size());
  s.min = 1e3 * seconds.front();
  s.p50 = quantile(0.5);
  s.p99 = quantile(0.99);
  s.max = 1e3 * seconds.back();
  return s;
}

void ReportCollector::on_submitted(const model::CommandId& id, const model::RobotName& robot, double release) {
  if (!by_id_.emplace(id, rows_.size()).second) return;
  CommandRow row;
  row.id = id;
  row.robot = robot;
  row.release = release;
  rows_.push_back(std::move(row));
  ++open_;
}

namespace {

/// The conflicts with their times from the start of the run instead of the planner's.
std::vector<model::Conflict> since(model::Instant origin, std::vector<model::Conflict> conflicts) {
  for (model::Conflict& c : conflicts) {
    for (model::Instant* t : {&c.from, &c.until}) {
      if (*t != model::kForever && *t != model::kEarliest) *t -= origin.time_since_epoch();
    }
  }
  return conflicts;
}

}  // namespace

void ReportCollector::note_deadlock(const model::CommandStatus& status) {
  if (status.reason != model::Reason::deadlock || model::is_final(status.state)) {
    deadlocked_.erase(status.id);
  } else if (deadlocked_.insert(status.id).second) {
    ++warnings_;
  }
}

void ReportCollector::on_status(const model::CommandStatus& status) {
  auto found = by_id_.find(status.id);
  if (found == by_id_.end()) {
    if (!status.escape) return;
    on_submitted(status.id, status.robot, model::to_seconds(status.submitted - origin_));
    found = by_id_.find(status.id);
    rows_[found->second].escape = true;
    rows_[found->second].serves = status.serves;
  }
  CommandRow& row = rows_[found->second];
  if (model::is_final(row.state)) return;
  row.state = status.state;
  // The reason of a delay outlives it: a command that has started says no more why it waited.
  if (status.reason != model::Reason::none) {
    row.reason = status.reason;
    row.explanation = status.text;
  }
  // Evidence too: what was waited for is of interest after a cancellation, and what a warning said after it was resolved.
  if (!status.conflicts.empty()) row.conflicts = since(origin_, status.conflicts);
  if (!status.refusals.empty()) row.refusals = status.refusals;
  note_deadlock(status);
  if (status.deadline) row.deadline = model::to_seconds(*status.deadline - origin_);
  row.verdict = status.verdict;
  row.delay = std::max(row.delay, status.delay);
  if (status.state >= CommandState::started && status.state != CommandState::rejected && status.state != CommandState::cancelled) {
    if (status.start) row.start = model::to_seconds(*status.start - origin_);
    if (status.end) row.end = model::to_seconds(*status.end - origin_);
  }
  if (model::is_final(status.state)) --open_;
}

RunReport ReportCollector::finish(std::string strategy) const {
  RunReport r;
  r.strategy = std::move(strategy);
  r.commands = rows_;
  r.warnings = warnings_;
  std::optional<double> first, last;
  for (const CommandRow& row : rows_) {
    if (row.escape) {
      ++r.escapes;
    } else {
      ++r.submitted;
      if (row.state == CommandState::completed) ++r.completed;
      if (row.state == CommandState::rejected) ++r.rejected;
      if (row.state == CommandState::cancelled) ++r.cancelled;
      if (!model::is_final(row.state) || row.state == CommandState::failed) ++r.unserved;
    }
    switch (row.verdict) {
      case model::DeadlineVerdict::none: break;
      case model::DeadlineVerdict::open: ++r.deadlines.open; break;
      case model::DeadlineVerdict::met: ++r.deadlines.met; break;
      case model::DeadlineVerdict::late: ++r.deadlines.late; break;
      case model::DeadlineVerdict::impossible: ++r.deadlines.impossible; break;
    }
    if (row.start) first = first ? std::min(*first, *row.start) : *row.start;
    if (row.end && row.state == CommandState::completed) last = last ? std::max(*last, *row.end) : *row.end;
  }
  if (first && last) r.makespan = *last - *first;
  return r;
}

namespace {

nlohmann::json to_json(const std::optional<DurationStatistics>& s) {
  if (!s) return nullptr;
  return {{"count", s->count}, {"mean", s->mean}, {"p50", s->p50}, {"p99", s->p99}, {"max", s->max}};
}

template <typename T>
nlohmann::json or_null(const std::optional<T>& value) {
  return value ? nlohmann::json(*value) : nlohmann::json(nullptr);
}

}  // namespace

nlohmann::json to_json(const RunReport& r) {
  nlohmann::json commands = nlohmann::json::array();
  for (const CommandRow& row : r.commands) {
    commands.push_back({{"id", row.id.str()},
                        {"robot", row.robot.str()},
                        {"origin", row.escape ? "escape" : "client"},
                        {"serves", name_or_null(row.serves.str())},
                        {"state", model::to_string(row.state)},
                        {"release_s", row.release},
                        {"start_s", or_null(row.start)},
                        {"end_s", or_null(row.end)},
                        {"delay_s", row.delay},
                        {"deadline_s", or_null(row.deadline)},
                        {"deadline_verdict", model::to_string(row.verdict)},
                        {"reason", model::to_string(row.reason)},
                        {"explanation", row.explanation},
                        {"conflicts", to_json(row.conflicts)},
                        {"refusals", to_json(row.refusals)}});
  }
  nlohmann::json touched = nlohmann::json::array();
  for (const FixtureContact& c : r.fixture_contacts) {
    touched.push_back({{"robot", c.robot.str()},
                       {"link", c.link},
                       {"fixture", c.fixture},
                       {"contacts", c.count},
                       {"min_clearance_m", c.clearance},
                       {"at_s", c.at}});
  }
  return {{"strategy", r.strategy},
          {"makespan_s", r.makespan},
          {"submitted", r.submitted},
          {"completed", r.completed},
          {"rejected", r.rejected},
          {"cancelled", r.cancelled},
          {"unserved", r.unserved},
          {"escapes", r.escapes},
          {"warnings", r.warnings},
          {"deadlines",
           {{"met", r.deadlines.met}, {"late", r.deadlines.late}, {"impossible", r.deadlines.impossible}, {"open", r.deadlines.open}}},
          {"collisions", or_null(r.collisions)},
          {"fixture_contacts", std::move(touched)},
          {"min_clearance_m", or_null(r.least_clearance)},
          {"map_build_ms", to_json(r.map_build)},
          {"decision_ms", to_json(r.decision)},
          {"commands", std::move(commands)}};
}

namespace {

/// ", deadlines: 3 met, 1 late", or nothing where there were none.
std::string deadlines_text(const DeadlineCounts& d) {
  std::string text;
  for (const auto& [count, what] : {std::pair{d.met, "met"}, {d.late, "late"}, {d.impossible, "impossible"}, {d.open, "open"}}) {
    if (count) text += fmt::format("{}{} {}", text.empty() ? ", deadlines: " : ", ", count, what);
  }
  return text;
}

}  // namespace

std::string summary(const RunReport& r) {
  std::string text = fmt::format("{}: {} of {} commands completed in {:.2f} s", r.strategy, r.completed, r.submitted, r.makespan);
  if (r.rejected) text += fmt::format(", {} rejected", r.rejected);
  if (r.cancelled) text += fmt::format(", {} cancelled", r.cancelled);
  if (r.unserved) text += fmt::format(", {} unserved", r.unserved);
  if (r.escapes) text += fmt::format(", {} escapes", r.escapes);
  if (r.warnings) text += fmt::format(", {} deadlock warnings", r.warnings);
  text += deadlines_text(r.deadlines);
  if (r.collisions && *r.collisions) text += fmt::format(", {} COLLISIONS", *r.collisions);
  if (r.least_clearance) text += fmt::format(", least clearance {:.1f} mm", 1e3 * *r.least_clearance);
  text += '\n';
  for (const FixtureContact& c : r.fixture_contacts) {
    text += fmt::format("  {}'s {} touched fixture {}, {} times, deepest at {:.2f} s\n", c.robot.str(), c.link, c.fixture, c.count, c.at);
  }
  for (const CommandRow& row : r.commands) {
    if (row.state == CommandState::completed) continue;
    text += fmt::format("  {} ({}) {}: {}\n", row.id.str(), row.robot.str(), model::to_string(row.state),
                        row.explanation.empty() ? model::to_string(row.reason) : row.explanation);
    for (const model::EscapeRefusal& refusal : row.refusals) text += fmt::format("    {}\n", describe(refusal));
  }
  return text;
}

}  // namespace interlace::app
