#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "common/model/segment_distance.hpp"
#include "planner/core/start_windows.hpp"
#include "planner/core/timing_map.hpp"
#include "tests/support/motions.hpp"

/// Maps that leave out what they are not asked for: for the shifts and times that remain they say what the whole map says, and no collision
/// that is found without any map is outside of them.
namespace interlace::test {
namespace {

using core::ForbiddenShift;
using core::SampledMotion;

constexpr std::size_t kPairs = 300;
constexpr std::size_t kSamples = 400;  // places in both motions' times where bodies are compared, of each pair
constexpr double kResolution = 0.02;   // [s]
constexpr double kRounding = 1e-9;     // [s]

bool holds(const std::vector<ForbiddenShift>& shifts, double shift) {
  return std::any_of(shifts.begin(), shifts.end(),
                     [&](const ForbiddenShift& s) { return s.first - kRounding <= shift && shift <= s.last + kRounding; });
}

bool holds(const core::TimesInTheWay& in_the_way, double t) {
  return std::any_of(in_the_way.times.begin(), in_the_way.times.end(),
                     [&](const auto& s) { return s.first - kRounding <= t && t <= s.second + kRounding; });
}

bool touch(const model::Motion& a, double ta, const model::Motion& b, double tb) {
  std::vector<model::Capsule> of_a, of_b;
  model::place_capsules(a.robot().model, a.robot().X_WB, a.joints(ta), of_a);
  model::place_capsules(b.robot().model, b.robot().X_WB, b.joints(tb), of_b);
  return std::any_of(of_a.begin(), of_a.end(), [&](const model::Capsule& x) {
    return std::any_of(of_b.begin(), of_b.end(),
                       [&](const model::Capsule& y) { return model::segment_distance(x.a, x.b, y.a, y.b) < x.radius + y.radius; });
  });
}

struct Two {
  SampledMotion commanded, moving;
};

/// Straight or by the joints, between places that the other arm reaches too.
model::Motion shared_motion(Seed& seed, const model::Robot& robot) {
  const auto place = [&] { return pose_mm(seed.uniform(300, 480), seed.uniform(-250, 250), seed.uniform(150, 380)); };
  for (;;) {
    const auto from = model::preferred_posture(robot.model, robot.X_WB.inverse() * place());
    const auto to = model::preferred_posture(robot.model, robot.X_WB.inverse() * place());
    if (!from || !to) continue;
    auto motion = seed.chance(0.2) ? model::plan_motion(robot, *from, joints_to(*to))
                                   : model::plan_motion(robot, *from, line_to(robot.X_WB * model::tcp_pose(robot.model, *to)));
    if (motion && motion->duration() > 0 && motion->duration() < 5) return std::move(*motion);
  }
}

Two random_pair(Seed& seed, std::vector<model::Robot>& robots, double speed_error) {
  for (auto& r : robots) {
    r.controller.speed_error = speed_error;
    give_joint_rates(r);
  }
  return {SampledMotion{shared_motion(seed, robots[0]), kResolution}, SampledMotion{shared_motion(seed, robots[1]), kResolution}};
}

TEST(ShiftMap, ForbidsTheShiftsOfTheWholeMap) {
  Seed seed{64};
  auto robots = experiment_cell()->robots;
  std::size_t forbidding = 0, distances = 0, whole_distances = 0;
  for (std::size_t k = 0; k < scaled(kPairs) && !HasFailure(); ++k) {
    Two two = random_pair(seed, robots, 0);
    const auto map = core::build_shift_map(two.commanded, two.moving, 0);
    const auto whole = core::build_timing_map(two.commanded, two.moving, 0);
    const auto ours = core::forbidden_shifts(map, 0, 0), all = core::forbidden_shifts(whole, 0, 0);
    ASSERT_EQ(ours.size(), all.size()) << "pair " << k;
    for (std::size_t i = 0; i < all.size(); ++i) {
      EXPECT_TRUE(ours[i].first == all[i].first || std::abs(ours[i].first - all[i].first) <= kRounding) << "pair " << k;
      EXPECT_TRUE(ours[i].last == all[i].last || std::abs(ours[i].last - all[i].last) <= kRounding) << "pair " << k;
    }
    for (const auto& s : core::forbidden_while_moving(map, 0, 0)) {
      EXPECT_TRUE(holds(core::forbidden_while_moving(whole, 0, 0), (s.first + s.last) / 2)) << "pair " << k << ": more than the whole map";
    }
    forbidding += all.empty() ? 0 : 1;
    distances += map.evaluations;
    whole_distances += whole.evaluations;
  }
  std::printf("%zu pairs that forbid, %.1f times fewer distances\n", forbidding,
              static_cast<double>(whole_distances) / static_cast<double>(std::max<std::size_t>(distances, 1)));
  EXPECT_GT(forbidding, scaled(kPairs) / 10);
  EXPECT_LT(distances, whole_distances) << "what is it for otherwise";
}

/// Whoever is slower or faster than planned, as far as the cell allows, meets nobody at a shift that is not forbidden.
TEST(ShiftMap, MissesNoCollisionHoweverDurationsErr) {
  Seed seed{65};
  auto robots = experiment_cell()->robots;
  std::size_t collisions = 0;
  for (std::size_t k = 0; k < scaled(kPairs) && !HasFailure(); ++k) {
    const double error = seed.chance(0.3) ? 0 : seed.uniform(0, 0.05);
    Two two = random_pair(seed, robots, error);
    const auto map = core::build_shift_map(two.commanded, two.moving, 0);
    const auto forbidden = core::forbidden_shifts(map, error, error), passing = core::forbidden_while_moving(map, error, error);
    const auto way = core::times_in_the_way(two.commanded, two.moving, 0), coarse = core::times_in_the_way(two.commanded, two.moving, 0, 2);
    const model::Motion &own = two.commanded.motion(), &other = two.moving.motion();
    for (std::size_t i = 0; i < kSamples; ++i) {
      const double tau = seed.uniform(0, own.duration()), t = seed.uniform(0, other.duration());
      if (!touch(own, tau, other, t)) continue;
      ++collisions;
      const double shift = t * (1 + seed.uniform(-error, error)) - tau * (1 + seed.uniform(-error, error));
      EXPECT_TRUE(holds(forbidden, shift)) << "pair " << k << ", shift " << shift;
      EXPECT_TRUE(holds(passing, shift)) << "pair " << k << ", shift " << shift;
      EXPECT_TRUE(holds(way, t)) << "pair " << k << ", time " << t;
      EXPECT_TRUE(holds(coarse, t)) << "pair " << k << ", time " << t;
    }
    const auto clear = way.first_clear(other.duration()), later = coarse.first_clear(other.duration());
    EXPECT_TRUE(!later || (clear && *clear <= *later + kRounding))
        << "pair " << k << ": coarser is not sooner clear, " << clear.value_or(-1) << " and " << later.value_or(-1);
  }
  std::printf("%zu collisions\n", collisions);
  EXPECT_GT(collisions, 5 * scaled(kPairs));
}

}  // namespace
}  // namespace interlace::test
