#pragma once

#include <deque>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace interlace::monitor {

/// Something a person should look at. Times [s] on the observer's line.
struct Alarm {
  std::string kind;  ///< contact, deadlock, proxy_silent, planner_silent, controller_fault, other_cell
  bool grave = true;
  std::vector<std::string> robots;
  std::string text;  ///< one sentence
  double since = 0;
  std::optional<double> ended;
};

/// The alarms that hold now and the latest that are over. Pure. Not thread-safe.
class AlarmBoard {
 public:
  static constexpr std::size_t kEnded = 20;  ///< that are remembered

  /// It holds, and did since `alarm.since` unless it held before; `key` says what must be the same for that.
  void raise(const std::string& key, Alarm alarm);
  /// It does not hold any more, if it did.
  void end(const std::string& key, double now);
  /// It happened and is over.
  void note(Alarm alarm);
  /// raise or end.
  void set(const std::string& key, bool holds, const Alarm& alarm) { holds ? raise(key, alarm) : end(key, alarm.since); }

  [[nodiscard]] bool holds(const std::string& key) const { return holding_.count(key) > 0; }
  [[nodiscard]] bool take_changed();
  [[nodiscard]] std::vector<Alarm> all() const;  ///< those that hold first, each oldest first

 private:
  std::map<std::string, Alarm> holding_;
  std::deque<Alarm> ended_;
  bool changed_ = true;
};

[[nodiscard]] nlohmann::json to_json(const std::vector<Alarm>& alarms);

}  // namespace interlace::monitor
