#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "common/model/segment_distance.hpp"
#include "planner/core/clearance.hpp"
#include "tests/support/arms.hpp"

/// The dissertation's appendix A measures some pairs of segments too far apart: a planner built on it would let arms touch.
namespace interlace::test {
namespace {

using model::Vector3;

/// Appendix A as published: nearest points of the two lines; when one lies outside its segment, one parameter is clamped, the other
/// solved for and clamped too, and the second visible edge, which the text asks to be checked, is never looked at.
double published_distance(const Vector3& p0, const Vector3& p1, const Vector3& q0, const Vector3& q1) {
  const Vector3 u = p1 - p0;
  const Vector3 v = q1 - q0;
  const Vector3 w = p0 - q0;
  const double a = u.dot(u);
  const double b = u.dot(v);
  const double c = v.dot(v);
  const double d = u.dot(w);
  const double e = v.dot(w);
  const double determinant = a * c - b * b;
  double lambda = 0;
  double xi = 0;
  if (determinant == 0) {
    xi = b != 0 ? d / b : c != 0 ? e / c : 0;
  } else {
    lambda = (b * e - c * d) / determinant;
    xi = (a * e - b * d) / determinant;
  }
  const auto inside = [](double x) { return std::clamp(x, 0.0, 1.0); };
  if (xi > 1) {
    xi = 1;
    lambda = inside((b - d) / a);
  } else if (xi < 0) {
    xi = 0;
    lambda = inside(-d / a);
  } else if (lambda < 0) {
    lambda = 0;
    xi = inside(e / c);
  } else if (lambda > 1) {
    lambda = 1;
    xi = inside((e + b) / c);
  }
  return (p0 + lambda * u - q0 - xi * v).norm();
}

/// The planner's own distance between the axes.
double fcl_distance(const Vector3& p0, const Vector3& p1, const Vector3& q0, const Vector3& q1) {
  return core::clearance(core::Body{model::Capsule{p0, p1, 0}}, core::Body{model::Capsule{q0, q1, 0}});
}

TEST(SegmentDistance, AppendixAOverestimatesWhereBothNearestPointsLieOutside) {
  // p lies on the x axis; q passes above it, rising to the right. Their lines meet at x = −7, left of both: q's parameter is clamped to its
  // left end, which is nearest to p's left end, √5 m away. But p's left end is nearer to the inside of q: 1.4/√1.04 m.
  const Vector3 p0{0, 0, 0};
  const Vector3 p1{1, 0, 0};
  const Vector3 q0{-2, 1, 0};
  const Vector3 q1{3, 2, 0};
  EXPECT_NEAR(published_distance(p0, p1, q0, q1), std::sqrt(5.0), 1e-12);
  EXPECT_NEAR(model::segment_distance(p0, p1, q0, q1), 1.4 / std::sqrt(1.04), 1e-12);
  EXPECT_NEAR(fcl_distance(p0, p1, q0, q1), 1.4 / std::sqrt(1.04), 1e-12);
}

TEST(SegmentDistance, AppendixAIsWrongForEveryTwelfthRandomPair) {
  constexpr int kPairs = 100000;
  Seed seed{71};
  int wrong = 0;
  double worst = 0;
  double worst_ours = 0;
  for (int i = 0; i < kPairs; ++i) {
    const Vector3 p0 = random_point(seed, 0.5);
    const Vector3 p1 = random_point(seed, 0.5);
    const Vector3 q0 = random_point(seed, 0.5);
    const Vector3 q1 = random_point(seed, 0.5);
    const double truth = model::segment_distance(p0, p1, q0, q1);
    const double published = published_distance(p0, p1, q0, q1);
    EXPECT_GE(published, truth - 1e-9) << "a distance between points of the segments is never below the least";
    wrong += published > truth + 1e-6 ? 1 : 0;
    worst = std::max(worst, published - truth);
    worst_ours = std::max(worst_ours, std::abs(fcl_distance(p0, p1, q0, q1) - truth));
  }
  std::printf("%d of %d pairs measured too far apart, by up to %.3f m; FCL off by at most %.2g m\n", wrong, kPairs, worst, worst_ours);
  EXPECT_NEAR(100.0 * wrong / kPairs, 8, 2);
  EXPECT_GT(worst, 0.3);
  EXPECT_LE(worst_ours, 1e-9);
}

}  // namespace
}  // namespace interlace::test
