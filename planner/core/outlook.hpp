#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <list>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <unordered_map>
#include <utility>
#include <variant>
#include <vector>

#include "common/model/cell.hpp"
#include "planner/core/neighbourhood.hpp"
#include "planner/core/pair_rest.hpp"
#include "planner/core/strategy.hpp"

namespace interlace::core {

/// A command that waits, and the motion it will be.
struct WaitingMotion {
  model::MotionRequest request;
  SampledMotionPtr motion;
};

/// A robot as a look ahead has to see it.
struct OutlookRobot {
  std::vector<Neighbour> seen;               ///< what it does now, as everyone sees it
  Instant free{};                            ///< it can start nothing else before
  Duration tolerance{};                      ///< its latest start after the planned one
  std::vector<WaitingMotion> queue;          ///< in order
  std::optional<model::MotionRequest> back;  ///< undoes what it last did, while it stands
};

/// Out of the way of others, to a place from which the robot's next command is possible.
struct Detour {
  model::EscapeWay way = model::EscapeWay::home;
  model::MotionRequest request;
  SampledMotionPtr motion;
};

/// A start in a plan.
struct PlannedStart {
  model::RobotIndex robot = 0;
  std::optional<Detour> detour;         ///< empty: the robot's next command
  std::optional<WaitingMotion> slower;  ///< that command at another speed, where it is done sooner so
  model::RobotIndex serves = 0;         ///< of a detour: whose next command it makes room for
  Instant start{};
};

/// All starts until all queues are empty, in the order of their times.
struct OutlookPlan {
  std::vector<PlannedStart> starts;
  Instant end{};    ///< of the last motion
  Duration flow{};  ///< sum of the ends of commands, from the present on

  /// Done sooner, or as soon with commands done sooner on the whole.
  [[nodiscard]] bool better_than(const OutlookPlan& other) const { return end != other.end ? end < other.end : flow < other.flow; }
};

/// What can come of all commands that wait, if all goes as planned: a search over the order in which robots start, each as early as what
/// has started before leaves it clear. A start is judged as the planner itself will judge it when its time comes, with everybody else
/// standing where his last start leads: so each start of a plan can be sent when its turn comes, whatever becomes of those after it. On
/// kept maps: what a pair of motions forbids is a few intervals. Beginnings are judged by what each two robots that can meet need together
/// for all they have before them. Where nobody who is waited for will move by himself, one in the way makes
/// a detour. Pure and deterministic: work is counted, not timed. Not thread-safe. Source: beam search; DESIGN section 6, strategy
/// `lookahead`.
class Outlook {
 public:
  Outlook(const model::Cell& cell, Neighbourhood neighbourhood);

  /// How things are from here on; `lead`: between the end of a motion and the next start of its robot. `maps` must live as long as this is
  /// used.
  std::uint64_t look(std::vector<OutlookRobot> robots, const Timing& timing, Duration lead, MapStore& maps);

  /// The starts of `plan` in their order, from how things are; empty when they are no longer possible, or not all.
  [[nodiscard]] std::optional<OutlookPlan> follow(const OutlookPlan& plan);

  /// What a search may spend.
  struct Budget {
    std::size_t work = 0;    ///< in all
    std::size_t maps = 0;    ///< of that, on what it has to find out about motions; beyond it, it wishes to know and goes on without
    std::size_t grants = 0;  ///< pairs of motions the last search wished to know about, and which this one knows
  };

  /// A plan that is better than `best` and ends no later than `no_later`, where these are given; empty when none is found. The next search
  /// from the same state goes on where this one stopped, with wider beams and more detours.
  [[nodiscard]] std::optional<OutlookPlan> search(const std::optional<Instant>& no_later, const OutlookPlan* best, const Budget& budget,
                                                  MapStore& maps);

  /// Between searches: finds out the next thing that the last one wished to know. False when there is none. What the next one knows depends
  /// on its grants alone, not on how much was found out in time.
  bool prepare(MapStore& maps);

  /// A plan that is better than `plan` because somebody who would wait sets out at once instead and goes slower; empty when there is none.
  [[nodiscard]] std::optional<OutlookPlan> slowed_down(const OutlookPlan& plan, std::size_t budget, MapStore& maps);

  /// The last search from this state tried all that it knows.
  [[nodiscard]] bool exhausted() const { return next_beam_ >= kBeams; }

  [[nodiscard]] std::uint64_t looks() const { return looks_; }

  /// Work of the last search.
  [[nodiscard]] std::size_t work() const { return work_; }

 private:
  static constexpr std::size_t kBeams = 12;

