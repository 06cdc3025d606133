#include "planner/core/clearance.hpp"

#include <fcl/narrowphase/distance.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "common/model/segment_distance.hpp"
#include "tests/support/arms.hpp"

namespace interlace::test {
namespace {

using model::Capsule;
using model::Vector3;

constexpr std::size_t kPairs = 1000000;
constexpr double kExact = 1e-9;           // [m] of FCL's axis distance and the independent one, at lengths up to 1 m
constexpr double kNearlyParallel = 1e-7;  // [m] likewise, next to parallel, where FCL loses digits; the maps' own rounding allowance

enum Kind { general, parallel, nearly_parallel, crossing, touching, degenerate, kinds };
constexpr const char* kNames[kinds] = {"general", "parallel", "nearly parallel", "crossing", "touching", "degenerate"};

struct Pair {
  Capsule a, b;
};

Vector3 random_direction(Seed& seed) {
  return random_rotation(seed) * Vector3::UnitX();
}

/// A pair of the kind, in random places; radii random, so clearances of both signs come up.
Pair random_pair(Seed& seed, Kind kind) {
  Pair p;
  p.a = {random_point(seed, 0.5), random_point(seed, 0.5), seed.uniform(0.001, 0.2)};
  p.b = {random_point(seed, 0.5), random_point(seed, 0.5), seed.uniform(0.001, 0.2)};
  const Vector3 along = p.a.b - p.a.a;
  switch (kind) {
    case parallel: p.b.b = p.b.a + along * seed.uniform(-2, 2); break;
    case nearly_parallel:
      p.b.b = p.b.a + along * seed.uniform(-2, 2) + random_direction(seed) * std::pow(10.0, seed.uniform(-14, -3));
      break;
    case crossing: {  // through an inner point of a
      const Vector3 through = p.a.a + along * seed.uniform(0.05, 0.95);
      const Vector3 d = random_direction(seed) * seed.uniform(0.1, 0.5);
      const double s = seed.uniform(0.1, 0.9);
      p.b.a = through - s * d;
      p.b.b = through + (1 - s) * d;
      break;
    }
    case touching: {  // the capsules' surfaces just meet: clearance zero
      const Vector3 at = p.a.a + along * seed.uniform(0, 1);
      Vector3 n = along.cross(random_direction(seed)).normalized();
      p.b.a = at + n * (p.a.radius + p.b.radius);
      p.b.b = p.b.a + (n * seed.uniform(0, 0.5) + n.cross(along).normalized() * seed.uniform(-0.5, 0.5));
      break;
    }
    case degenerate:
      p.b.b = p.b.a;
      if (seed.chance(0.3)) p.a.b = p.a.a;
      if (seed.chance(0.1)) p.b.a = p.b.b = p.a.a;
      break;
    default: break;
  }
  return p;
}

/// The axis as FCL takes it: a capsule of radius zero in a pose.
double fcl_distance(const Capsule& a, const Capsule& b) {
  const auto posed = [](const Capsule& c) {
    fcl::Transform3d X_WC = fcl::Transform3d::Identity();
    X_WC.linear() = Eigen::Quaterniond::FromTwoVectors(Vector3::UnitZ(), c.b - c.a).toRotationMatrix();
    X_WC.translation() = (c.a + c.b) / 2;
    return X_WC;
  };
  const fcl::Capsuled axis_a{0.0, (a.b - a.a).norm()};
  const fcl::Capsuled axis_b{0.0, (b.b - b.a).norm()};
  const fcl::DistanceRequestd request;
  fcl::DistanceResultd result;
  return fcl::distance(&axis_a, posed(a), &axis_b, posed(b), request, result);
}

/// Least axis distance among sampled points of both segments: never below the true one.
double sampled(const Pair& p, int steps) {
  double least = 1e9;
  for (int i = 0; i <= steps; ++i) {
    const Vector3 x = p.a.a + (p.a.b - p.a.a) * i / steps;
    for (int j = 0; j <= steps; ++j) least = std::min(least, (x - p.b.a - (p.b.b - p.b.a) * j / steps).norm());
  }
  return least;
}

TEST(Clearance, OfFclAgreesWithAnIndependentDistance) {
  Seed seed{41};
  std::size_t count[kinds] = {};
  double worst[kinds] = {};
  for (std::size_t i = 0; i < scaled(kPairs) && !HasFailure(); ++i) {
    // Shares: 40 % general, 10 % parallel, 20 % nearly parallel, 10 % each crossing, touching, degenerate.
    constexpr Kind kShares[10] = {general,         general,         general,  general,  parallel,
                                  nearly_parallel, nearly_parallel, crossing, touching, degenerate};
    const Kind kind = kShares[i % 10];
    const Pair p = random_pair(seed, kind);
    const double tolerance = kind == nearly_parallel ? kNearlyParallel : kExact;
    const core::Body a{p.a};
    const core::Body b{p.b};
    const double fcl = core::clearance(a, b);
    const double radii = p.a.radius + p.b.radius;
    const double ours = model::segment_distance(p.a.a, p.a.b, p.b.a, p.b.b) - radii;
    ++count[kind];
    worst[kind] = std::max(worst[kind], std::abs(fcl - ours));
    EXPECT_NEAR(fcl, ours, tolerance) << kNames[kind] << "\na " << p.a.a.transpose() << " – " << p.a.b.transpose() << "\nb "
                                      << p.b.a.transpose() << " – " << p.b.b.transpose();
    EXPECT_NEAR(fcl, fcl_distance(p.a, p.b) - radii, tolerance) << kNames[kind] << ": not what fcl::distance says of the same capsules";
    const double skip = core::clearance_lower_bound(a, b);
    EXPECT_LE(skip, fcl + tolerance);
    EXPECT_FALSE(core::surely_farther(a, b, skip + tolerance));
    EXPECT_TRUE(core::surely_farther(a, b, skip - tolerance));
    EXPECT_NEAR(core::clearance(b, a), fcl, tolerance);
    if (i % 100 < 10) {  // one in ten, every kind
      constexpr int kSteps = 20;
      const double coarse = ((p.a.b - p.a.a).norm() + (p.b.b - p.b.a).norm()) / (2 * kSteps);
      const double upper = sampled(p, kSteps) - radii;
      EXPECT_LE(fcl, upper + tolerance) << kNames[kind];
      EXPECT_GE(fcl, upper - coarse - tolerance) << kNames[kind];
    }
    EXPECT_TRUE(kind != touching || fcl <= tolerance) << fcl;
    EXPECT_TRUE(kind != crossing || std::abs(fcl + radii) <= tolerance) << fcl;
  }
  for (int k = 0; k < kinds; ++k) std::printf("%-15s %7zu pairs, worst difference %.3g m\n", kNames[k], count[k], worst[k]);
}

TEST(Clearance, MeetingPointLiesBetweenTheBodies) {
  Seed seed{42};
  for (std::size_t i = 0; i < scaled(20000) && !HasFailure(); ++i) {
    const Pair p = random_pair(seed, general);
    const core::Body a{p.a};
    const core::Body b{p.b};
    const Vector3 m = core::meeting_point(a, b);
    const double axes = core::clearance(a, b) + p.a.radius + p.b.radius;
    EXPECT_NEAR(model::segment_distance(m, m, p.a.a, p.a.b), axes / 2, 1e-6);
    EXPECT_NEAR(model::segment_distance(m, m, p.b.a, p.b.b), axes / 2, 1e-6);
  }
}

}  // namespace
}  // namespace interlace::test
