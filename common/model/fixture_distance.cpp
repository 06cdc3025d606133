#include "common/model/fixture_distance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace interlace::model {

namespace {

/// Least value of the convex function `f` on [0, 1], by golden section.
template <typename Function>
double least_of(const Function& f) {
  constexpr double kGolden = 0.6180339887498949;
  constexpr int kSteps = 64;  // leave 4e-14 of the interval
  double low = 0;
  double high = 1;
  double x = 1 - kGolden;
  double y = kGolden;
  double fx = f(x);
  double fy = f(y);
  for (int i = 0; i < kSteps; ++i) {
    if (fx <= fy) {
      high = y;
      y = x;
      fy = fx;
      x = high - kGolden * (high - low);
      fx = f(x);
    } else {
      low = x;
      x = y;
      fx = fy;
      y = low + kGolden * (high - low);
      fy = f(y);
    }
  }
  return std::min({fx, fy, f(0.0), f(1.0)});
}

double distance_to_box(const Vector3& p, const Vector3& middle, const Vector3& half) {
  return ((p - middle).cwiseAbs() - half).cwiseMax(0).norm();
}

double distance_to_edge(const Vector3& p, const Vector3& a, const Vector3& b) {
  const Vector3 ab = b - a;
  const double length = ab.squaredNorm();
  const double s = length > 0 ? std::clamp(ab.dot(p - a) / length, 0.0, 1.0) : 0.0;
  return (p - a - s * ab).norm();
}

double distance_to_triangle(const Vector3& p, const std::array<Vector3, 3>& t) {
  const Vector3 normal = (t[1] - t[0]).cross(t[2] - t[0]);
  bool above = normal.squaredNorm() > 0;  // the triangle, or below it
  double edges = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector3& a = t[i];
    const Vector3& b = t[(i + 1) % 3];
    above = above && normal.dot((b - a).cross(p - a)) >= 0;
    edges = std::min(edges, distance_to_edge(p, a, b));
  }
  return above ? std::abs(normal.dot(p - t[0])) / normal.norm() : edges;
}

/// Distances of points, in the shape's frame, from its material; of a mesh from its bounding box.
struct DistanceTo {
  const Vector3& p;

  double operator()(const SphereShape& s) const { return std::max(p.norm() - s.radius, 0.0); }
  double operator()(const BoxShape& s) const { return distance_to_box(p, Vector3::Zero(), s.half); }
  double operator()(const CylinderShape& s) const {
    return std::hypot(std::max(std::hypot(p.x(), p.y()) - s.radius, 0.0), std::max(std::abs(p.z()) - s.half_length, 0.0));
  }
  double operator()(const PlaneShape& s) const { return std::max(s.normal.dot(p) - s.offset, 0.0); }
  double operator()(const MeshShape& s) const {
    const auto& box = s.mesh->bounds();
    return distance_to_box(p, (box.min + box.max) / 2, (box.max - box.min) / 2);
  }
};

double distance(const Vector3& a, const Vector3& b, const TriangleMesh& mesh) {
  const auto at = [&](double s) -> Vector3 { return a + s * (b - a); };
  const Vector3 middle = at(0.5);
  const double half = (b - a).norm() / 2;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < mesh.triangles().size(); ++i) {
    const auto corners = mesh.corners(i);
    if (distance_to_triangle(middle, corners) - half >= least) continue;
    least = std::min(least, least_of([&](double s) { return distance_to_triangle(at(s), corners); }));
  }
  return least > 0 && mesh.solid() && surrounds(mesh, a) ? 0 : least;
}

}  // namespace

double clearance_lower_bound(const Capsule& capsule, const Fixture& fixture) {
  const Vector3 middle = fixture.X_WO.inverse() * Vector3{(capsule.a + capsule.b) / 2};
  return std::visit(DistanceTo{middle}, fixture.shape) - (capsule.b - capsule.a).norm() / 2 - capsule.radius;
}

double clearance(const Capsule& capsule, const Fixture& fixture) {
  const Pose X_OW = fixture.X_WO.inverse();
  const Vector3 a = X_OW * capsule.a;
  const Vector3 b = X_OW * capsule.b;
  if (const auto* shape = std::get_if<MeshShape>(&fixture.shape)) return distance(a, b, *shape->mesh) - capsule.radius;
  const auto at = [&](double s) {
    const Vector3 p = a + s * (b - a);
    return std::visit(DistanceTo{p}, fixture.shape);
  };
  return least_of(at) - capsule.radius;
}

bool surrounds(const TriangleMesh& mesh, const Vector3& p) {
  const auto& box = mesh.bounds();
  if ((p.array() < box.min.array()).any() || (p.array() > box.max.array()).any()) return false;
  double turns = 0;  // solid angle, of 4π
  for (std::size_t i = 0; i < mesh.triangles().size(); ++i) {
    const auto t = mesh.corners(i);
    const Vector3 a = t[0] - p;
    const Vector3 b = t[1] - p;
    const Vector3 c = t[2] - p;
    const double la = a.norm();
    const double lb = b.norm();
    const double lc = c.norm();
    turns += std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb) / (2 * kPi);
  }
  return std::abs(turns) > 0.5;
}

}  // namespace interlace::model
