#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "app_client/clearance_watch.hpp"
#include "app_client/commands/command.hpp"
#include "app_client/output.hpp"

namespace interlace::client::commands {

namespace {

using app::ExitCode;

struct WatchArguments {
  CellOptions cell;
  std::vector<std::string> robots;
  bool clearance = false;
  std::string cell_file, report;
  double duration = 0;    // [s]; 0: until a signal
  double until_idle = 0;  // [s]; 0: never
  double rate = 2;        // [1/s] lines per robot
};

constexpr double kDegrees = 180 / model::kPi;

std::string posture_line(const model::PostureReported& p, const model::CommandId& serves, double t) {
  const model::Vector3 at = 1e3 * p.X_WT.translation();
  const model::Joints q = kDegrees * p.joints;
  return fmt::format("{:9.2f} s  {}  TCP ({:.1f}, {:.1f}, {:.1f}) mm  joints ({:.1f}, {:.1f}, {:.1f}, {:.1f}, {:.1f}, {:.1f}) deg  {}{}{}",
                     t, p.robot.str(), at.x(), at.y(), at.z(), q[0], q[1], q[2], q[3], q[4], q[5],
                     p.moving ? "moving " + p.motion.str() : "standing", serves.empty() ? "" : " (escape for " + serves.str() + ")",
                     p.ready ? "" : ", not ready");
}

nlohmann::json posture_json(const model::PostureReported& p, const model::CommandId& serves, double t) {
  const Eigen::Quaterniond q{p.X_WT.linear()};
  const model::Vector3 at = p.X_WT.translation();
  return {{"t", t},
          {"robot", p.robot.str()},
          {"position_m", {at.x(), at.y(), at.z()}},
          {"quaternion_wxyz", {q.w(), q.x(), q.y(), q.z()}},
          {"joints_rad", {p.joints[0], p.joints[1], p.joints[2], p.joints[3], p.joints[4], p.joints[5]}},
          {"moving", p.moving},
          {"ready", p.ready},
          {"motion", p.motion.str()},
          {"serves", serves.empty() ? nlohmann::json(nullptr) : nlohmann::json(serves.str())}};
}

/// What has passed by since the watch began.
class Watch {
 public:
  Watch(const WatchArguments& a, const app::LoadedCell* cell) : a_(a), origin_(LocalTime::clock::now()) {
    if (cell) clearance_.emplace(*cell, origin_);
  }

  void on_posture(const dds::PostureMessage& m, LocalTime received) {
    ++postures_;
    if (clearance_) clearance_->on_posture(m, received);
    if (m.posture.moving) last_moving_ = received;
    if (!clearance_) show(m.posture, received);
  }

  /// Says what robots that are shown wait for, or move out of the way for, whenever that changes.
  void on_planner(const model::PlannerState& state, const std::vector<model::RobotName>& robots) {
    if (clearance_) return;
    for (const model::RobotStatus& r : state.robots) {
      if (std::find(robots.begin(), robots.end(), r.name) == robots.end()) continue;
      model::RobotStatus& known = known_[r.name];
      const bool same = known.current == r.current && known.mode == r.mode && known.reason == r.reason && known.text == r.text;
      known = r;
      if (!same && r.reason != model::Reason::none) show(r, state.at);
    }
  }

  /// When nothing has moved for as long as asked; empty when that is not asked or nothing has moved yet.
  [[nodiscard]] std::optional<LocalTime> idle_at() const {
    if (a_.until_idle <= 0 || !last_moving_) return std::nullopt;
    return *last_moving_ + std::chrono::duration_cast<LocalDuration>(std::chrono::duration<double>{a_.until_idle});
  }

  [[nodiscard]] ExitCode finish() const {
    if (clearance_) return judge();
    if (postures_ > 0) return ExitCode::ok;
    fmt::print(stderr, "no robot of cell {} was heard\n", a_.cell.cell);
    return ExitCode::unavailable;
  }

 private:
  [[nodiscard]] double seconds(LocalTime t) const { return std::chrono::duration<double>(t - origin_).count(); }

  void show(const model::RobotStatus& r, model::Instant at) {
    const double t = seconds(LocalTime::clock::now());
    if (a_.cell.json) {
      nlohmann::json json = to_json(r);
      json["t"] = t;
      json["robot"] = json["name"];
      json.erase("name");
      std::cout << json.dump() << '\n' << std::flush;
    } else {
      std::cout << fmt::format("{:9.2f} s  {}\n", t, describe(r, at, r.name.str().size())) << std::flush;
    }
  }

  /// The command that the robot's motion serves, when it is an escape; empty otherwise, and while no planner is heard.
  [[nodiscard]] model::CommandId serves(const model::PostureReported& p) const {
    const auto found = known_.find(p.robot);
    return found != known_.end() && !p.motion.empty() && found->second.current == p.motion ? found->second.serves : model::CommandId{};
  }

  void show(const model::PostureReported& p, LocalTime received) {
    auto& next = next_line_[p.robot];
    if (received < next) return;
    next = received + std::chrono::duration_cast<LocalDuration>(std::chrono::duration<double>{1 / a_.rate});
    const double t = seconds(received);
    std::cout << (a_.cell.json ? posture_json(p, serves(p), t).dump() : posture_line(p, serves(p), t)) << '\n' << std::flush;
  }

