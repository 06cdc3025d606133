#pragma once

#include "planner/core/shared_zone.hpp"
#include "planner/core/strategy.hpp"

namespace interlace::core {

/// Zone blocking: one token for the shared zone. A motion that comes into the zone starts only while nobody else holds the token, and holds
/// it from its start until its last body is out for good; a robot that stands in the zone holds it until a motion takes it out. Motions
/// outside the zone start at once.
/// A zone alone protects nobody from a holder that reaches through it to the far side, nor from a zone drawn too small. There the whole
/// bodies' collision maps are kept to as `event` does, so that this baseline wastes time but never collides.
/// Source: Zhou et al., as compared with in the dissertation, section 4.5 and table 4.7.
class Zone final : public Strategy {
 public:
  /// Refers to `cell`, which must outlive it.
  explicit Zone(const model::Cell& cell) : zone_(cell) {}

  [[nodiscard]] std::string_view name() const override { return "zone"; }
  [[nodiscard]] Assessment assess(const Candidate& candidate, const std::vector<Neighbour>& neighbours, const Timing& timing,
                                  MapStore& maps, Evidence evidence) const override;

 private:
  SharedZone zone_;
};

}  // namespace interlace::core
