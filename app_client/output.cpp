#include "app_client/output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>

namespace interlace::client {

namespace {

nlohmann::json seconds_or_null(const std::optional<model::Instant>& t) {
  return t ? nlohmann::json(model::to_seconds(*t)) : nlohmann::json(nullptr);
}

nlohmann::json conflicts_json(const std::vector<model::Conflict>& conflicts) {
  nlohmann::json json = nlohmann::json::array();
  for (const auto& c : conflicts) {
    json.push_back({{"blocker", c.blocker.str()},
                    {"link", c.own_link},
                    {"blocker_link", c.blocker_link},
                    {"clearance_m", c.clearance},
                    {"place_m", {c.place.x(), c.place.y(), c.place.z()}},
                    {"until_s", c.until == model::kForever ? nlohmann::json(nullptr) : nlohmann::json(model::to_seconds(c.until))}});
  }
  return json;
}

/// "free in 1.2 s", "no end known" or nothing: when the last of what a command waits for has passed.
std::string until_text(const model::RobotStatus& robot, model::Instant now) {
  if (robot.conflicts.empty()) return {};
  model::Instant until = model::kEarliest;
  for (const auto& c : robot.conflicts) until = std::max(until, c.until);
  if (until == model::kForever) return "no end known";
  return until > now ? fmt::format("free in {:.2f} s", model::to_seconds(until - now)) : "free now";
}

std::string robot_line(const model::RobotStatus& robot, model::Instant now, std::size_t width) {
  std::string line = fmt::format("{:<{}}  {:<9}  {:>6}", robot.name.str(), width, model::to_string(robot.mode), robot.queued);
  if (!robot.current.empty()) line += "  " + robot.current.str();
  if (robot.mode == model::RobotMode::moving || robot.reason == model::Reason::none) return line;
  const std::string until = until_text(robot, now);
  line += fmt::format("\n{:<{}}  {}: {}{}", "", width, model::to_string(robot.reason),
                      robot.text.empty() ? "no further explanation" : robot.text, until.empty() ? "" : " (" + until + ")");
  return line;
}

}  // namespace

std::string describe(const model::CommandStatus& status) {
  using model::CommandState;
  std::string text = model::to_string(status.state);
  // Why it was late was said when its start was decided.
  const bool under_way = status.state == CommandState::started || status.state == CommandState::completed;
  if (under_way && status.reason == model::Reason::delayed) return text;
  if (status.reason != model::Reason::none) text += fmt::format(": {}", model::to_string(status.reason));
  if (!status.text.empty()) text += fmt::format(": {}", status.text);
  return text;
}

std::string describe(const model::PlannerState& state, bool alive) {
  std::string text = fmt::format("cell {}: planner {}, strategy {}, up {:.1f} s, incarnation {:016x}\n", state.cell,
                                 alive ? "alive" : "SILENT", state.strategy, model::to_seconds(state.at), state.incarnation);
  text += fmt::format("commands: {} accepted, {} completed, {} rejected; {} samples refused\n", state.accepted, state.completed,
                      state.rejected, state.refused_samples);
  std::size_t width = 5;
  for (const auto& robot : state.robots) width = std::max(width, robot.name.str().size());
  text += fmt::format("{:<{}}  {:<9}  {:>6}  {}\n", "robot", width, "mode", "queued", "command");
  for (const auto& robot : state.robots) text += robot_line(robot, state.at, width) + '\n';
  return text;
}

nlohmann::json to_json(const Answer& answer) {
  const auto& s = answer.status;
  return {{"id", s.id.str()},
          {"robot", s.robot.str()},
          {"state", model::to_string(s.state)},
          {"reason", model::to_string(s.reason)},
          {"explanation", s.text},
          {"told_by_planner", answer.told},
          {"submitted_s", model::to_seconds(s.submitted)},
          {"start_s", seconds_or_null(s.start)},
          {"end_s", seconds_or_null(s.end)},
          {"delay_s", s.delay},
          {"conflicts", conflicts_json(s.conflicts)}};
}

nlohmann::json to_json(const model::PlannerState& state, bool alive) {
  nlohmann::json robots = nlohmann::json::array();
  for (const auto& r : state.robots) {
    robots.push_back({{"name", r.name.str()},
                      {"mode", model::to_string(r.mode)},
                      {"queued", r.queued},
                      {"command", r.current.empty() ? nlohmann::json(nullptr) : nlohmann::json(r.current.str())},
                      {"reason", model::to_string(r.reason)},
                      {"explanation", r.text},
                      {"conflicts", conflicts_json(r.conflicts)}});
  }
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
