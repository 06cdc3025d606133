#include "app_client/clearance_watch.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace interlace::client {

namespace {

constexpr double kStep = 0.001;    // [s]; a TCP at 2 m/s moves 2 mm in it
constexpr double kPatience = 0.5;  // silence after which a robot is no longer known [s]

nlohmann::json to_json(const monitor::PairClearance& pair, const model::Cell& cell) {
  return {{"robots", {cell.robots[pair.a].name.str(), cell.robots[pair.b].name.str()}},
          {"links", {pair.link_a, pair.link_b}},
          {"min_clearance_m", pair.least},
          {"at_s", pair.at},
          {"below_zero_s", pair.below_zero},
          {"contacts", pair.contacts}};
}

nlohmann::json to_json(const monitor::FixtureClearance& pair, const model::Cell& cell) {
  return {{"robot", cell.robots[pair.robot].name.str()},
          {"link", pair.link},
          {"fixture", cell.fixtures[pair.fixture].name},
          {"min_clearance_m", pair.least},
          {"at_s", pair.at},
          {"below_zero_s", pair.below_zero},
          {"contacts", pair.contacts}};
}

}  // namespace

ClearanceWatch::ClearanceWatch(const app::LoadedCell& cell, monitor::Timeline::LocalTime origin)
    : cell_(cell), timeline_(origin), observer_(cell.cell, kStep, kPatience) {}

void ClearanceWatch::on_posture(const dds::PostureMessage& message, monitor::Timeline::LocalTime received) {
  const auto robot = cell_.cell.find(message.posture.robot);
  if (!robot || message.fingerprint != cell_.fingerprint) {
    ++strangers_;
    return;
  }
  observer_.on_posture(*robot, timeline_.place(message.planner_incarnation, message.posture.at, received), message.posture.joints,
                       cell_.cell.set_of(message.posture.holds));
}

bool ClearanceWatch::saw_collision() const {
  const auto least = observer_.least_clearance();
  return least && *least <= 0;
}

nlohmann::json ClearanceWatch::to_json() const {
  nlohmann::json json{{"cell", cell_.cell.name},          {"observed_s", observer_.observed()},
                      {"min_clearance_m", nullptr},       {"below_zero_s", observer_.below_zero()},
                      {"contacts", observer_.contacts()}, {"least", nullptr},
                      {"pairs", nlohmann::json::array()}, {"fixtures", nlohmann::json::array()}};
  if (const auto least = observer_.least_clearance()) json["min_clearance_m"] = *least;
  for (const auto& pair : observer_.fixtures().pairs()) {
    if (!pair.link.empty()) json["fixtures"].push_back(client::to_json(pair, cell_.cell));
  }
  const auto least = observer_.least();
  if (!least) return json;
  json["least"] = client::to_json(*least, cell_.cell);
  for (const auto& pair : observer_.pairs()) {
    if (!pair.link_a.empty()) json["pairs"].push_back(client::to_json(pair, cell_.cell));
  }
  return json;
}

std::string ClearanceWatch::summary() const {
  std::string text;
  if (strangers_ > 0) {
    text += fmt::format("{} postures left out: they come from proxies that work with another cell description\n", strangers_);
  }
  const auto least = observer_.least();
  const auto* fixture = observer_.fixtures().least();
  const auto& robots = cell_.cell.robots;
  if (!saw_anything()) return text + fmt::format("{}: no two robots were seen at the same time\n", cell_.cell.name);
  if (least) {
    text += fmt::format("least clearance {:.1f} mm, {}'s {} to {}'s {}, {:.2f} s after the start of the watch; {:.1f} s watched\n",
                        1e3 * least->least, robots[least->a].name.str(), least->link_a, robots[least->b].name.str(), least->link_b,
                        least->at, observer_.observed());
  }
  if (fixture != nullptr) {
    text += fmt::format("least clearance from a fixture {:.1f} mm, {}'s {} to {}, {:.2f} s after the start of the watch\n",
                        1e3 * fixture->least, robots[fixture->robot].name.str(), fixture->link, cell_.cell.fixtures[fixture->fixture].name,
                        fixture->at);
  }
  if (saw_collision()) {
    text += fmt::format("COLLISION: {} contacts, {:.2f} s below zero\n", observer_.contacts(), observer_.below_zero());
  } else {
    text += "no contact\n";
  }
  return text;
}

}  // namespace interlace::client