  [[nodiscard]] ExitCode judge() const {
    const std::string json = clearance_->to_json().dump(2);
    std::cout << (a_.cell.json ? json + '\n' : clearance_->summary()) << std::flush;
    if (!a_.report.empty() && !write_file(a_.report, json)) return ExitCode::fault;
    if (clearance_->saw_collision()) return ExitCode::collision;
    if (clearance_->saw_anything()) return ExitCode::ok;
    return clearance_->of_another_cell() > 0 ? ExitCode::bad_input : ExitCode::unavailable;
  }

  const WatchArguments& a_;
  LocalTime origin_;
  std::optional<ClearanceWatch> clearance_;
  std::map<model::RobotName, LocalTime> next_line_;
  std::map<model::RobotName, model::RobotStatus> known_;  // what the planner last said
  std::optional<LocalTime> last_moving_;
  std::size_t postures_ = 0;
};

/// With a cell file all its robots; else those asked for; else those the planner knows.
std::optional<ExitCode> choose_robots(const WatchArguments& a, const app::LoadedCell* cell, Client& client, const Interrupts& interrupts,
                                      std::vector<model::RobotName>& robots) {
  if (a.clearance) {
    for (const auto& robot : cell->cell.robots) robots.push_back(robot.name);
  } else if (!a.robots.empty()) {
    for (const auto& robot : a.robots) robots.emplace_back(robot);
  } else {
    if (const auto code = hear_planner(client, a.cell, interrupts)) return *code;
    for (const auto& robot : client.planner()->robots) robots.push_back(robot.name);
  }
  return std::nullopt;
}

ExitCode observe(const WatchArguments& a, const app::LoadedCell* cell, Interrupts& interrupts) {
  Client client{client_options(a.cell)};
  const Interrupts::Scope scope{interrupts, [&] { client.wake(); }};
  std::vector<model::RobotName> robots;
  if (const auto code = choose_robots(a, cell, client, interrupts, robots)) return *code;
  Watch watch{a, cell};
  client.on_posture([&](const dds::PostureMessage& m, LocalTime received) { watch.on_posture(m, received); });
  for (const auto& robot : robots) client.follow(robot);
  if (!a.clearance) (void)client.hear_planner(LocalTime::clock::now());  // postures are shown without one, too
  const LocalTime end = a.duration > 0 ? after_seconds(a.duration) : after_seconds(10.0 * 365 * 86400);
  const auto over = [&] {
    if (client.planner()) watch.on_planner(*client.planner(), robots);
    return interrupts.requested() || LocalTime::clock::now() >= std::min(end, watch.idle_at().value_or(end));
  };
  while (!client.spin_until(std::min(end, watch.idle_at().value_or(after_seconds(1))), over)) {
  }
  return watch.finish();
}

ExitCode execute(const WatchArguments& a, Interrupts& interrupts) {
  if (a.clearance != !a.cell_file.empty()) {
    fmt::print(stderr, "--clearance and --cell-file belong together: the bodies of the robots stand in the cell file\n");
    return ExitCode::bad_input;
  }
  if (!a.clearance) {
    const auto bad = std::find_if_not(a.robots.begin(), a.robots.end(), model::is_valid_name);
    if (bad != a.robots.end()) {
      fmt::print(stderr, "ROBOT: found \"{}\", expected 1 to 64 letters, digits, '_', '-', '.' or ':'\n", *bad);
      return ExitCode::bad_input;
    }
    return observe(a, nullptr, interrupts);
  }
  const auto cell = app::load_cell(a.cell_file);
  if (!cell) {
    fmt::print(stderr, "{}\n", to_string(cell.error()));
    return ExitCode::bad_input;
  }
  if (cell->cell.name != a.cell.cell) {
    fmt::print(stderr, "--cell: found \"{}\", but {} describes cell {}\n", a.cell.cell, a.cell_file, cell->cell.name);
    return ExitCode::bad_input;
  }
  return observe(a, &*cell, interrupts);
}

}  // namespace

Command watch(CLI::App& parent) {
  auto a = std::make_shared<WatchArguments>();
  auto* command = parent.add_subcommand("watch", "where the robots are, or how near they come to each other");
  add_cell_options(*command, a->cell);
  auto* robots = command->add_option("ROBOT", a->robots, "robots to show; default: all the planner knows");
  auto* clearance = command->add_flag("--clearance", a->clearance,
                                      "measure the distance between all links of all robots from their postures alone, and tell the least "
                                      "at the end");
  clearance->excludes(robots);
  command->add_option("--cell-file", a->cell_file, "cell file, for --clearance");
  command->add_option("--report", a->report, "write what --clearance found to this JSON file")->needs(clearance);
  command->add_option("--duration", a->duration, "end after this many seconds; default: at Ctrl-C or SIGTERM")->check(CLI::Range(0.0, 1e7));
  command->add_option("--until-idle", a->until_idle, "end when nothing has moved for this many seconds, once something has")
      ->check(CLI::Range(0.0, 1e7));
  command->add_option("--rate", a->rate, "lines per second and robot")->check(CLI::Range(0.01, 100.0))->capture_default_str();
  command->footer(
      "Ends with 0; with --clearance 3 when robots touched; 4 when no robot (--clearance: no two robots) was heard.\n"
      "Example:\n  interlace watch --cell exp-4-2 --clearance --cell-file deploy/cells/exp-4-2/cell.yaml --until-idle 5");
  return {command, [a](Interrupts& interrupts) { return execute(*a, interrupts); }};
}

}  // namespace interlace::client::commands
