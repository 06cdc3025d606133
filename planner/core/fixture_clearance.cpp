#include "planner/core/fixture_clearance.hpp"

#include <fcl/narrowphase/detail/primitive_shape_algorithm/capsule_capsule.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace interlace::core {

namespace {

using model::BoxShape;
using model::CylinderShape;
using model::MeshShape;
using model::PlaneShape;
using model::SphereShape;
using model::TriangleMesh;

/// The axis of a body as the fixture sees it, in the fixture's frame [m].
struct Axis {
  Vector3 a, b, middle;
  double half_length;
};

double squared_distance(const Axis& axis, const Vector3& p, const Vector3& q) {
  double s = 0;
  double t = 0;
  Vector3 on_axis;
  Vector3 on_edge;
  return fcl::detail::closestPtSegmentSegment(axis.a, axis.b, p, q, &s, &t, &on_axis, &on_edge);
}

/// Distance of the axis from a convex solid, given the solid's point nearest to any point. The squared distance along the axis is convex,
/// so its slope changes sign once; the way that is left after halving is taken off, so the result is never too long.
template <typename Nearest>
double distance_to_convex(const Axis& axis, const Nearest& nearest) {
  constexpr int kHalvings = 44;
  const Vector3 along = axis.b - axis.a;
  const auto away = [&](double s) -> Vector3 {
    const Vector3 p = axis.a + s * along;
    return p - nearest(p);
  };
  const auto rises = [&](double s) { return along.dot(away(s)) >= 0; };
  if (rises(0)) return away(0).norm();
  if (!rises(1)) return away(1).norm();
  double low = 0;
  double high = 1;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = (low + high) / 2;
    (rises(middle) ? high : low) = middle;
  }
  return std::max(away(high).norm() - 2 * axis.half_length * (high - low), 0.0);
}

/// 0 when the way does not cross the triangle, else 1 along its normal and −1 against it.
int crossing(const Vector3& from, const Vector3& to, const std::array<Vector3, 3>& t, const Vector3& normal) {
  const double before = normal.dot(from - t[0]);
  const double after = normal.dot(to - t[0]);
  if ((before > 0) == (after > 0)) return 0;
  const Vector3 p = from + before / (before - after) * (to - from);
  for (std::size_t i = 0; i < 3; ++i) {
    if (normal.dot((t[(i + 1) % 3] - t[i]).cross(p - t[i])) < 0) return 0;
  }
  return after > 0 ? 1 : -1;
}

/// A segment is nearest to a triangle where they cross, where one of its ends stands above it, or at an edge. Edges count even where a
/// triangle is too thin to have a normal.
double squared_distance(const Axis& axis, const std::array<Vector3, 3>& t) {
  const Vector3 normal = (t[1] - t[0]).cross(t[2] - t[0]);
  const double area = normal.squaredNorm();
  if (area > 0 && crossing(axis.a, axis.b, t, normal) != 0) return 0;
  double least = std::min({squared_distance(axis, t[0], t[1]), squared_distance(axis, t[1], t[2]), squared_distance(axis, t[2], t[0])});
  if (area <= 0) return least;
  for (const Vector3& end : {axis.a, axis.b}) {
    const double height = normal.dot(end - t[0]);
    const double squared = height * height / area;
    if (squared >= least) continue;
    const bool above = normal.dot((t[1] - t[0]).cross(end - t[0])) >= 0 && normal.dot((t[2] - t[1]).cross(end - t[1])) >= 0 &&
                       normal.dot((t[0] - t[2]).cross(end - t[2])) >= 0;
    if (above) least = squared;
  }
  return least;
}

double distance_to_box(const TriangleMesh::Bounds& box, const Vector3& p) {
  return (box.min - p).cwiseMax(p - box.max).cwiseMax(0).norm();
}

/// Whether a ray from `p` leaves the mesh through an odd number of triangles. A ray that grazes an edge may be counted wrong, three in
/// general directions hardly are; the body is taken to be inside when any of them says so.
bool inside(const TriangleMesh& mesh, const Vector3& p) {
  if (distance_to_box(mesh.bounds(), p) > 0) return false;
  const double far = 2 * (mesh.bounds().max - mesh.bounds().min).norm();
  const std::array<Vector3, 3> ways{Vector3{0.7412, 0.3571, 0.5687}, Vector3{-0.5283, 0.6917, 0.4925}, Vector3{0.2719, -0.4637, 0.8432}};
  return std::any_of(ways.begin(), ways.end(), [&](const Vector3& way) {
    const Vector3 out = p + far * way;
    const auto hit = [&](const TriangleMesh::Bounds& box) {  // slabs; a false yes costs time only
      double enter = 0;
      double leave = far;
      for (Eigen::Index i = 0; i < 3; ++i) {
        const double one = (box.min[i] - p[i]) / way[i];
        const double two = (box.max[i] - p[i]) / way[i];
        enter = std::max(enter, std::min(one, two));
        leave = std::min(leave, std::max(one, two));
      }
      return enter <= leave + 1e-9;
    };
    int left = 0;
    int crossed = 0;
    mesh.visit(hit, [&](std::size_t i) {
      const auto t = mesh.corners(i);
      const int through = crossing(p, out, t, (t[1] - t[0]).cross(t[2] - t[0]));
      left += through;
      crossed += through != 0 ? 1 : 0;
    });
    return left != 0 || crossed % 2 != 0;
  });
}

