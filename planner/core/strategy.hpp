#pragma once

#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "common/model/cell.hpp"
#include "common/model/messages.hpp"
#include "planner/core/map_store.hpp"
#include "planner/core/reach.hpp"

namespace interlace::core {

/// Another robot as a candidate has to see it. Together with the candidate's own motion these decide whether it has a start.
struct Neighbour {
  model::RobotIndex robot = 0;
  SampledMotionPtr motion;                         ///< its committed motion, or its standing posture
  Instant start_from{}, start_until{};             ///< of a committed motion
  bool committed = false;                          ///< has a motion that it will carry out or is carrying out
  bool started = false;                            ///< that motion was reported as begun
  bool overdue = false;                            ///< its start window has passed and nobody knows whether it began
  bool lost = false;                               ///< could be anywhere in its reach
  ReachableVolume reach{Vector3::Zero(), kNever};  ///< that reach, when lost; without better knowledge everywhere

  [[nodiscard]] bool operator==(const Neighbour& other) const {
    return robot == other.robot && motion == other.motion && start_from == other.start_from && start_until == other.start_until &&
           committed == other.committed && started == other.started && overdue == other.overdue && lost == other.lost &&
           reach == other.reach;
  }
};

/// A robot that stands, with the motion it should make next.
struct Candidate {
  model::RobotIndex robot = 0;
  SampledMotionPtr motion;
  Duration tolerance{};  ///< its latest start after the planned one
};

/// What a strategy finds for a candidate: the start it chooses and why not sooner.
struct Assessment {
  std::optional<Instant> start;  ///< empty: none, a deadlock as things are
  std::vector<StartInterval> windows;
  std::vector<model::Conflict> conflicts;     ///< one per neighbour that delays or blocks
  std::vector<model::RobotIndex> blockers;    ///< neighbours that forbid every start from some time on
  std::vector<model::RobotIndex> departures;  ///< neighbours that must have started before this start may be sent
  model::Reason reason = model::Reason::none;
};

/// Which escapes may be looked for.
struct EscapeRules {
  bool six_directions_only = false;  ///< the dissertation's: no retreat, no home pose
  bool brake_after_area = false;     ///< the dissertation's real goal: braking begins where the collision area ends
  int cascade = 3;                   ///< an escape may itself need room: how deep that goes; 1: not at all
  bool step_aside = true;            ///< the commanded robot may go out of the way of those that are in its own
  bool keep_next = true;             ///< prefer goals from which the robot's next command can be carried out
};

/// Whether an assessment also says why: its conflicts. What it decides is the same.
enum class Evidence { no, yes };

/// Times the planner must keep around a decision.
struct Timing {
  Instant earliest{};  ///< no start before: now + lead
  Duration confirm{};  ///< from a neighbour's latest start until the planner has surely heard of it and can act on it
  std::optional<Duration> promise = std::nullopt;  ///< a start may be so long before a departure it relies on; empty: only after it
};

/// What a strategy does beyond choosing starts.
struct Service {
  bool in_turn = false;  ///< robots are served in turn 1 … n, one commanded robot at a time; else whoever can start does
  bool escapes = false;  ///< deadlocks are resolved by escapes
  bool maps = false;     ///< it asks for the maps of motions as they are, so that they may be built before
  bool ahead = false;    ///< commands that wait are planned together (planner/core/outlook.hpp)
  EscapeRules rules;     ///< which
};

/// How starts are chosen. Stateless; one object serves all robots of a cell.
class Strategy {
 public:
  Strategy() = default;
  Strategy(const Strategy&) = delete;
  Strategy& operator=(const Strategy&) = delete;
  virtual ~Strategy() = default;

  [[nodiscard]] virtual std::string_view name() const = 0;
  [[nodiscard]] virtual Service service() const { return {}; }

  /// Start of `candidate` in sight of `neighbours`. Where there is none, there is none later either, unless a neighbour changes.
  [[nodiscard]] virtual Assessment assess(const Candidate& candidate, const std::vector<Neighbour>& neighbours, const Timing& timing,
                                          MapStore& maps, Evidence evidence = Evidence::yes) const = 0;
};

/// Starts of `candidate` that a neighbour forbids which is not lost, by the map of their motions: widened by all that is uncertain about
/// both starts, and until a neighbour whose departure clears the way is known to have left; such a one goes to `departures`. United.
[[nodiscard]] std::vector<StartInterval> forbidden_by(const Candidate& candidate, const Neighbour& neighbour, const Timing& timing,
                                                      const KeptMap& kept, std::vector<model::RobotIndex>& departures);

/// A neighbour's stop between a motion that it carries out and the next, which it is committed to as well.
struct Stop {
  Instant moving_from{}, moving_until{};  ///< its start of the first lies in between
  Instant leaves_from{}, leaves_until{};  ///< that of the next
};

/// Starts forbidden around a stop. Those after `relies_from` would meet the neighbour if it stayed there.
struct ForbiddenByStop {
  std::vector<StartInterval> starts;
  Instant relies_from = model::kForever;
};

/// Starts of `commanded` that a neighbour forbids by the maps of two motions that follow each other, when it leaves the stop between them
/// as it promises: where it would be met there, not sooner than `promise` before it leaves. Source: docs/adr/0006-look-ahead.md.
[[nodiscard]] ForbiddenByStop forbidden_by_stop(const Candidate& commanded, const SampledMotion& first, const Stop& stop, Duration promise,
                                                const KeptMap& first_map, const KeptMap& next_map);

/// The same from any map, one interval for each of its cells: the evidence.
[[nodiscard]] std::vector<ForbiddenStart> forbidden_by_map(const Candidate& candidate, const Neighbour& neighbour, const Timing& timing,
                                                           const TimingMap& map, std::vector<model::RobotIndex>& departures);

/// The strategy called `name` for `cell`, which must outlive it; null when there is none. Known: strategy_names().
[[nodiscard]] std::unique_ptr<Strategy> make_strategy(std::string_view name, const model::Cell& cell);

[[nodiscard]] const std::vector<std::string_view>& strategy_names();

[[nodiscard]] bool is_strategy(std::string_view name);

}  // namespace interlace::core
