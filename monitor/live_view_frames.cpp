#include <nlohmann/json.hpp>
#include <utility>

#include "common/app/evidence.hpp"
#include "monitor/live_view.hpp"
#include "monitor/numbers.hpp"
#include "monitor/waiting.hpp"

/// The frames of LiveView (docs/monitor.md).
namespace interlace::monitor {

namespace {

Frame frame(FrameKind kind, const char* type, double t, nlohmann::json content) {
  content["type"] = type;
  content["t"] = seconds(t);
  return {kind, std::make_shared<const std::string>(content.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace))};
}

nlohmann::json with_type(const char* type, nlohmann::json content) {
  content["type"] = type;
  return content;
}

nlohmann::json names_json(const std::vector<model::ToolName>& names) {
  nlohmann::json json = nlohmann::json::array();
  for (const auto& name : names) json.push_back(name.str());
  return json;
}

}  // namespace

void LiveView::add_event(const char* type, nlohmann::json content) {
  events_.push_back(frame(FrameKind::event, type, now_, std::move(content)));
}

std::vector<Frame> LiveView::take_events() {
  return std::exchange(events_, {});
}

nlohmann::json LiveView::pose_json() const {
  nlohmann::json robots = nlohmann::json::array(), pairs = nlohmann::json::array();
  for (model::RobotIndex i = 0; i < placed_.size(); ++i) {
    if (!placed_[i].known()) {
      robots.push_back(nullptr);
      continue;
    }
    nlohmann::json clearance = nlohmann::json::array();
    for (const double d : near_.capsules[i]) clearance.push_back(rounded(std::min(d, kFar), 3));
    const model::Vector3 tcp = seen_[i].posture->X_WT.translation();
    robots.push_back({{"ends", ends_json(placed_[i].bodies)},
                      {"clearance", std::move(clearance)},
                      {"tcp", metres(tcp)},
                      {"moving", seen_[i].posture->moving},
                      {"silent", !heard_lately(seen_[i])}});
  }
  for (const auto& d : near_.pairs) pairs.push_back(d ? metres(*d) : nlohmann::json(nullptr));
  return {{"robots", std::move(robots)}, {"pairs", std::move(pairs)}};
}

Frame LiveView::pose() const {
  return frame(FrameKind::pose, "pose", now_, pose_json());
}

nlohmann::json LiveView::waiting_json(const model::RobotName& robot) const {
  const CommandRecord* record = commands_.held_up(robot, now_);
  const auto zero = record != nullptr ? line_.zero_of(record->planner) : std::nullopt;
  if (!zero) return nullptr;
  return {{"command", record->status.id.str()},
          {"reason", model::to_string(record->status.reason)},
          {"sentence", waiting_sentence(*record, *zero, now_)},
          {"start", seconds(record->start)},
          {"conflicts", to_json(record->status.conflicts, *zero)},
          {"refusals", app::to_json(record->status.refusals)}};
}

nlohmann::json LiveView::state_json() const {
  nlohmann::json robots = nlohmann::json::array(), least = nlohmann::json::array();
  for (model::RobotIndex i = 0; i < seen_.size(); ++i) {
    const model::RobotName& name = cell_.cell.robots[i].name;
    nlohmann::json robot{{"name", name.str()},
                         {"heard", heard_lately(seen_[i])},
                         {"ready", seen_[i].posture && seen_[i].posture->ready},
                         {"moving", seen_[i].posture && seen_[i].posture->moving},
                         {"motion", seen_[i].posture ? app::name_or_null(seen_[i].posture->motion.str()) : nlohmann::json(nullptr)},
                         {"holds", seen_[i].posture ? names_json(seen_[i].posture->holds) : nlohmann::json::array()},
                         {"mode", nullptr},
                         {"queued", nullptr},
                         {"current", nullptr},
                         {"waiting", waiting_json(name)}};
    if (planner_ && i < planner_->robots.size()) {
      const model::RobotStatus& status = planner_->robots[i];
      robot["mode"] = model::to_string(status.mode);
      robot["queued"] = status.queued;
      robot["current"] = app::name_or_null(status.current.str());
    }
    robots.push_back(std::move(robot));
  }
  for (const PairClearance& pair : observer_.pairs()) {
    if (pair.link_a.empty()) continue;
    least.push_back({{"robots", {cell_.cell.robots[pair.a].name.str(), cell_.cell.robots[pair.b].name.str()}},
                     {"links", {pair.link_a, pair.link_b}},
                     {"clearance_m", metres(pair.least)},
                     {"at", seconds(pair.at)}});
  }
  nlohmann::json planner{{"heard", planner_heard_lately()}, {"strategy", nullptr}};
  if (planner_) {
    planner["strategy"] = planner_->strategy;
    planner["accepted"] = planner_->accepted;
    planner["completed"] = planner_->completed;
    planner["rejected"] = planner_->rejected;
    planner["refused_samples"] = planner_->refused_samples;
  }
  return {{"planner", std::move(planner)},
          {"robots", std::move(robots)},
          {"least", std::move(least)},
          {"contacts", observer_.contacts()},
          {"observed_s", seconds(observer_.observed())}};
}

nlohmann::json LiveView::curves_json() const {
  nlohmann::json t = nlohmann::json::array(), pairs = nlohmann::json::array();
  for (std::size_t k = 0; k < pairs_.size(); ++k) pairs.push_back(nlohmann::json::array());
  for (const CurvePoint& point : curve_) {
    t.push_back(seconds(point.t));
    for (std::size_t k = 0; k < pairs_.size(); ++k) pairs[k].push_back(point.pairs[k] ? metres(*point.pairs[k]) : nlohmann::json(nullptr));
  }
  return {{"times", std::move(t)}, {"pairs", std::move(pairs)}};
}

Frame LiveView::snapshot() const {
  nlohmann::json frames = nlohmann::json::array();
  nlohmann::json scene = with_type("cell", scene_json(cell_.cell, pairs_));
  scene["version"] = kFrameVersion;
  scene["source"] = recorded_ ? "recording" : "live";
  if (recorded_) scene["range"] = {0.0, seconds(*recorded_)};
  scene["pose_period"] = std::chrono::duration<double>(kPosePeriod).count();
  frames.push_back(std::move(scene));
  for (model::RobotIndex i = 0; i < placed_.size(); ++i) {
    if (!placed_[i].known()) continue;
    nlohmann::json bodies = with_type("bodies", bodies_json(*placed_[i].robot));
    bodies["robot"] = cell_.cell.robots[i].name.str();
    frames.push_back(std::move(bodies));
  }
  for (const CommandRecord* record : commands_.all()) frames.push_back(with_type("command", to_json(*record)));
  for (const KnownMotion* motion : motions_.coming(now_)) frames.push_back(with_type("motion", to_json(*motion)));
  frames.push_back(with_type("alarms", {{"alarms", to_json(alarms_.all())}}));
  frames.push_back(with_type("curves", curves_json()));
  frames.push_back(with_type("state", state_json()));
  frames.push_back(with_type("pose", pose_json()));
  for (nlohmann::json& each : frames) each["t"] = seconds(now_);
  return frame(FrameKind::snapshot, "snapshot", now_, {{"frames", std::move(frames)}});
}

}  // namespace interlace::monitor
