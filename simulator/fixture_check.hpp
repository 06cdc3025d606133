#pragma once

#include <fcl/narrowphase/collision_object.h>

#include <memory>
#include <vector>

#include "common/model/fixture.hpp"
#include "common/model/robot_model.hpp"

namespace interlace::sim {

/// Distances to fixtures as FCL's general solver finds them for its own collision objects: the third opinion beside the planner's and the
/// observer's, with which it shares only how a place inside a closed mesh is told. Not thread-safe.
class FixtureCheck {
 public:
  /// FCL's distances are too long by at most this [m] (docs/adr/0004-distances-to-fixtures.md): deeper contacts are all found.
  static constexpr double kAccuracy = 2e-5;

  explicit FixtureCheck(const std::vector<model::Fixture>& fixtures);

  /// Clearance [m] of `capsule` from a fixture, by its index: that of its axis less the radius; ≤ 0 is contact, at most as deep as the
  /// radius. What is above `enough` may come out as anything above it.
  [[nodiscard]] double clearance(const model::Capsule& capsule, std::size_t fixture, double enough) const;

 private:
  const std::vector<model::Fixture>& fixtures_;
  std::vector<std::unique_ptr<fcl::CollisionObjectd>> objects_;  // none for planes, which FCL measures no distance to
};

}  // namespace interlace::sim
