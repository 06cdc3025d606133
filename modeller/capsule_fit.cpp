#include "modeller/capsule_fit.hpp"

#include <nlopt.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "modeller/hull.hpp"

namespace interlace::modeller {

namespace {

using model::Capsule;
using model::Vector3;

constexpr double kSlack = 1e-9;  // [m] by which every point is inside at least: more than writing and reading a number can lose

/// Axes of a set of points: columns of a rotation, longest spread first, and their middle.
struct Principal {
  Eigen::Matrix3d axes;
  Vector3 middle;
  double size;  // [m] a length to scale steps by
};

Principal principal_of(const std::vector<Vector3>& points) {
  Principal found;
  Vector3 mean = Vector3::Zero();
  for (const Vector3& p : points) mean += p / static_cast<double>(points.size());
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const Vector3& p : points) spread += (p - mean) * (p - mean).transpose();
  found.axes = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>{spread}.eigenvectors().rowwise().reverse();
  Eigen::AlignedBox3d box;
  for (const Vector3& p : points) box.extend(found.axes.transpose() * p);
  found.middle = found.axes * box.center();
  found.size = std::max(box.sizes().maxCoeff(), kGrain);
  return found;
}

constexpr std::size_t kParameters = 5;

/// Two tilts of the axis, its two offsets from the middle, and by how much the radius exceeds the least one (√(r² − r₀²)); tilts as
/// tangents, the others as shares of the size.
using Parameters = std::array<double, kParameters>;

/// Capsules about the points whose axis runs near a start: the objective of the search.
class Bundle {
 public:
  Bundle(const std::vector<Vector3>& points, const Principal& principal, const Vector3& direction)
      : points_(points),
        middle_(principal.middle),
        size_(principal.size),
        d_(direction),
        u_(direction.unitOrthogonal()),
        v_(d_.cross(u_)) {}

  /// `x`: Parameters. The shortest capsule of that axis and radius with every point inside. A point at height t and distance ρ from the
  /// axis is inside when t ≤ top + √(r² − ρ²) and t ≥ foot − √(r² − ρ²).
  [[nodiscard]] Capsule capsule(const double* x) const {
    const Vector3 d = (d_ + x[0] * u_ + x[1] * v_).normalized();
    const Vector3 c = middle_ + size_ * (x[2] * u_ + x[3] * v_);
    double r2 = 0;
    for (const Vector3& p : points_) r2 = std::max(r2, (p - c).squaredNorm() - square(d.dot(p - c)));
    r2 += square(size_ * x[4]);
    double top = -INFINITY;
    double foot = INFINITY;
    for (const Vector3& p : points_) {
      const double t = d.dot(p - c);
      const double reach = std::sqrt(std::max(0.0, r2 - ((p - c).squaredNorm() - t * t)));
      top = std::max(top, t - reach);
      foot = std::min(foot, t + reach);
    }
    if (top < foot) top = foot = (top + foot) / 2;  // a sphere
    return {c + foot * d, c + top * d, std::sqrt(r2)};
  }

  [[nodiscard]] double volume(const double* x) const {
    const Capsule c = capsule(x);
    return square(c.radius) * ((c.b - c.a).norm() + 4.0 / 3.0 * c.radius);  // over π
  }

 private:
  static double square(double x) { return x * x; }

  const std::vector<Vector3>& points_;
  Vector3 middle_;
  double size_;
  Vector3 d_, u_, v_;
};

/// Improves the start and returns the best capsule seen.
Capsule improved(const Bundle& bundle, int evaluations) {
  const std::unique_ptr<nlopt_opt_s, decltype(&nlopt_destroy)> search{nlopt_create(NLOPT_LN_SBPLX, kParameters), &nlopt_destroy};
  const auto volume = [](unsigned /*n*/, const double* x, double* /*gradient*/, void* data) {
    return static_cast<const Bundle*>(data)->volume(x);
  };
  const Parameters low{-1, -1, -1, -1, 0};
  const Parameters high{1, 1, 1, 1, 1};
  const Parameters step{0.1, 0.1, 0.05, 0.05, 0.1};
  nlopt_set_min_objective(search.get(), volume, const_cast<Bundle*>(&bundle));  // only handed back to `volume`
  nlopt_set_lower_bounds(search.get(), low.data());
  nlopt_set_upper_bounds(search.get(), high.data());
  nlopt_set_initial_step(search.get(), step.data());
  nlopt_set_ftol_rel(search.get(), 1e-7);
  nlopt_set_maxeval(search.get(), evaluations);
  Parameters x{};
  double least = 0;
  nlopt_optimize(search.get(), x.data(), &least);  // whatever ends the search, `x` is the best seen
  return bundle.capsule(x.data());
}

double bulk(const Capsule& c) {
  return c.radius * c.radius * ((c.b - c.a).norm() + 4.0 / 3.0 * c.radius);
}

/// `c` in numbers of few digits, with all of `points` inside by kSlack at least.
Capsule written(Capsule c, const std::vector<Vector3>& points) {
  const auto rounded = [](const Vector3& p) { return Vector3{(p / kGrain).array().round() * kGrain}; };
  c = {rounded(c.a), rounded(c.b), 0};
  double reach = 0;
  for (const Vector3& p : points) reach = std::max(reach, -depth_in(c, p));
  c.radius = std::ceil((reach + kSlack) / kGrain) * kGrain;
  return c;
}

}  // namespace

double depth_in(const Capsule& capsule, const Vector3& p) {
  const Vector3 d = capsule.b - capsule.a;
  const double s = d.isZero(0) ? 0.0 : std::clamp(d.dot(p - capsule.a) / d.squaredNorm(), 0.0, 1.0);
  return capsule.radius - (p - capsule.a - s * d).norm();
}

Capsule tightest_capsule(const std::vector<Vector3>& points, Effort effort) {
  // The distance from a segment is convex, so the farthest point is a corner of the hull.
  const auto hull = hull_of(points);
  const std::vector<Vector3>& corners = hull ? hull->corners : points;
  const Principal principal = principal_of(corners);
  const std::array<Vector3, 13> starts{Vector3{1, 0, 0}, {0, 1, 0},  {0, 0, 1}, {1, 1, 0},  {1, -1, 0}, {1, 0, 1}, {1, 0, -1},
                                       {0, 1, 1},        {0, 1, -1}, {1, 1, 1}, {1, 1, -1}, {1, -1, 1}, {-1, 1, 1}};
  const std::size_t tried = effort == Effort::quick ? 3 : starts.size();
  const int evaluations = effort == Effort::quick ? 80 : 1500;
  Capsule best;
  for (std::size_t i = 0; i < tried; ++i) {
    const Capsule found = improved(Bundle{corners, principal, principal.axes * starts[i].normalized()}, evaluations);
    if (i == 0 || bulk(found) < bulk(best)) best = found;
  }
  return written(best, points);
}

}  // namespace interlace::modeller