  /// When a motion forbids another to start, after its own start.
  using Forbidden = std::vector<StartInterval>;
  struct Pair {
    Forbidden forbidden;   // with the other standing where it was before, for good
    KeptMap map;           // without its cells
    bool unknown = false;  // and so forbidden
  };
  /// A way out of a place and how far it leads.
  struct Way {
    model::EscapeWay way;
    model::MotionRequest request;
    SampledMotionPtr full;
  };
  /// Somewhere a robot stands, whenever, and with what in its hand.
  struct Posture {
    model::Joints q;
    const model::Robot* body = nullptr;  // with what it holds
    std::uint64_t looked = 0;            // when it was last come to
    std::optional<std::vector<Way>> known, sought;
    std::map<std::uint64_t, std::vector<Detour>> detours;  // by the motion that room is made for
    std::deque<SampledMotionPtr> followed;                 // of plans: detours whose own place is gone, and slower commands
    std::map<std::uint64_t, SampledMotionPtr> from_here;   // commands by the motion they are from elsewhere; null: not possible
  };
  /// What others forbid a motion, by theirs.
  struct Row {
    std::weak_ptr<SampledMotion> motion;
    std::unordered_map<std::uint64_t, Pair> with;
  };
  struct PairWish {
    model::RobotIndex robot, other;
    SampledMotionPtr motion, moving;
    std::optional<Pair> pair;
  };
  struct DetourWish {
    model::RobotIndex robot;
    Posture* posture;
    std::optional<model::MotionRequest> back;
    SampledMotionPtr served;
    std::optional<std::vector<Detour>> detours;
  };
  using Wish = std::variant<PairWish, DetourWish>;
  /// What two that can meet have before them together.
  struct Together {
    std::array<RobotIndex, 2> robots{};
    std::array<std::vector<std::uint64_t>, 2> ids;  // the motions that waited when it was found out
    std::array<std::size_t, 2> gone{};              // of those, since
    std::array<double, 2> beyond{};                 // that those which wait behind them take [s]
    std::size_t unknown = 0;                        // pairs of motions it knows nothing of
    std::optional<PairRest> rest;
  };
  /// Where a robot stands with how many commands done.
  struct Place {
    std::size_t number = 0;  // among all places
    Posture* posture = nullptr;
    bool aside = false;      // it came here by a detour
    std::size_t done = 0;    // commands
    SampledMotionPtr next;   // null: none left, or
    bool stuck = false;      // not possible from here: first it has to go somewhere else
    Duration rest{};         // all that is left to do
    Place* after = nullptr;  // the next command
    std::map<const SampledMotion*, Place*> detours;
    std::optional<model::MotionRequest> back;
  };
  struct RobotState {
    Place* place = nullptr;
    const SampledMotionPtr* moving = nullptr;  // null: as it was at first
    Instant start{};
    const SampledMotionPtr* before = nullptr;  // what it did before that; null: as it was at first
    Instant before_start{};
    Instant free{};
  };
  struct Action {
    model::RobotIndex robot = 0;
    const Detour* detour = nullptr;  // null: its next command
    model::RobotIndex serves = 0;
    Instant start{};
    const WaitingMotion* slower = nullptr;  // that command at another speed
  };
  struct Node {
    std::size_t parent = 0;
    Action action;
    Instant last{};
    Instant end{};
    Duration flow{};
    std::size_t detours = 0;  // so far
    double score = 0;
  };
  struct Beam {
    std::size_t width;
    double mean;          // weight of what all robots have before them, beside the one that has most
    std::size_t detours;  // at most, in a plan
  };

  [[nodiscard]] static Beam beam(std::size_t index);
  [[nodiscard]] std::optional<OutlookPlan> run(const Beam& beam, std::optional<Instant> no_later, const OutlookPlan* best);
  void expand(std::size_t parent, std::size_t most_detours, std::vector<std::size_t>& commands, std::vector<std::size_t>& detours);
  std::size_t add(std::size_t parent, const Action& action, const SampledMotionPtr& motion, Place* to);
  [[nodiscard]] bool begin();
  [[nodiscard]] bool no_sooner(std::size_t node, std::size_t other) const;
  std::optional<std::size_t> after(std::size_t node, const PlannedStart& p);
  std::optional<OutlookPlan> with_slower(const OutlookPlan& plan, std::size_t which, double part);
  [[nodiscard]] static const SampledMotionPtr* kept(Posture& posture, const SampledMotionPtr& motion);
  [[nodiscard]] OutlookPlan plan_to(std::size_t node) const;
  [[nodiscard]] const RobotState& state(std::size_t node, model::RobotIndex i) const { return states_[node * robots_.size() + i]; }
  [[nodiscard]] bool complete(std::size_t node) const;

