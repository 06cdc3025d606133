#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "common/app/config/cell_file.hpp"
#include "common/dds/envelope.hpp"
#include "monitor/alarm_board.hpp"
#include "monitor/cell_picture.hpp"
#include "monitor/clearance_observer.hpp"
#include "monitor/collision_picture.hpp"
#include "monitor/command_book.hpp"
#include "monitor/frame.hpp"
#include "monitor/motion_book.hpp"
#include "monitor/proximity.hpp"
#include "monitor/scene.hpp"
#include "monitor/timeline.hpp"

namespace interlace::monitor {

inline constexpr int kFrameVersion = 1;  ///< of the frames (docs/monitor.md)

/// Everything an observer knows of a cell, from what its processes say to each other, and the frames that show it to people. Live and
/// from a recording it is fed the same way. Pure: time comes in with the messages. Not thread-safe.
class LiveView {
 public:
  using LocalTime = Timeline::LocalTime;

  static constexpr std::chrono::milliseconds kPosePeriod{33};  ///< advance() is called so often
  static constexpr std::chrono::milliseconds kStatePeriod{250};
  static constexpr std::chrono::milliseconds kCurvePeriod{200};
  static constexpr std::size_t kCurvePoints = 450;  ///< 90 s
  static constexpr double kPlannerSilence = 1.5;    ///< heartbeats come ten times a second [s]

  /// `cell` must outlive it. `origin` is the zero of its times. `recorded`: how long the recording is that it is fed from [s]; empty: it is
  /// fed by a running cell.
  LiveView(const app::LoadedCell& cell, LocalTime origin, std::optional<double> recorded = std::nullopt);

  void on_command(const dds::CommandMessage& message);
  void on_status(const dds::StatusMessage& message, LocalTime received);
  void on_dispatch(const dds::DispatchMessage& message, LocalTime received);
  void on_execution(const dds::ExecutionMessage& message, LocalTime received);
  void on_posture(const dds::PostureMessage& message, LocalTime received);
  void on_state(const model::PlannerState& state, LocalTime received);

  /// Time passes: measures how near the robots are, notices who is silent.
  void advance(LocalTime now);

  /// What happened since the last call, in order.
  [[nodiscard]] std::vector<Frame> take_events();
  /// Where the robots were at the last advance().
  [[nodiscard]] Frame pose() const;
  /// The same and all else that was known then, for those who do not read frames.
  [[nodiscard]] CellPicture picture() const;
  /// All that a viewer who has seen nothing needs.
  [[nodiscard]] Frame snapshot() const;
  /// The collision map of a command, or a frame that says why there is none.
  [[nodiscard]] Frame map(const model::CommandId& command);

 private:
  struct Seen {
    std::optional<double> heard;  // [s]
    std::optional<model::PostureReported> posture;
    model::ToolSet held;
    bool stranger = false;  // the newest message came from a proxy with another cell file
  };
  [[nodiscard]] double seconds_at(LocalTime t) const { return std::chrono::duration<double>(t - origin_).count(); }
  [[nodiscard]] bool heard_lately(const Seen& seen) const;
  [[nodiscard]] bool planner_heard_lately() const { return planner_heard_ && now_ - *planner_heard_ <= kPlannerSilence; }
  void add_event(const char* type, nlohmann::json content);
  void add_command(const CommandRecord* record);
  void add_motion(const KnownMotion* motion);
  void drop_motion(const model::RobotName& robot, const model::CommandId& id, bool dispatched_too);
  void note_status(const model::CommandStatus& status);
  void place_robots();
  void watch_alarms();
  void watch_contacts();
  void use_planner(std::uint64_t incarnation, LocalTime received);
  [[nodiscard]] nlohmann::json state_json() const;
  [[nodiscard]] nlohmann::json waiting_json(const model::RobotName& robot) const;
  [[nodiscard]] nlohmann::json pose_json() const;
  [[nodiscard]] nlohmann::json curves_json() const;
  /// What was known of a command's neighbours when the planner judged it.
  struct Judgement {
    double at = 0;  // [s]
    std::vector<PictureNeighbour> neighbours;
  };
  struct Judgements {
    std::optional<Judgement> first, last;  // when it was first held up; the newest
  };
  void note_judgements();
  [[nodiscard]] model::Result<PictureSubject, std::string> subject_of(const model::CommandId& command);
  [[nodiscard]] std::vector<PictureNeighbour> neighbours_of(model::RobotIndex robot, double from);
  [[nodiscard]] PictureNeighbour neighbour_of(model::RobotIndex robot, double from);

  const app::LoadedCell& cell_;
  LocalTime origin_;
  std::optional<double> recorded_;  // [s]
  Timeline line_;
  Pairs pairs_;
  ClearanceObserver observer_;
  CommandBook commands_;
  MotionBook motions_;
  std::vector<model::CommandId> judged_;  // since the last advance()
  std::map<model::CommandId, Judgements> judgements_;
  AlarmBoard alarms_;
  std::vector<Seen> seen_;
  std::vector<PlacedRobot> placed_;
  Proximity near_;
  std::optional<model::PlannerState> planner_;
  std::uint64_t incarnation_ = 0;        // of the planner in charge
  std::optional<double> planner_heard_;  // [s]
  double now_ = 0;                       // of the last advance [s]
  double next_state_ = 0, next_curve_ = 0;
  struct CurvePoint {
    double t;
    std::vector<std::optional<double>> pairs;
  };
  std::deque<CurvePoint> curve_;
  std::vector<std::size_t> contacts_;  // of each pair, as last told
  std::size_t fixture_contacts_ = 0;
  std::vector<Frame> events_;
};

}  // namespace interlace::monitor
