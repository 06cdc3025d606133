#include "monitor/alarm_board.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "monitor/numbers.hpp"

namespace interlace::monitor {

void AlarmBoard::raise(const std::string& key, Alarm alarm) {
  const auto [found, fresh] = holding_.try_emplace(key, alarm);
  if (!fresh && found->second.text == alarm.text) return;
  found->second.text = std::move(alarm.text);
  changed_ = true;
}

void AlarmBoard::end(const std::string& key, double now) {
  const auto found = holding_.find(key);
  if (found == holding_.end()) return;
  found->second.ended = now;
  ended_.push_back(std::move(found->second));
  holding_.erase(found);
  if (ended_.size() > kEnded) ended_.pop_front();
  changed_ = true;
}

void AlarmBoard::note(Alarm alarm) {
  alarm.ended = alarm.since;
  ended_.push_back(std::move(alarm));
  if (ended_.size() > kEnded) ended_.pop_front();
  changed_ = true;
}

bool AlarmBoard::take_changed() {
  return std::exchange(changed_, false);
}

std::vector<Alarm> AlarmBoard::all() const {
  std::vector<Alarm> alarms;
  for (const auto& [key, alarm] : holding_) alarms.push_back(alarm);
  std::stable_sort(alarms.begin(), alarms.end(), [](const Alarm& a, const Alarm& b) { return a.since < b.since; });
  alarms.insert(alarms.end(), ended_.begin(), ended_.end());
  return alarms;
}

nlohmann::json to_json(const std::vector<Alarm>& alarms) {
  nlohmann::json json = nlohmann::json::array();
  for (const Alarm& a : alarms) {
    json.push_back({{"kind", a.kind},
                    {"grave", a.grave},
                    {"robots", a.robots},
                    {"text", a.text},
                    {"since", seconds(a.since)},
                    {"ended", seconds(a.ended)}});
  }
  return json;
}

}  // namespace interlace::monitor