  std::optional<Instant> start_of(std::size_t node, model::RobotIndex robot, const SampledMotionPtr& motion);
  std::optional<Instant> earliest(std::size_t node, model::RobotIndex robot, const SampledMotionPtr& motion, Instant from);
  std::optional<Instant> relying(std::size_t node, model::RobotIndex robot, const SampledMotionPtr& motion);
  [[nodiscard]] std::optional<Stop> stop_of(model::RobotIndex robot, const RobotState& s) const;
  [[nodiscard]] bool blocks_for_good(std::size_t node, model::RobotIndex blocker, model::RobotIndex robot, const SampledMotionPtr& motion);
  const Pair& pair(model::RobotIndex robot, const SampledMotionPtr& motion, model::RobotIndex other, const SampledMotionPtr& moving);
  const Forbidden& forbidden(model::RobotIndex robot, const SampledMotionPtr& motion, model::RobotIndex other,
                             const SampledMotionPtr& moving) {
    return pair(robot, motion, other, moving).forbidden;
  }
  Row& row_of(const SampledMotionPtr& motion);
  Pair make_pair(model::RobotIndex robot, const SampledMotionPtr& motion, model::RobotIndex other, const SampledMotionPtr& moving);
  void look_at_pairs();
  void look_at(Together& t);
  PairRest::Side beside(RobotIndex robot, RobotIndex other, std::size_t& unknown);
  double outlook_of(std::size_t node, double mean);
  const Forbidden& forbidden_now(model::RobotIndex robot, const SampledMotionPtr& motion, model::RobotIndex other);
  const KeptMap& map_of(const SampledMotionPtr& motion, const SampledMotionPtr& moving);
  std::optional<double> first_clear(const SampledMotionPtr& served, const SampledMotionPtr& way);
  Forbidden compute(model::RobotIndex robot, const SampledMotionPtr& motion, const Neighbour& other);

  Posture* posture_at(model::RobotIndex robot, const model::Joints& q, const model::Robot& body);
  Place* place_at(model::RobotIndex robot, const model::Joints& q, const model::Robot& body, std::size_t done,
                  const model::MotionRequest* back, bool aside);
  Place* after_command(model::RobotIndex robot, Place& place);
  Place* after_detour(model::RobotIndex robot, Place& place, const Detour& detour);
  const std::vector<Detour>& detours_of(model::RobotIndex robot, Place& place, const SampledMotionPtr& served);
  std::vector<Detour> find_detours(model::RobotIndex robot, Posture& posture, const std::optional<model::MotionRequest>& back,
                                   const SampledMotionPtr& served);
  const std::vector<Way>& ways_known(model::RobotIndex robot, Posture& posture, const std::optional<model::MotionRequest>& back);
  const std::vector<Way>& ways_sought(model::RobotIndex robot, Posture& posture);

  [[nodiscard]] bool may_find_out() const { return map_work_ < map_budget_; }
  void find_out_everything();
  void wish(Wish wish);
  void fulfil(Wish& wish);
  void grant(std::size_t grants);
  void forget_the_gone();
  SampledMotionPtr admitted(model::RobotIndex robot, const model::MotionBodies& bodies, const model::Joints& from,
                            const model::MotionRequest& request);

  const model::Cell& cell_;
  Neighbourhood neighbourhood_;
  std::vector<std::list<Posture>> postures_;          // by robot; kept while they are come to now and then
  std::unordered_map<std::uint64_t, Row> forbidden_;  // by own motion; kept while it lives
  Row* last_row_ = nullptr;                           // that was asked for
  std::uint64_t last_row_id_ = 0;
  std::vector<OutlookRobot> robots_;
  Timing timing_;
  Duration lead_{};
  MapStore* maps_ = nullptr;
  std::vector<std::unordered_map<std::uint64_t, Forbidden>> forbidden_now_;  // by what the other does now, then own motion
  std::deque<Place> places_;
  std::vector<Place*> roots_;
  std::vector<Node> nodes_;
  std::vector<RobotState> states_;  // of all robots at each node
  std::uint64_t looks_ = 0;
  std::size_t next_beam_ = 0;
  std::vector<Together> together_;
  std::vector<double> ends_;            // of robots at the node that is judged
  std::optional<std::size_t> settled_;  // with so many detours everything was tried
  std::size_t work_ = 0, budget_ = 0;
  std::size_t map_work_ = 0, map_budget_ = 0;
  std::deque<Wish> wishes_;                                 // of the last search, the first ones first
  std::set<std::pair<std::uint64_t, const void*>> wished_;  // what for
  std::size_t next_wish_ = 0;                               // to prepare
};

}  // namespace interlace::core
