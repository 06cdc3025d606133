#include "app_client/output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>

#include "common/app/evidence.hpp"

namespace interlace::client {

namespace {

nlohmann::json seconds_or_null(const std::optional<model::Instant>& t) {
  return t ? nlohmann::json(model::to_seconds(*t)) : nlohmann::json(nullptr);
}

/// A line for each way that was tried in vain.
std::string lines_of(const std::vector<model::EscapeRefusal>& refusals, const std::string& indent) {
  std::string text;
  for (const auto& r : refusals) text += fmt::format("\n{}{}", indent, app::describe(r));
  return text;
}

/// "free in 1.2 s", "no end known" or nothing: when the last of what a command waits for has passed.
std::string until_text(const model::RobotStatus& robot, model::Instant now) {
  if (robot.conflicts.empty()) return {};
  model::Instant until = model::kEarliest;
  for (const auto& c : robot.conflicts) until = std::max(until, c.until);
  if (until == model::kForever) return "no end known";
  return until > now ? fmt::format("free in {:.2f} s", model::to_seconds(until - now)) : "free now";
}

}  // namespace

std::string describe(const model::CommandStatus& status) {
  using model::CommandState;
  std::string text = model::to_string(status.state);
  // Why it was late was said when its start was decided.
  if (status.verdict != model::DeadlineVerdict::none && status.verdict != model::DeadlineVerdict::open) {
    text += fmt::format(" (deadline: {})", model::to_string(status.verdict));
  }
  const bool under_way = status.state == CommandState::started || status.state == CommandState::completed;
  if (under_way && (status.reason == model::Reason::delayed || status.reason == model::Reason::escape)) return text;
  if (status.reason != model::Reason::none) text += fmt::format(": {}", model::to_string(status.reason));
  if (!status.text.empty()) text += fmt::format(": {}", status.text);
  return text + lines_of(status.refusals, "    ");
}

std::string describe_escape(const model::CommandStatus& status) {
  return fmt::format("escape {} for {}  {}", status.id.str(), status.serves.str(), describe(status));
}

std::string describe(const model::RobotStatus& robot, model::Instant now, std::size_t width) {
  std::string line = fmt::format("{:<{}}  {:<9}  {:>6}", robot.name.str(), width, model::to_string(robot.mode), robot.queued);
  if (!robot.current.empty()) line += "  " + robot.current.str();
  if (!robot.serves.empty()) line += fmt::format(" (escape for {})", robot.serves.str());
  if (robot.held) line += "  HELD";
  for (const auto& tool : robot.holds) line += fmt::format("{}{}", &tool == &robot.holds.front() ? "  holds " : ", ", tool.str());
  const bool waits = robot.mode != model::RobotMode::moving || robot.reason == model::Reason::escape;  // why an escape moves is news
  if (!waits || robot.reason == model::Reason::none) return line;
  const std::string until = until_text(robot, now);
  line += fmt::format("\n{:<{}}  {}: {}{}", "", width, model::to_string(robot.reason),
                      robot.text.empty() ? "no further explanation" : robot.text, until.empty() ? "" : " (" + until + ")");
  const std::string indent(width + 4, ' ');
  for (const auto& c : robot.conflicts) line += fmt::format("\n{}{}", indent, app::describe(c, now));
  return line + lines_of(robot.refusals, indent);
}

std::string describe(const model::PlannerState& state, bool alive) {
  std::string text = fmt::format("cell {}: planner {}, strategy {}, up {:.1f} s, incarnation {:016x}\n", state.cell,
                                 alive ? "alive" : "SILENT", state.strategy, model::to_seconds(state.at), state.incarnation);
  text += fmt::format("commands: {} accepted, {} completed, {} rejected; {} samples refused\n", state.accepted, state.completed,
                      state.rejected, state.refused_samples);
  std::size_t width = 5;
  for (const auto& robot : state.robots) width = std::max(width, robot.name.str().size());
  text += fmt::format("{:<{}}  {:<9}  {:>6}  {}\n", "robot", width, "mode", "queued", "command");
  for (const auto& robot : state.robots) text += describe(robot, state.at, width) + '\n';
  return text;
}

nlohmann::json to_json(const Answer& answer) {
  const auto& s = answer.status;
  return {{"id", s.id.str()},
          {"robot", s.robot.str()},
          {"origin", s.escape ? "escape" : "client"},
          {"serves", app::name_or_null(s.serves.str())},
          {"state", model::to_string(s.state)},
          {"reason", model::to_string(s.reason)},
          {"explanation", s.text},
          {"told_by_planner", answer.told},
          {"submitted_s", model::to_seconds(s.submitted)},
          {"start_s", seconds_or_null(s.start)},
          {"end_s", seconds_or_null(s.end)},
          {"delay_s", s.delay},
          {"deadline_s", seconds_or_null(s.deadline)},
          {"deadline_verdict", model::to_string(s.verdict)},
          {"conflicts", app::to_json(s.conflicts)},
          {"refusals", app::to_json(s.refusals)}};
}

nlohmann::json to_json(const model::RobotStatus& r) {
  nlohmann::json holds = nlohmann::json::array();
  for (const auto& tool : r.holds) holds.push_back(tool.str());
  return {{"name", r.name.str()},
          {"mode", model::to_string(r.mode)},
          {"queued", r.queued},
          {"command", app::name_or_null(r.current.str())},
          {"serves", app::name_or_null(r.serves.str())},
          {"holds", std::move(holds)},
          {"held", r.held},
          {"reason", model::to_string(r.reason)},
          {"explanation", r.text},
          {"conflicts", app::to_json(r.conflicts)},
          {"refusals", app::to_json(r.refusals)}};
}

nlohmann::json to_json(const model::PlannerState& state, bool alive) {
  nlohmann::json robots = nlohmann::json::array();
  for (const auto& r : state.robots) robots.push_back(to_json(r));
  return {{"cell", state.cell},
          {"alive", alive},
          {"incarnation", fmt::format("{:016x}", state.incarnation)},  // 64 bits do not fit into a JSON number
          {"fingerprint", fmt::format("{:016x}", state.fingerprint)},
          {"strategy", state.strategy},
          {"at_s", model::to_seconds(state.at)},
          {"accepted", state.accepted},
          {"rejected", state.rejected},
          {"completed", state.completed},
          {"refused_samples", state.refused_samples},
          {"robots", std::move(robots)}};
}

}  // namespace interlace::client
