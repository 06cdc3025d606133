#pragma once

#include <optional>
#include <vector>

#include "common/model/cell.hpp"
#include "planner/core/reach.hpp"

namespace interlace::core {

/// When a motion is in the shared zone. Times [s] local to the motion.
struct ZoneVisit {
  bool enters = false;      ///< somewhere on the motion a body may be in the zone
  bool from_start = false;  ///< it stands in the zone before it starts
  bool to_end = false;      ///< it stands in the zone when it is over
  double entered = 0;       ///< before this no body is in the zone
  double left = 0;          ///< from here to the end no body is in the zone, unless `to_end`
  std::size_t body = 0;     ///< the first body in it, as an index of the model's capsules
};

/// The space that robots share, to be entered by one at a time.
/// With `planning.zone` it is that box. Otherwise it is made of the neighbouring pairs: the lens that both robots of a pair can reach, less
/// each one's own side of it. The sides are divided by a slab square to the shortest way between the two bodies standing at home (for arms
/// facing each other across a line, square to that line), as thick as that way less 5 mm on each side (a third of it when it is short), so
/// that robots at home and robots moving in the plane of their home are out of the zone. A robot on its own sides shares space with nobody.
/// A pair whose homes no plane separates has no sides: all of its lens is zone.
/// Immutable; thread-safe apart from the motions it is asked about.
/// Source: Zhou et al. on zone blocking, as told in the dissertation, section 4.5; the geometry is ours.
class SharedZone {
 public:
  /// Refers to `cell`, which must outlive it.
  explicit SharedZone(const model::Cell& cell);

  /// False when it is proven that no point of a body, displaced by at most `reach` [m], is in the zone as far as `robot` goes.
  [[nodiscard]] bool may_hold(model::RobotIndex robot, const Body& body, double reach) const;

  /// When `motion` of `robot` is in the zone: certified in continuous time, late in leaving by at most a piece of the motion.
  [[nodiscard]] ZoneVisit visit(model::RobotIndex robot, SampledMotion& motion) const;

  /// False when `robot` can be in the zone in no posture.
  [[nodiscard]] bool within_reach_of(model::RobotIndex robot) const;

 private:
  /// What a robot shares with one neighbour: where that one can be, beyond the plane p · towards = face.
  struct Share {
    ReachableVolume volume;  ///< the neighbour's, with the margin
    Vector3 towards = Vector3::Zero();
    double face = 0;
  };
  void divide(model::RobotIndex a, model::RobotIndex b);

  const model::Cell& cell_;
  std::vector<std::vector<Share>> shares_;  // by robot
};

}  // namespace interlace::core
