#include "common/model/kinematics.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <kdl/chain.hpp>
#include <kdl/chainfksolverpos_recursive.hpp>

#include "tests/support/arms.hpp"

namespace interlace::test {
namespace {

using model::Branch;
using model::Joints;
using model::Kinematics;
using model::OpwParameters;
using model::Pose;

constexpr std::size_t kVectors = 1000000;
constexpr double kPosition = 1e-9;       // [m]
constexpr double kAngle = 1e-9;          // [rad]
constexpr double kSingular = 1e-3;       // neighbourhood tested by itself: |sin q5|, |sin| of the elbow's bend, [m] wrist to axis 1
constexpr double kSingularError = 1e-9;  // [m], [rad] of forward(inverse(X)) inside that neighbourhood

Joints any_joints(Seed& seed) {
  Joints q;
  for (std::size_t i = 0; i < model::kJoints; ++i) q[i] = seed.uniform(-kPi, kPi);
  return q;
}

double position_error(const Pose& a, const Pose& b) {
  return (a.translation() - b.translation()).norm();
}

/// Angle between two rotations, exact for small ones where acos of the trace is not [rad].
double rotation_error(const Pose& a, const Pose& b) {
  return (a.linear() - b.linear()).norm() / std::sqrt(2.0);
}

double angle_error(const Joints& a, const Joints& b) {
  double worst = 0;
  for (std::size_t i = 0; i < model::kJoints; ++i) worst = std::max(worst, std::abs(model::nearest_turn(a[i] - b[i], 0)));
  return worst;
}

/// How far `q` is from each of the three singularities, the least of them.
double distance_to_singularity(const Kinematics& k, const Joints& q) {
  const auto X = k.forward(q);
  const auto& p = k.parameters();
  const model::Vector3 p_BW = X[4].translation();
  const double wrist = X[4].linear().col(2).cross(X[6].linear().col(2)).norm();
  const double radial2 = p_BW.x() * p_BW.x() + p_BW.y() * p_BW.y() - p.b * p.b;
  const double radial = std::sqrt(std::max(radial2, 0.0));
  const double bend = (q[2] * p.signs[2] - p.offsets[2]) + std::atan2(p.a2, p.c3);
  return std::min({wrist, radial, std::abs(std::sin(bend))});
}

struct RoundTrip {
  double worst_position = 0, worst_rotation = 0, worst_joint = 0;
  std::size_t branches = 0, vectors = 0, singular = 0;

  void check(const Kinematics& k, const Joints& q) {
    ++vectors;
    const Pose X = k.flange(q);
    const bool singular_here = distance_to_singularity(k, q) < kSingular;
    singular += singular_here ? 1 : 0;
    double nearest = 10;
    for (const Branch& branch : model::all_branches()) {
      const auto found = k.inverse(X, branch);
      if (!found) continue;
      ++branches;
      const Pose back = k.flange(*found);
      worst_position = std::max(worst_position, position_error(back, X));
      worst_rotation = std::max(worst_rotation, rotation_error(back, X));
      nearest = std::min(nearest, angle_error(*found, q));
    }
    if (!singular_here) worst_joint = std::max(worst_joint, nearest);
  }

