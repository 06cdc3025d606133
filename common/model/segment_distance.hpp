#pragma once

#include "common/model/pose.hpp"

namespace interlace::model {

/// Least distance [m] between the segments a0–a1 and b0–b1, which may be points. Independent of FCL: the second opinion of observers and
/// tests, never what the planner decides with. Pure; any thread.
/// Method: least of the interior critical point and the four end point to segment distances, so no clamping order can go wrong.
[[nodiscard]] double segment_distance(const Vector3& a0, const Vector3& a1, const Vector3& b0, const Vector3& b1);

}  // namespace interlace::model
