#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "common/model/fixture.hpp"
#include "planner/core/sampled_motion.hpp"

namespace interlace::core {

/// Clearance [m] of a body from a fixture: distance of its axis from the material, less its radius. ≤ 0 is contact; an axis that touches
/// the material, or is wholly inside, gives −radius. Exact to kFixtureRounding while below `enough`; anything above it only says so. Pure;
/// thread-safe. docs/adr/0004-distances-to-fixtures.md tells why the axis is measured, and not by FCL's general solver.
[[nodiscard]] double clearance(const Body& body, const model::Fixture& fixture, double enough);

inline constexpr double kFixtureRounding = 1e-7;  ///< of those distances, kept on the safe side [m]

/// Where a motion first comes too near to a fixture.
struct FixtureContact {
  double t = 0;  ///< local time [s]
  std::size_t body = 0;
  std::size_t fixture = 0;  ///< index
};

/// The first contact of `motion` with any of `fixtures`, nearer than `margin` [m]; empty when it is proven in continuous time that there is
/// none, like a free cell of a collision map (docs/certificate.md). What stays undecided at the finest pieces counts as contact. Bodies of
/// link 0 never move and are held against nothing.
[[nodiscard]] std::optional<FixtureContact> first_contact(SampledMotion& motion, const std::vector<model::Fixture>& fixtures,
                                                          double margin);

}  // namespace interlace::core
