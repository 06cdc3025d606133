#pragma once

#include <vector>

#include "common/model/robot_model.hpp"

namespace interlace::modeller {

/// How much to try.
enum class Effort {
  quick,    ///< to compare ways of cutting
  thorough  ///< what is written down
};

/// The capsule of least volume around `points` [m] (at least one) that a search finds: from the principal axes of their hull and the
/// diagonals between them, each improved in direction, place and radius by NLopt's subplex method, which takes no derivatives and no
/// random numbers. The search only makes it tight. That every point is inside holds by construction: the radius is taken from the points
/// at the end, after the ends of the axis were rounded to `kGrain`, and rounded up to `kGrain`.
/// The same points in the same order give the same capsule. Pure; any thread.
[[nodiscard]] model::Capsule tightest_capsule(const std::vector<model::Vector3>& points, Effort effort = Effort::thorough);

inline constexpr double kGrain = 1e-6;  ///< [m] of the numbers of a capsule, so that few digits write them down exactly

/// How deep `p` lies inside the capsule [m]; negative outside.
[[nodiscard]] double depth_in(const model::Capsule& capsule, const model::Vector3& p);

}  // namespace interlace::modeller
