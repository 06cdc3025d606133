#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <vector>

#include "common/model/segment_distance.hpp"
#include "planner/core/neighbourhood.hpp"
#include "planner/core/timing_map.hpp"
#include "tests/support/motions.hpp"

/// Robots that hold something and take or leave it, against bodies that the test places itself.
namespace interlace::test {
namespace {

using core::BlockedCell;
using core::SampledMotion;
using model::Capsule;
using model::ToolSet;
using model::ToolSteps;

constexpr std::size_t kPairs = 400;
constexpr std::size_t kPostures = 2000;
constexpr double kResolution = 0.02;  // [s]
constexpr double kStep = 0.02;        // [s] of the grid that collisions are looked for on
constexpr double kLongest = 2.0;      // [s] of a motion
constexpr double kTolerance = 1e-9;   // [m] of rounding

std::vector<model::Tool> random_tools(Seed& seed) {
  std::vector<model::Tool> tools;
  for (const char* name : {"one", "two", "three"}) {
    model::Tool tool{model::ToolName{name}, {}};
    for (std::size_t k = 0; k < 1 + seed.below(2); ++k) {
      const model::Vector3 end = random_point(seed, 0.1) + model::Vector3{0, 0, seed.uniform(0.05, 0.5)};
      tool.capsules.push_back({name, 6, random_point(seed, 0.05), end, seed.uniform(0.02, 0.08)});
    }
    tools.push_back(std::move(tool));
  }
  return tools;
}

/// Two arms near each other, of the experiments or with offsets.
model::Cell random_cell(Seed& seed) {
  model::Cell cell;
  cell.name = "random";
  const bool experiment = seed.chance(0.6);
  const model::RobotModel m = experiment ? arm4() : offset_arm();
  const double apart = experiment ? seed.uniform(0.5, 1.3) : seed.uniform(0.8, 2.2);
  cell.robots = {robot_at("a", m, {0, apart / 2, 0}, seed.uniform(-kPi, kPi)),
                 robot_at("b", m, {0, -apart / 2, 0}, seed.uniform(-kPi, kPi))};
  for (model::Robot& r : cell.robots) {
    r.tcp.velocity = seed.uniform(0.2, 1.0);
    r.tcp.acceleration = seed.uniform(0.5, 3.0);
    give_joint_rates(r, 1.5, 6);
  }
  cell.tools = random_tools(seed);
  return cell;
}

ToolSet random_set(Seed& seed, const model::Cell& cell) {
  ToolSet set;
  for (std::size_t i = 0; i < cell.tools.size(); ++i) {
    if (seed.chance(0.35)) set = set | ToolSet::of(i);
  }
  return set;
}

/// Of a robot that takes something, leaves something, both or neither.
ToolSteps random_steps(Seed& seed, const model::Cell& cell) {
  const ToolSet before = random_set(seed, cell);
  const ToolSet after = seed.chance(0.3) ? before : random_set(seed, cell);
  return seed.chance(0.5) ? ToolSteps{before, after, after} : ToolSteps{before, before, after};
}

/// The robot's capsules and those of what it holds, hung on the flange by the test's own hand.
std::vector<Capsule> placed(const model::Cell& cell, model::RobotIndex robot, ToolSet held, const model::Joints& q) {
  const model::Robot& bare = cell.robots[robot];
  std::vector<Capsule> bodies;
  model::place_capsules(bare.model, bare.X_WB, q, bodies);
  const model::Pose X_WF = bare.X_WB * bare.model.kinematics.flange(q);
  for (std::size_t i = 0; i < cell.tools.size(); ++i) {
    if (!held.has(i)) continue;
    for (const auto& c : cell.tools[i].capsules) bodies.push_back({X_WF * c.a, X_WF * c.b, c.radius});
  }
  return bodies;
}

/// A motion as it will be carried out, with one posture before and one after it.
struct Dense {
  Dense(const model::Cell& cell, model::RobotIndex robot, const model::Motion& motion, const ToolSteps& steps, double phase) {
    const auto add = [&](double t, ToolSet held) {
      times.push_back(t);
      bodies.push_back(placed(cell, robot, held, motion.joints(t)));
    };
    add(-kStep, steps.at_start());
    for (double t = phase * kStep; t < motion.duration(); t += kStep) add(t, steps.during);
    add(motion.duration() + kStep, steps.at_end());
  }
  std::vector<double> times;
  std::vector<std::vector<Capsule>> bodies;
};

struct Closest {
  double clearance = 1e9;
  bool tool = false;  // one of the two bodies is a tool's
};

Closest closest(const std::vector<Capsule>& a, std::size_t own_of_a, const std::vector<Capsule>& b, std::size_t own_of_b) {
  Closest best;
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) {
      const double apart = ((a[i].a + a[i].b - b[j].a - b[j].b).norm() - (a[i].b - a[i].a).norm() - (b[j].b - b[j].a).norm()) / 2;
      if (apart > a[i].radius + b[j].radius) continue;
      const double d = model::segment_distance(a[i].a, a[i].b, b[j].a, b[j].b) - a[i].radius - b[j].radius;
      if (d < best.clearance) best = {d, i >= own_of_a || j >= own_of_b};
    }
  }
  return best;
}

model::Motion random_motion(Seed& seed, const model::Robot& robot) {
  for (;;) {
    model::Motion motion = seed.chance(0.3) ? random_joint_move(seed, robot, 1.0) : random_linear(seed, robot, 0.7);
    if (motion.duration() <= kLongest) return motion;
  }
}

