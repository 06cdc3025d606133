#include "common/model/segment_distance.hpp"

#include <algorithm>
#include <cmath>

namespace interlace::model {

namespace {

double squared_point_segment(const Vector3& p, const Vector3& a, const Vector3& b) {
  const Vector3 d = b - a;
  const double length2 = d.squaredNorm();
  const double t = length2 > 0 ? std::clamp((p - a).dot(d) / length2, 0.0, 1.0) : 0.0;
  return (a + t * d - p).squaredNorm();
}

}  // namespace

double segment_distance(const Vector3& a0, const Vector3& a1, const Vector3& b0, const Vector3& b1) {
  double best = std::min({squared_point_segment(a0, b0, b1), squared_point_segment(a1, b0, b1), squared_point_segment(b0, a0, a1),
                          squared_point_segment(b1, a0, a1)});
  // Interior of both: the common perpendicular, if its feet lie inside the segments.
  const Vector3 u = a1 - a0;
  const Vector3 v = b1 - b0;
  const Vector3 n = u.cross(v);
  const double n2 = n.squaredNorm();
  if (n2 > 0) {
    const Vector3 w = b0 - a0;
    const double s = w.cross(v).dot(n) / n2;
    const double t = w.cross(u).dot(n) / n2;
    if (s > 0 && s < 1 && t > 0 && t < 1) best = std::min(best, (a0 + s * u - b0 - t * v).squaredNorm());
  }
  return std::sqrt(best);
}

}  // namespace interlace::model
