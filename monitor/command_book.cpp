#include "monitor/command_book.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "common/app/evidence.hpp"
#include "monitor/numbers.hpp"

namespace interlace::monitor {

void CommandBook::on_request(const model::CommandSubmitted& command) {
  if (requests_.insert_or_assign(command.id, command.motion).second) request_order_.push_back(command.id);
  while (request_order_.size() > kRequests) {
    requests_.erase(request_order_.front());
    request_order_.pop_front();
  }
}

const CommandRecord* CommandBook::on_status(std::uint64_t planner, const model::CommandStatus& status, double now) {
  const auto zero = line_.zero_of(planner);
  if (!zero) return nullptr;
  const auto [found, fresh] = records_.try_emplace(status.id);
  CommandRecord& record = found->second;
  const bool was_final = !fresh && model::is_final(record.status.state);
  if (was_final && record.planner == planner) return &record;  // an answer given again
  if (fresh) {
    order_.push_back(status.id);
    record.number = ++heard_[{status.robot, status.escape}];
  }
  record.planner = planner;
  record.status = status;
  record.submitted = *zero + model::to_seconds(status.submitted);
  const auto placed = [&](const std::optional<model::Instant>& t) {
    return t ? std::optional{*zero + model::to_seconds(*t)} : std::nullopt;
  };
  record.start = placed(status.start);
  record.end = placed(status.end);
  switch (status.state) {
    case model::CommandState::queued:
      record.waiting_since.reset();
      record.window.reset();
      break;
    case model::CommandState::waiting:
      if (!record.waiting_since) record.waiting_since = now;
      record.window.reset();  // whatever was promised is taken back
      break;
    default: break;
  }
  if (model::is_final(status.state) && !was_final) {
    finished_.push_back(status.id);
  }
  forget();
  return find(status.id);
}

const CommandRecord* CommandBook::on_window(const model::CommandId& id, double earliest, double latest) {
  const auto found = records_.find(id);
  if (found == records_.end()) return nullptr;
  found->second.window.emplace(earliest, latest);
  return &found->second;
}

std::vector<const CommandRecord*> CommandBook::on_planner(std::uint64_t planner, double now) {
  std::vector<const CommandRecord*> changed;
  for (auto& [id, record] : records_) {
    if (record.planner == planner || model::is_final(record.status.state)) continue;
    record.status.state = model::CommandState::failed;
    record.status.text = "the planner that knew it is gone";
    record.status.conflicts.clear();
    record.end = now;
    finished_.push_back(id);
    changed.push_back(&record);
  }
  return changed;
}

void CommandBook::forget() {
  const auto erase = [&](const model::CommandId& id) {
    records_.erase(id);
    order_.erase(std::find(order_.begin(), order_.end(), id));
  };
  while (finished_.size() > kFinished) {
    const model::CommandId id = finished_.front();
    finished_.pop_front();
    if (const auto found = records_.find(id); found != records_.end() && model::is_final(found->second.status.state)) erase(id);
  }
  while (order_.size() > kOpen + kFinished) {
    records_.erase(order_.front());
    order_.pop_front();
  }
}

const CommandRecord* CommandBook::find(const model::CommandId& id) const {
  const auto found = records_.find(id);
  return found == records_.end() ? nullptr : &found->second;
}

const model::MotionRequest* CommandBook::request(const model::CommandId& id) const {
  const auto found = requests_.find(id);
  return found == requests_.end() ? nullptr : &found->second;
}

const CommandRecord* CommandBook::held_up(const model::RobotName& robot, double now) const {
  constexpr double kAtOnce = 0.005;  // [s]: less is shown as nothing
  const CommandRecord* held = nullptr;
  for (const auto& [id, record] : records_) {
    const auto& s = record.status;
    if (s.robot != robot) continue;
    if (s.state == model::CommandState::waiting) return &record;
    if (s.state == model::CommandState::scheduled && s.delay >= kAtOnce && record.start && *record.start > now) held = &record;
  }
  return held;
}

std::vector<const CommandRecord*> CommandBook::all() const {
  std::vector<const CommandRecord*> records;
  for (const auto& id : order_) records.push_back(&records_.at(id));
  return records;
}

nlohmann::json to_json(const std::vector<model::Conflict>& conflicts, double zero) {
  nlohmann::json json = nlohmann::json::array();
  for (const model::Conflict& c : conflicts) {
    const bool open_ended = c.until == model::kForever;
    json.push_back({{"blocker", c.blocker.str()},
                    {"link", app::name_or_null(c.own_link)},
                    {"blocker_link", app::name_or_null(c.blocker_link)},
                    {"clearance_m", metres(c.clearance)},
                    {"place_m", metres(c.place)},
                    {"until", open_ended ? nlohmann::json(nullptr) : seconds(zero + model::to_seconds(c.until))}});
  }
  return json;
}

nlohmann::json to_json(const CommandRecord& record) {
  const model::CommandStatus& s = record.status;
  nlohmann::json json{{"id", s.id.str()},
                      {"robot", s.robot.str()},
                      {"number", record.number},
                      {"escape", s.escape},
                      {"serves", app::name_or_null(s.serves.str())},
                      {"state", model::to_string(s.state)},
                      {"reason", model::to_string(s.reason)},
                      {"text", s.text},
                      {"submitted", seconds(record.submitted)},
                      {"waiting_since", seconds(record.waiting_since)},
                      {"start", seconds(record.start)},
                      {"end", seconds(record.end)},
                      {"delay", seconds(s.delay)},
                      {"window", nullptr}};
  if (record.window) json["window"] = {seconds(record.window->first), seconds(record.window->second)};
  return json;
}

}  // namespace interlace::monitor
