#pragma once

#include "common/model/fixture.hpp"
#include "common/model/robot_model.hpp"

namespace interlace::model {

/// Clearance [m] of a capsule from a fixture: distance of its axis from the material, less its radius; ≤ 0 is contact, and an axis that
/// touches the material gives −radius. Within 1e-9 m. The second opinion of observers and file checks: found by searching along the axis
/// for the point nearest to the shape, it shares nothing with what the planner computes.
[[nodiscard]] double clearance(const Capsule& capsule, const Fixture& fixture);

/// No clearance between the two can be below this [m]; cheap. Only for skipping.
[[nodiscard]] double clearance_lower_bound(const Capsule& capsule, const Fixture& fixture);

/// Whether a closed mesh holds `p` (in its own frame, not on the surface): the solid angle under which it sees the surface is 4π inside and
/// 0 outside, whichever way the triangles face as long as all do alike.
/// Source: Van Oosterom, Strackee, "The solid angle of a plane triangle", 1983.
[[nodiscard]] bool surrounds(const TriangleMesh& mesh, const Vector3& p);

}  // namespace interlace::model
