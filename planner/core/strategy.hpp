#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "common/model/cell.hpp"
#include "common/model/messages.hpp"
#include "planner/core/start_windows.hpp"

namespace interlace::core {

/// Timing maps of pairs of motions, built when first asked for and kept while both motions live.
class MapStore {
 public:
  /// `stopwatch` tells elapsed seconds for the statistics, and nothing depends on it; may be empty.
  MapStore(double margin, std::function<double()> stopwatch) : margin_(margin), stopwatch_(std::move(stopwatch)) {}

  /// The map of `commanded` against `moving`; valid until the next call.
  const TimingMap& get(const SampledMotionPtr& commanded, const SampledMotionPtr& moving);

  [[nodiscard]] std::size_t size() const { return maps_.size(); }

  /// Maps built so far.
  [[nodiscard]] std::size_t builds() const { return builds_; }

  /// Seconds each map took to build since the last call; empty without a stopwatch.
  [[nodiscard]] std::vector<double> take_build_times() { return std::exchange(build_times_, {}); }

 private:
  struct Kept {
    std::weak_ptr<SampledMotion> commanded, moving;
    TimingMap map;
  };
  void forget_dead();

  static constexpr std::size_t kTidyAt = 256;

  double margin_;
  std::function<double()> stopwatch_;
  std::map<std::pair<std::uint64_t, std::uint64_t>, Kept> maps_;
  std::vector<double> build_times_;
  std::size_t builds_ = 0;
  std::size_t tidy_at_ = kTidyAt;
};

/// Another robot as a candidate has to see it.
struct Neighbour {
  model::RobotIndex robot = 0;
  SampledMotionPtr motion;              ///< its committed motion, or its standing posture
  Instant start_from{}, start_until{};  ///< of a committed motion
  bool committed = false;               ///< has a motion that it will carry out or is carrying out
  bool started = false;                 ///< that motion was reported as begun
  bool overdue = false;                 ///< its start window has passed and nobody knows whether it began
  bool lost = false;                    ///< could be anywhere in its reach
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

/// Times the planner must keep around a decision.
struct Timing {
  Instant earliest{};  ///< no start before: now + lead
  Duration confirm{};  ///< from a neighbour's latest start until the planner has surely heard of it and can act on it
};

/// What a strategy does beyond choosing starts.
struct Service {
  bool in_turn = false;  ///< robots are served in turn 1 … n, one commanded robot at a time; else whoever can start does
  bool escapes = false;  ///< deadlocks are resolved by escapes
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

  /// Start of `candidate` in sight of `neighbours`.
  [[nodiscard]] virtual Assessment assess(const Candidate& candidate, const std::vector<Neighbour>& neighbours, const Timing& timing,
                                          MapStore& maps) const = 0;
};

/// Starts of `candidate` that `map` (of its motion against the neighbour's) forbids, for a neighbour that is not lost: widened by all that
/// is uncertain about both starts, and until a neighbour whose departure clears the way is known to have left; such a one goes to
/// `departures`.
[[nodiscard]] std::vector<ForbiddenStart> forbidden_by_map(const Candidate& candidate, const Neighbour& neighbour, const Timing& timing,
                                                           const TimingMap& map, std::vector<model::RobotIndex>& departures);

/// The strategy called `name` for `cell`, which must outlive it; null when there is none. Known: strategy_names().
[[nodiscard]] std::unique_ptr<Strategy> make_strategy(std::string_view name, const model::Cell& cell);

[[nodiscard]] const std::vector<std::string_view>& strategy_names();

[[nodiscard]] bool is_strategy(std::string_view name);

}  // namespace interlace::core
