#include "modeller/volume.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>

namespace interlace::modeller {

namespace {

using model::Capsule;
using model::kPi;
using model::Vector3;

struct Interval {
  double low, high;
};

/// What of the line through `p` along x lies in the capsule. The capsule is convex, and the union of two balls and a cylinder: the answer
/// reaches from the least to the greatest of theirs.
std::optional<Interval> along_x(const Capsule& c, const Vector3& p) {
  std::optional<Interval> found;
  const auto join = [&](double low, double high) {
    found = found ? Interval{std::min(found->low, low), std::max(found->high, high)} : Interval{low, high};
  };
  for (const Vector3& centre : {c.a, c.b}) {
    const double h2 = c.radius * c.radius - (p - centre).tail<2>().squaredNorm();
    if (h2 >= 0) join(centre.x() - std::sqrt(h2), centre.x() + std::sqrt(h2));
  }
  const double length = (c.b - c.a).norm();
  if (length == 0) return found;
  const Vector3 d = (c.b - c.a) / length;
  // Points p + x·e on the cylinder: |(p − a) + x·e − ((p − a)·d + x·dₓ)·d| = r, a quadratic in x, and 0 ≤ (p − a)·d + x·dₓ ≤ length.
  Vector3 w{-c.a.x(), p.y() - c.a.y(), p.z() - c.a.z()};
  const Vector3 across = Vector3::UnitX() - d.x() * d;
  const Vector3 off = w - w.dot(d) * d;
  const double qa = across.squaredNorm();
  const double qb = across.dot(off);
  const double qc = off.squaredNorm() - c.radius * c.radius;
  constexpr double kParallel = 1e-12;
  double low = -1e9;
  double high = 1e9;
  if (qa > kParallel) {
    const double disc = qb * qb - qa * qc;
    if (disc < 0) return found;
    low = (-qb - std::sqrt(disc)) / qa;
    high = (-qb + std::sqrt(disc)) / qa;
  } else if (qc > 0) {
    return found;
  }
  if (std::abs(d.x()) > kParallel) {
    const double foot = -w.dot(d) / d.x();
    const double head = (length - w.dot(d)) / d.x();
    low = std::max(low, std::min(foot, head));
    high = std::min(high, std::max(foot, head));
  } else if (w.dot(d) < 0 || w.dot(d) > length) {
    return found;
  }
  if (low < high) join(low, high);
  return found;
}

double covered_length(std::vector<Interval>& intervals) {
  std::sort(intervals.begin(), intervals.end(), [](const Interval& a, const Interval& b) { return a.low < b.low; });
  double sum = 0;
  double reached = -INFINITY;
  for (const Interval& i : intervals) {
    if (i.high > reached) sum += i.high - std::max(i.low, reached);
    reached = std::max(reached, i.high);
  }
  return sum;
}

}  // namespace

std::optional<double> enclosed_volume(const mesh::Mesh& mesh) {
  std::map<std::pair<int, int>, int> balance;  // of the directions an edge is gone along
  Vector3 middle = Vector3::Zero();
  for (const Vector3& p : mesh.vertices) middle += p / static_cast<double>(mesh.vertices.size());
  double six = 0;
  for (const Eigen::Vector3i& t : mesh.triangles) {
    for (int k = 0; k < 3; ++k) {
      const int i = t[k];
      const int j = t[(k + 1) % 3];
      if (i != j) balance[std::minmax(i, j)] += i < j ? 1 : -1;
    }
    six += (mesh.vertices[t[0]] - middle).dot((mesh.vertices[t[1]] - middle).cross(mesh.vertices[t[2]] - middle));
  }
  const bool closed = std::all_of(balance.begin(), balance.end(), [](const auto& edge) { return edge.second == 0; });
  return closed ? std::optional{std::abs(six) / 6} : std::nullopt;
}

double volume_of(const Capsule& capsule) {
  const double r = capsule.radius;
  return kPi * r * r * ((capsule.b - capsule.a).norm() + 4.0 / 3.0 * r);
}

double union_volume(const std::vector<Capsule>& capsules, int lines) {
  if (capsules.size() == 1) return volume_of(capsules.front());
  Eigen::AlignedBox3d bounds;
  for (const Capsule& c : capsules) {
    for (const Vector3& centre : {c.a, c.b}) {
      bounds.extend(centre + Vector3::Constant(c.radius));
      bounds.extend(centre - Vector3::Constant(c.radius));
    }
  }
  if (bounds.isEmpty()) return 0;
  const Vector3 step = bounds.sizes() / lines;
  std::vector<Interval> intervals;
  double sum = 0;
  for (int i = 0; i < lines; ++i) {
    for (int j = 0; j < lines; ++j) {
      const Vector3 p = bounds.min() + Vector3{0, (i + 0.5) * step.y(), (j + 0.5) * step.z()};
      intervals.clear();
      for (const Capsule& c : capsules) {
        if (const auto interval = along_x(c, p)) intervals.push_back(*interval);
      }
      sum += covered_length(intervals);
    }
  }
  return sum * step.y() * step.z();
}

}  // namespace interlace::modeller