  void expect_exact(const char* name) const {
    std::printf("%s: %zu vectors, %.2f branches each, %zu near a singularity; worst %.3g m, %.3g rad, joints %.3g rad\n", name, vectors,
                static_cast<double>(branches) / static_cast<double>(vectors), singular, worst_position, worst_rotation, worst_joint);
    EXPECT_LE(worst_position, kPosition) << name;
    EXPECT_LE(worst_rotation, kAngle) << name;
    EXPECT_LE(worst_joint, kAngle) << name << ": the posture itself is not among its branches";
    EXPECT_LE(singular, vectors / 50 + 1) << name << ": the singular neighbourhood hides too many cases";
  }
};

TEST(Kinematics, RoundTripOfTheDissertationsArm) {
  Seed seed{21};
  const Kinematics k = arm4().kinematics;
  RoundTrip trip;
  for (std::size_t i = 0; i < scaled(kVectors); ++i) trip.check(k, any_joints(seed));
  trip.expect_exact("dissertation's arm");
}

TEST(Kinematics, RoundTripOfAnArmWithOffsets) {
  Seed seed{22};
  const Kinematics k{offset_arm_parameters()};
  RoundTrip trip;
  for (std::size_t i = 0; i < scaled(kVectors); ++i) trip.check(k, any_joints(seed));
  trip.expect_exact("offset arm");
}

TEST(Kinematics, RoundTripOfArmsOfAnyProportions) {
  Seed seed{23};
  RoundTrip trip;
  for (std::size_t i = 0; i < scaled(kVectors); ++i) trip.check(Kinematics{random_parameters(seed)}, any_joints(seed));
  trip.expect_exact("random arms");
}

/// The frames found without any angle are those of the joints that the inverse finds.
TEST(Kinematics, FramesAreThoseOfTheInverse) {
  constexpr double kAgreement = 1e-11;  // [m] and of rotation elements, times what the nearest singularity makes of rounding
  Seed seed{26};
  double worst = 0;
  std::size_t compared = 0;
  for (std::size_t i = 0; i < scaled(100000); ++i) {
    const OpwParameters p = i % 3 == 0 ? arm4().kinematics.parameters() : i % 3 == 1 ? offset_arm_parameters() : random_parameters(seed);
    const Kinematics k{p};
    const Pose X = k.flange(any_joints(seed));
    for (const auto& branch : model::all_branches()) {
      const auto q = k.inverse(X, branch);
      model::LinkFrames frames;
      ASSERT_EQ(k.frames(X, branch, frames), q.has_value());
      if (!q) continue;
      const auto expected = k.forward(*q);
      const double wrist_sine = expected[4].linear().col(2).cross(X.linear().col(2)).norm();
      const model::Vector3 forearm = (expected[4].translation() - expected[3].translation()) / k.forearm_length();
      const double elbow_sine = forearm.cross(expected[2].linear().col(2)).norm();
      const double condition = std::min({1.0, wrist_sine, elbow_sine, std::abs(k.triangle(k.wrist_centre(X), branch.shoulder)->radial),
                                         k.triangle(k.wrist_centre(X), branch.shoulder)->distance});
      for (std::size_t link = 0; link < expected.size(); ++link) {
        const double off = (frames[link].matrix() - expected[link].matrix()).cwiseAbs().maxCoeff();
        worst = std::max(worst, off * condition);
        ASSERT_LE(off * condition, kAgreement) << "link " << link << ", case " << i;
      }
      ++compared;
    }
  }
  std::printf("%zu postures, worst element times condition %.3g\n", compared, worst);
}

/// In the neighbourhood of a singularity, and on it, the joints are not unique but the pose they give is.
TEST(Kinematics, InverseNextToSingularitiesStillReachesThePose) {
  Seed seed{24};
  double worst_position = 0;
  double worst_rotation = 0;
  std::size_t own_branch_missing[4] = {};
  const std::size_t count = scaled(100000);
  for (std::size_t i = 0; i < count; ++i) {
    const OpwParameters p = i % 3 == 0 ? arm4().kinematics.parameters() : i % 3 == 1 ? offset_arm_parameters() : random_parameters(seed);
    const Kinematics k{p};
    const auto external = [&p](std::size_t j, double internal) { return (internal + p.offsets[j]) * p.signs[j]; };
    const double off = seed.chance(0.2) ? 0.0 : std::pow(10.0, seed.uniform(-16, -4)) * (seed.chance(0.5) ? 1 : -1);
    const double half_turn = seed.chance(0.5) ? kPi : 0;
    Joints q = any_joints(seed);
    const std::size_t kind = i % 4;
    if (kind == 0 || kind == 3) q[4] = external(4, off + half_turn);                           // wrist straight
    if (kind == 1 || kind == 3) q[2] = external(2, off + half_turn - std::atan2(p.a2, p.c3));  // arm stretched or folded
    if (kind == 2) {  // wrist on axis 1, or at the offset b from it: solve a1 + c2·sin(q2) + k·sin(q2 + bend) = off for q2
      const double bend = seed.uniform(-kPi, kPi);
      const double x = p.c2 + k.forearm_length() * std::cos(bend);
      const double y = k.forearm_length() * std::sin(bend);
      const double s = (off - p.a1) / std::hypot(x, y);
      if (std::abs(s) > 1) continue;
      q[1] = external(1, std::asin(s) - std::atan2(y, x));
      q[2] = external(2, bend - std::atan2(p.a2, p.c3));
    }
    const Pose X = k.flange(q);
    bool any = false;
    for (const Branch& branch : model::all_branches()) {
      const auto found = k.inverse(X, branch);
      if (!found) continue;
      any = true;
      worst_position = std::max(worst_position, position_error(k.flange(*found), X));
      worst_rotation = std::max(worst_rotation, rotation_error(k.flange(*found), X));
    }
    own_branch_missing[kind] += any ? 0 : 1;
  }
  std::printf("%zu singular postures: worst %.3g m, %.3g rad; without any solution %zu %zu %zu %zu\n", count, worst_position,
              worst_rotation, own_branch_missing[0], own_branch_missing[1], own_branch_missing[2], own_branch_missing[3]);
  EXPECT_LE(worst_position, kSingularError);
  EXPECT_LE(worst_rotation, kSingularError);
  for (const std::size_t missing : own_branch_missing) EXPECT_EQ(missing, 0U);
}

/// The same arm as a chain of KDL's segments: rotation about a joint's axis, then the step to the next.
KDL::Chain kdl_chain(const OpwParameters& p) {
  using KDL::Frame;
  using KDL::Joint;
  using KDL::Segment;
  using KDL::Vector;
  KDL::Chain chain;
  chain.addSegment(Segment{Joint{Joint::RotZ}, Frame{Vector{p.a1, 0, p.c1}}});
  chain.addSegment(Segment{Joint{Joint::RotY}, Frame{Vector{0, p.b, p.c2}}});
  chain.addSegment(Segment{Joint{Joint::RotY}, Frame{Vector{p.a2, 0, p.c3}}});
  chain.addSegment(Segment{Joint{Joint::RotZ}, Frame::Identity()});
  chain.addSegment(Segment{Joint{Joint::RotY}, Frame{Vector{0, 0, p.c4}}});
  chain.addSegment(Segment{Joint{Joint::RotZ}, Frame::Identity()});
  return chain;
}

TEST(Kinematics, ForwardAgreesWithKdl) {
  constexpr std::size_t kKdlVectors = 200000;
  Seed seed{25};
  double worst = 0;
  for (std::size_t i = 0; i < scaled(kKdlVectors); ++i) {
    const OpwParameters p = i % 3 == 0 ? arm4().kinematics.parameters() : i % 3 == 1 ? offset_arm_parameters() : random_parameters(seed);
    const KDL::Chain chain = kdl_chain(p);
    KDL::ChainFkSolverPos_recursive solver{chain};
    const Joints q = any_joints(seed);
    KDL::JntArray internal{6};
    for (unsigned j = 0; j < 6; ++j) internal(j) = q[j] * p.signs[j] - p.offsets[j];
    KDL::Frame theirs;
    ASSERT_GE(solver.JntToCart(internal, theirs), 0);
    const Pose ours = Kinematics{p}.flange(q);
    for (int row = 0; row < 3; ++row) {
      worst = std::max(worst, std::abs(ours.translation()[row] - theirs.p(row)));
      for (int column = 0; column < 3; ++column) worst = std::max(worst, std::abs(ours.linear()(row, column) - theirs.M(row, column)));
    }
  }
  std::printf("%zu vectors against KDL: worst element %.3g\n", scaled(kKdlVectors), worst);
  EXPECT_LE(worst, 1e-12);
}

}  // namespace
}  // namespace interlace::test