/// Distance of an axis from a shape; one above `enough` may come out as anything above it.
struct Distance {
  const Axis& axis;
  double enough;

  double operator()(const SphereShape& s) const { return std::sqrt(squared_distance(axis, Vector3::Zero(), Vector3::Zero())) - s.radius; }
  double operator()(const PlaneShape& s) const { return std::min(s.normal.dot(axis.a), s.normal.dot(axis.b)) - s.offset; }
  double operator()(const BoxShape& s) const {
    return convex([&](const Vector3& p) -> Vector3 { return p.cwiseMax(-s.half).cwiseMin(s.half); });
  }
  double operator()(const CylinderShape& s) const {
    return convex([&](const Vector3& p) -> Vector3 {
      const double out = std::hypot(p.x(), p.y());
      const double shrink = out > s.radius ? s.radius / out : 1;
      return {shrink * p.x(), shrink * p.y(), std::clamp(p.z(), -s.half_length, s.half_length)};
    });
  }
  double operator()(const MeshShape& s) const {
    const TriangleMesh& mesh = *s.mesh;
    double least = std::numeric_limits<double>::infinity();
    mesh.visit(
        [&](const TriangleMesh::Bounds& box) { return distance_to_box(box, axis.middle) - axis.half_length <= std::min(least, enough); },
        [&](std::size_t i) { least = std::min(least, std::sqrt(squared_distance(axis, mesh.corners(i)))); });
    return mesh.solid() && least > 0 && inside(mesh, axis.a) ? 0 : least;
  }

  template <typename Nearest>
  [[nodiscard]] double convex(const Nearest& nearest) const {
    const double at_least = (axis.middle - nearest(axis.middle)).norm() - axis.half_length;
    return at_least > enough ? at_least : distance_to_convex(axis, nearest);
  }
};

/// Goes down a motion's pieces, in order of time, with the pairs of bodies and fixtures that are not proven apart yet.
class Walk {
 public:
  Walk(SampledMotion& motion, const std::vector<model::Fixture>& fixtures, double margin)
      : motion_(motion), fixtures_(fixtures), margin_(margin + kFixtureRounding) {
    const auto& capsules = motion.robot().model.capsules;
    for (std::size_t body = 0; body < capsules.size(); ++body) {
      if (capsules[body].link == 0) continue;
      for (std::size_t fixture = 0; fixture < fixtures.size(); ++fixture) open_.push_back({body, fixture});
    }
  }

  std::optional<FixtureContact> first() { return piece(0, 0, 0, open_.size()); }

 private:
  struct Pair {
    std::size_t body, fixture;
  };

  /// The first contact in a piece, of the pairs [first, last) of `open_`.
  std::optional<FixtureContact> piece(int level, std::size_t index, std::size_t first, std::size_t last) {
    const SampledMotion::Piece& p = motion_.piece(level, index);
    for (std::size_t k = first; k < last; ++k) {
      const Pair pair = open_[k];
      const double reach = p.reach[pair.body];
      const double d = clearance(p.bodies[pair.body], fixtures_[pair.fixture], reach + margin_);
      if (d > reach + margin_) continue;
      if (level == motion_.finest() || d <= margin_ - reach) {  // undecided to the last, or too near throughout
        open_.resize(last);
        return FixtureContact{p.t0, pair.body, pair.fixture};
      }
      open_.push_back(pair);
    }
    const std::size_t end = open_.size();
    std::optional<FixtureContact> found;
    if (end > last) {
      found = piece(level + 1, 2 * index, last, end);
      if (!found) found = piece(level + 1, 2 * index + 1, last, end);
    }
    open_.resize(last);
    return found;
  }

  SampledMotion& motion_;
  const std::vector<model::Fixture>& fixtures_;
  double margin_;
  std::vector<Pair> open_;  // lists of the pieces from the first one down to the one looked at, one behind the other
};

}  // namespace

double clearance(const Body& body, const model::Fixture& fixture, double enough) {
  const model::Pose X_OW = fixture.X_WO.inverse();
  const Axis axis{X_OW * body.a, X_OW * body.b, X_OW * body.centre, body.half_length};
  return std::visit(Distance{axis, enough + body.radius}, fixture.shape) - body.radius;
}

std::optional<FixtureContact> first_contact(SampledMotion& motion, const std::vector<model::Fixture>& fixtures, double margin) {
  if (fixtures.empty()) return std::nullopt;
  return Walk{motion, fixtures, margin}.first();
}

}  // namespace interlace::core
