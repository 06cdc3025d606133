#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <numeric>
#include <vector>

#include "tests/support/motions.hpp"

namespace interlace::test {
namespace {

constexpr std::size_t kMotions = 10000;
constexpr std::size_t kIntervals = 4;  // per motion
constexpr std::size_t kSamples = 64;   // per interval
constexpr double kTolerance = 1e-9;    // [m] rounding of poses
constexpr double kVisible = 1e-6;      // [m] below this a ratio says nothing
constexpr double kShort = 0.03;        // share of a motion up to which a piece is called short

/// Ratios of bound to true displacement. The mean is drawn up by bodies that happen to stay where they are; the median is what maps feel.
class Looseness {
 public:
  void add(double ratio) { ratios_.push_back(ratio); }
  void add(const Looseness& other) { ratios_.insert(ratios_.end(), other.ratios_.begin(), other.ratios_.end()); }
  [[nodiscard]] std::size_t count() const { return ratios_.size(); }
  [[nodiscard]] double mean() const { return std::accumulate(ratios_.begin(), ratios_.end(), 0.0) / static_cast<double>(ratios_.size()); }
  [[nodiscard]] double quantile(double share) const {
    std::vector<double> sorted = ratios_;
    std::sort(sorted.begin(), sorted.end());
    return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
  }

 private:
  std::vector<double> ratios_;
};

/// Share of a motion that an interval covers: from what a map's deepest cells are to the whole motion.
double random_share(Seed& seed) {
  return std::pow(10.0, seed.uniform(-3, 0));
}

class Displacement : public ::testing::Test {
 protected:
  /// Compares the bounds of random intervals with densely sampled displacements. Returns the worst excess [m].
  void check(Seed& seed, const model::Motion& motion) {
    const model::RobotModel& m = motion.robot().model;
    const model::Pose world = motion.robot().X_WB;
    for (std::size_t k = 0; k < kIntervals; ++k) {
      const double share = random_share(seed);
      const double length = motion.duration() * share;
      const double t0 = seed.uniform(0, motion.duration() - length);
      const double t1 = t0 + length;
      const double centre = seed.chance(0.8) ? (t0 + t1) / 2 : seed.uniform(t0, t1);
      std::vector<double> bound;
      motion.displacement(t0, centre, t1, bound);
      ASSERT_EQ(bound.size(), m.capsules.size());
      std::vector<model::Capsule> still;
      std::vector<model::Capsule> there;
      model::place_capsules(m, world, motion.joints(centre), still);
      std::vector<double> farthest(bound.size(), 0.0);
      for (std::size_t i = 0; i <= kSamples; ++i) {
        const double t = t0 + length * static_cast<double>(i) / kSamples;
        model::place_capsules(m, world, motion.joints(t), there);
        for (std::size_t c = 0; c < bound.size(); ++c) {
          farthest[c] = std::max({farthest[c], (there[c].a - still[c].a).norm(), (there[c].b - still[c].b).norm()});
        }
      }
      for (std::size_t c = 0; c < bound.size(); ++c) {
        worst_ = std::max(worst_, farthest[c] - bound[c]);
        EXPECT_LE(farthest[c], bound[c] + kTolerance) << m.capsules[c].name << " in [" << t0 << ", " << t1 << "] of " << motion.duration();
        if (farthest[c] > kVisible) {
          looseness_[{m.capsules[c].link, share < kShort}].add(bound[c] / farthest[c]);
        }
      }
    }
  }

  void report(const char* what) const {
    std::printf("%s: worst excess %.3g m; bound / true displacement:\n", what, worst_);
    for (const auto& [key, ratios] : looseness_) {
      std::printf("  link %zu, %-13s median %5.2f, 90 %% below %6.2f, mean %6.2f (%zu intervals)\n", key.first,
                  key.second ? "short pieces:" : "long pieces:", ratios.quantile(0.5), ratios.quantile(0.9), ratios.mean(), ratios.count());
    }
  }

  [[nodiscard]] double median_of_short_ones() const {
    Looseness all;
    for (const auto& [key, ratios] : looseness_) {
      if (key.second) all.add(ratios);
    }
    return all.quantile(0.5);
  }

  double worst_ = -1;
  std::map<std::pair<std::size_t, bool>, Looseness> looseness_;
};

/// A robot of the kind `k` asks for, with random speeds.
model::Robot random_robot(Seed& seed, std::size_t k) {
  const model::RobotModel m = k % 4 == 0 ? arm4() : k % 4 == 1 ? offset_arm() : random_arm(seed);
  model::Robot robot = robot_at("r", m, random_point(seed, 1.0), seed.uniform(-kPi, kPi));
  robot.tcp.velocity = seed.uniform(0.05, 2);
  robot.tcp.acceleration = seed.uniform(0.05, 5);
  if (seed.chance(0.5)) {
    robot.tcp.angular_velocity = seed.uniform(0.2, 3);
    robot.tcp.angular_acceleration = seed.uniform(0.2, 6);
  }
  return robot;
}

TEST_F(Displacement, OfLinearMotionsIsNeverAboveItsBound) {
  Seed seed{11};
  for (std::size_t k = 0; k < scaled(kMotions) && !HasFailure(); ++k) {
    const model::Robot robot = random_robot(seed, k);
    std::optional<model::Motion> motion;
    while (!motion) motion = try_linear(seed, robot, seed.uniform(0.05, 1.2));
    if (motion->duration() > 0) check(seed, *motion);
  }
  report("linear");
  EXPECT_LT(median_of_short_ones(), 1.8) << "the bound has become loose: maps would cost far more";
}

TEST_F(Displacement, OfJointMotionsIsNeverAboveItsBound) {
  Seed seed{12};
  for (std::size_t k = 0; k < scaled(kMotions) && !HasFailure(); ++k) {
    model::Robot robot = random_robot(seed, k);
    give_joint_rates(robot, seed.uniform(0.3, 3), seed.uniform(0.3, 10));
    check(seed, random_joint_move(seed, robot));
  }
  report("joint");
  EXPECT_LT(median_of_short_ones(), 2.0) << "the bound has become loose: maps would cost far more";
}

/// The places where the closed form loses its grip: wrist straight, elbow nearly stretched, wrist close to axis 1.
TEST_F(Displacement, HoldsNextToSingularities) {
  Seed seed{13};
  std::size_t done = 0;
  for (std::size_t k = 0; done < scaled(2000) && k < 400000 && !HasFailure(); ++k) {
    const model::Robot robot = random_robot(seed, k);
    model::Joints from = random_joints(seed, robot.model);
    const auto& p = robot.model.kinematics.parameters();
    const auto external = [&](std::size_t j, double internal) { return (internal + p.offsets[j]) * p.signs[j]; };
    const double small = std::pow(10.0, seed.uniform(-4, -1)) * (seed.chance(0.5) ? 1 : -1);
    if (k % 2 == 0) from[4] = external(4, small);
    if (k % 2 == 1) from[2] = external(2, small - std::atan2(p.a2, p.c3));
    model::Pose X_WT = robot.X_WB * model::tcp_pose(robot.model, from);
    X_WT.translation() += random_point(seed, 0.03);
    X_WT.linear() = X_WT.linear() * model::rotation_from_rpy(random_point(seed, 0.1)).toRotationMatrix();
    const auto motion = model::plan_motion(robot, from, line_to(X_WT));
    if (!motion || motion->duration() == 0) continue;
    ++done;
    check(seed, *motion);
  }
  report("near singularities");
  EXPECT_GE(done, scaled(2000) / 2);
}

}  // namespace
}  // namespace interlace::test
