#pragma once

#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "planner/core/escape_goal.hpp"
#include "planner/core/neighbourhood.hpp"
#include "planner/core/strategy.hpp"

namespace interlace::core {

/// A robot as the search for escapes has to see it.
struct EscapeView {
  std::vector<Neighbour> seen;                 ///< as everyone sees it: one entry for each motion, or where it stands
  std::string immovable;                       ///< why it cannot be sent anywhere; empty: it can
  Duration tolerance{};                        ///< its latest start after the planned one
  std::vector<model::MotionRequest> trail;     ///< back along the path it came, newest place first
  std::vector<model::MotionRequest> home;      ///< to its home pose, straight and, where the model allows it, by its joints
  const model::MotionRequest* next = nullptr;  ///< first command that waits for it
  model::MotionBodies next_bodies;             ///< around that command

  [[nodiscard]] bool committed() const { return seen.back().committed; }
  [[nodiscard]] const SampledMotionPtr& motion() const { return seen.back().motion; }
  /// With what it holds when that motion is over, as it would escape.
  [[nodiscard]] const model::Robot& body() const { return *motion()->bodies().after; }
};

/// A motion with the start chosen for it.
struct PlannedMotion {
  model::RobotIndex robot = 0;
  model::EscapeWay way = model::EscapeWay::plus_x;
  model::MotionRequest request;
  SampledMotionPtr motion;
  Duration tolerance{};
  Instant not_before{};  ///< while its robot still does something else
  Assessment assessment;
};

/// Escapes in the order in which they start, and the start of the motion they make room for.
struct EscapePlan {
  std::vector<PlannedMotion> escapes;
  Assessment served;
};

/// Every way out that was looked at and why it does not help.
using EscapeRefusals = std::vector<model::EscapeRefusal>;

/// Searches escapes for the robots that stand in the way of a commanded one: each blocker in turn, nearest to the swept cuboid first, is
/// given a goal clear of everything the commanded robot will sweep, its path and start clear of everybody else, and is a moving robot for
/// the next one. An escape that is itself blocked has that blocker escape first. Motions of others are facts; nothing is decided here.
/// One object serves one search. Pure. Source: dissertation sections 5.2 and 6.3, DESIGN section 6.
class EscapeSearch {
 public:
  EscapeSearch(const model::Cell& cell, const Neighbourhood& neighbourhood, std::vector<EscapeView> robots, const Strategy& strategy,
               const Timing& timing, MapStore& maps);

  /// Room for `served`, which has no start as things are and was made from `request`. Where nothing else helps its robot steps aside first
  /// itself: then the plan's first escape is its own, and what is served starts from there.
  [[nodiscard]] model::Result<EscapePlan, EscapeRefusals> make_room(const Candidate& served, const model::MotionRequest& request);

 private:
  struct Way {
    model::EscapeWay way = model::EscapeWay::plus_x;
    std::optional<Vector3> unit;   // of a direction: as far as its robot can go
    model::MotionRequest request;  // of any other way
    bool built = false;
    RequestedMotion full;  // once built: to the reachable goal
    std::string why;       // there is none
  };
  using Attempt = std::function<bool()>;

  bool plainest(const Attempt& attempt);
  bool step_aside_and_serve(const PlannedMotion& served);
  void commit(PlannedMotion motion);
  void take_back();
  bool serve(PlannedMotion motion, int depth, const Attempt& then);
  bool clear_by(model::RobotIndex blocker, const PlannedMotion& motion, int depth, const Attempt& then);
  std::vector<Way>& ways_of(model::RobotIndex robot, const SampledMotionPtr& served);
  void build(model::RobotIndex robot, Way& way);
  RequestedMotion out_of_the_way(model::RobotIndex robot, const Way& way);
  const RequestedMotion& cut(model::RobotIndex robot, const Way& way, double length);
  [[nodiscard]] std::optional<double> first_clear(const SampledMotionPtr& full);
  [[nodiscard]] double safe_length(model::RobotIndex robot, const SampledMotionPtr& full);
  [[nodiscard]] Vector3 tcp_of(model::RobotIndex robot) const;
  [[nodiscard]] std::vector<Neighbour> neighbours_of(model::RobotIndex robot) const;
  [[nodiscard]] bool notes_refusal(model::RobotIndex robot, model::EscapeWay way) const;
  void refuse(model::RobotIndex robot, model::EscapeWay way, std::string text);

  const model::Cell& cell_;
  const Neighbourhood& neighbourhood_;
  std::vector<EscapeView> robots_;
  const Strategy& strategy_;
  Timing timing_;
  MapStore& maps_;
  EscapeRules rules_;
  int deepest_ = 1;
  bool keep_next_ = true;
  int budget_ = 0;
  std::vector<PlannedMotion> plan_;             // decided so far, in order
  std::vector<std::vector<Neighbour>> before_;  // how the robots of the plan were seen before
  std::vector<SampledMotionPtr> protected_;     // motions that room is being made for, outermost first
  std::map<std::pair<model::RobotIndex, std::uint64_t>, std::vector<Way>> ways_;
  std::map<std::pair<const SampledMotion*, long>, RequestedMotion> cut_;
  EscapeRefusals refusals_;
};

}  // namespace interlace::core