TEST(Tools, NoCollisionOfADenseGridLiesInAFreeCell) {
  Seed seed{71};
  std::size_t collisions = 0;
  std::size_t with_tools = 0;
  std::size_t while_changing = 0;
  std::size_t missed = 0;
  const std::size_t pairs = std::max<std::size_t>(scaled(kPairs), 60);  // fewer may meet no tool being changed
  for (std::size_t k = 0; k < pairs && missed == 0; ++k) {
    const model::Cell cell = random_cell(seed);
    model::Bodies bodies{cell};
    const ToolSteps own_steps = random_steps(seed, cell);
    const ToolSteps other_steps = random_steps(seed, cell);
    const auto own_bodies = model::MotionBodies::of(bodies, 0, own_steps);
    const auto other_bodies = model::MotionBodies::of(bodies, 1, other_steps);
    SampledMotion own{random_motion(seed, *own_bodies.during), kResolution, own_bodies};
    SampledMotion other{random_motion(seed, *other_bodies.during), kResolution, other_bodies};
    const auto map = core::build_timing_map(own, other, 0);
    const double phase = seed.uniform(0, 1);
    const Dense a{cell, 0, own.motion(), own_steps, phase};
    const Dense b{cell, 1, other.motion(), other_steps, phase};
    std::vector<std::uint8_t> blocked(a.times.size() * b.times.size());
    for (const BlockedCell& c : map.blocked) {
      for (std::size_t i = 0; i < a.times.size(); ++i) {
        if (a.times[i] < c.tau0 || a.times[i] > c.tau1) continue;
        for (std::size_t j = 0; j < b.times.size(); ++j) {
          if (b.times[j] >= c.t0 && b.times[j] <= c.t1) blocked[i * b.times.size() + j] = 1;
        }
      }
    }
    for (std::size_t i = 1; i < a.times.size(); ++i) {  // the wait before τ = 0 is not part of a map
      for (std::size_t j = 0; j < b.times.size(); ++j) {
        const Closest c = closest(a.bodies[i], cell.robots[0].model.capsules.size(), b.bodies[j], cell.robots[1].model.capsules.size());
        if (c.clearance > 0) continue;
        ++collisions;
        with_tools += c.tool ? 1 : 0;
        const bool changing = i + 1 == a.times.size() || j == 0 || j + 1 == b.times.size();
        while_changing += c.tool && changing ? 1 : 0;
        if (blocked[i * b.times.size() + j] != 0) continue;
        ++missed;
        ADD_FAILURE() << "pair " << k << " of " << own.motion().duration() << " and " << other.motion().duration()
                      << " s: at t = " << b.times[j] << ", τ = " << a.times[i] << " the clearance is " << c.clearance;
        break;
      }
    }
  }
  std::printf("%zu collisions, %zu of them of tools, %zu of those while robots stand before or after; %zu missed\n", collisions, with_tools,
              while_changing, missed);
  EXPECT_GT(with_tools, 0U);
  EXPECT_GT(while_changing, 0U);
}

TEST(Tools, NoPointOfThemMovesFartherThanItsBound) {
  Seed seed{72};
  double tightest = 0;
  for (std::size_t k = 0; k < scaled(1000); ++k) {
    const model::Cell cell = random_cell(seed);
    model::Bodies bodies{cell};
    const model::Robot& body = bodies.of(0, cell.all_tools());
    const model::Motion motion = random_motion(seed, body);
    const double share = seed.uniform(0.005, 0.2);
    const double t0 = seed.uniform(0, 1 - share) * motion.duration();
    const double t1 = t0 + share * motion.duration();
    const double centre = (t0 + t1) / 2;
    std::vector<double> bound;
    motion.displacement(t0, centre, t1, bound);
    const auto still = placed(cell, 0, cell.all_tools(), motion.joints(centre));
    ASSERT_EQ(bound.size(), still.size());
    for (int i = 0; i <= 20; ++i) {
      const auto there = placed(cell, 0, cell.all_tools(), motion.joints(t0 + (t1 - t0) * i / 20));
      for (std::size_t c = 0; c < still.size(); ++c) {
        const double way = std::max((there[c].a - still[c].a).norm(), (there[c].b - still[c].b).norm());
        ASSERT_LE(way, bound[c] + kTolerance) << body.model.capsules[c].name << ", case " << k;
        if (c >= cell.robots[0].model.capsules.size() && bound[c] > 0) tightest = std::max(tightest, way / bound[c]);
      }
    }
  }
  std::printf("a tool used up to %.1f %% of its bound\n", 100 * tightest);
}

TEST(Tools, NoPostureTakesThemOutOfTheReachableVolume) {
  Seed seed{73};
  double farthest = 0;
  for (std::size_t k = 0; k < scaled(kPostures); ++k) {
    const model::Cell cell = random_cell(seed);
    const core::Neighbourhood neighbourhood{cell};
    const auto& volume = neighbourhood.volume(0);
    for (const Capsule& c : placed(cell, 0, random_set(seed, cell), random_joints(seed, cell.robots[0].model))) {
      const double out = std::max((c.a - volume.centre).norm(), (c.b - volume.centre).norm()) + c.radius;
      ASSERT_LE(out, volume.radius + kTolerance) << "case " << k;
      farthest = std::max(farthest, out / volume.radius);
    }
  }
  std::printf("bodies came to %.1f %% of the radius\n", 100 * farthest);
}

}  // namespace
}  // namespace interlace::test
