#include "simulator/trace_check.hpp"

#include <gtest/gtest.h>

#include "common/model/fixture_distance.hpp"
#include "common/model/segment_distance.hpp"
#include "monitor/clearance_observer.hpp"
#include "tests/support/arms.hpp"
#include "tests/support/fixtures.hpp"
#include "tests/support/motions.hpp"
#include "tests/unit/simulator/cells.hpp"

namespace interlace::sim {
namespace {

using model::Joints;
using Trace = std::vector<std::vector<Joints>>;

constexpr double kStep = 0.001;  // [s]

/// Robots that go from one random posture to the next in small steps, some of them standing in between.
Trace wander(test::Seed& seed, const model::Cell& cell, std::size_t legs) {
  Trace trace;
  std::vector<Joints> now;
  for (const auto& robot : cell.robots) now.push_back(robot.start);
  // The observer's first step has only the robots it heard of until then, and its own clock may lag a step behind at the end.
  trace.resize(2, now);
  for (std::size_t leg = 0; leg < legs; ++leg) {
    std::vector<Joints> next = now;
    for (auto& q : next) {
      if (seed.chance(0.3)) continue;
      for (double& angle : q) angle += seed.uniform(-1, 1);
    }
    const int steps = 200;
    for (int k = 1; k <= steps; ++k) {
      auto& row = trace.emplace_back(now);
      for (std::size_t i = 0; i < row.size(); ++i) row[i] += k / static_cast<double>(steps) * (next[i] - now[i]);
    }
    now = next;
  }
  trace.resize(trace.size() + 2, now);
  return trace;
}

struct Judged {
  double least = 1e9;
  std::size_t collisions = 0;
};

/// Every pair, and every robot and fixture, measured at every step.
Judged measured_throughout(const model::Cell& cell, const Trace& trace) {
  Judged judged;
  std::vector<std::vector<model::Capsule>> bodies(cell.robots.size());
  std::vector<bool> touching(cell.robots.size() * cell.robots.size());
  std::vector<bool> at_fixture(cell.robots.size() * cell.fixtures.size());
  for (const auto& row : trace) {
    for (std::size_t i = 0; i < row.size(); ++i) model::place_capsules(cell.robots[i].model, cell.robots[i].X_WB, row[i], bodies[i]);
    for (std::size_t i = 0; i < row.size(); ++i) {
      for (std::size_t j = i + 1; j < row.size(); ++j) {
        double least = 1e9;
        for (const auto& a : bodies[i]) {
          for (const auto& b : bodies[j]) least = std::min(least, model::segment_distance(a.a, a.b, b.a, b.b) - a.radius - b.radius);
        }
        auto was = touching[i * row.size() + j];
        if (least <= 0 && !was) ++judged.collisions;
        touching[i * row.size() + j] = least <= 0;
        judged.least = std::min(judged.least, least);
      }
      for (std::size_t f = 0; f < cell.fixtures.size(); ++f) {
        double least = 1e9;
        for (std::size_t k = 0; k < bodies[i].size(); ++k) {
          if (cell.robots[i].model.capsules[k].link == 0) continue;
          const double far = model::clearance_lower_bound(bodies[i][k], cell.fixtures[f]);
          if (far <= 0 || far < judged.least) least = std::min(least, model::clearance(bodies[i][k], cell.fixtures[f]));
        }
        auto was = at_fixture[i * cell.fixtures.size() + f];
        if (least <= 0 && !was) ++judged.collisions;
        at_fixture[i * cell.fixtures.size() + f] = least <= 0;
        judged.least = std::min(judged.least, least);
      }
    }
  }
  return judged;
}

void expect_agreement(const model::Cell& cell, const Trace& trace) {
  TraceCheck check{cell};
  monitor::ClearanceObserver observer{cell, kStep, 1e9};
  for (std::size_t k = 0; k < trace.size(); ++k) {
    const double t = kStep * static_cast<double>(k);
    check.step(t, trace[k]);
    for (std::size_t i = 0; i < trace[k].size(); ++i) observer.on_posture(i, t, trace[k][i]);
  }
  const Judged truth = measured_throughout(cell, trace);
  const double rounding = 1e-9;  // [m] of two ways to compute one distance
  const double tolerance = cell.fixtures.empty() ? rounding : FixtureCheck::kAccuracy;
  EXPECT_NEAR(check.least().clearance, truth.least, tolerance);
  EXPECT_EQ(check.collisions(), truth.collisions);
  ASSERT_TRUE(observer.least_clearance());
  EXPECT_NEAR(*observer.least_clearance(), truth.least, 1e-6);  // its postures are interpolated, and a step's time is a sum
  EXPECT_EQ(observer.contacts(), truth.collisions);
  EXPECT_EQ(check.steps(), trace.size());
  std::size_t pairs = trace.front().size() * (trace.front().size() - 1) / 2;
  for (const auto& robot : cell.robots) pairs += robot.model.capsules.size() * cell.fixtures.size();
  EXPECT_LT(check.measured(), pairs * trace.size()) << "no work was left out";
}

TEST(TraceCheck, LeavesOutNothingThatMatters) {
  test::Seed seed{31};
  for (const char* name :
       {"exp-4-2", "exp-6-1", "pattern-square-4", "pattern-ring-5", "pattern-serial-8", "fixtures-square-4", "fixtures-serial-4"}) {
    SCOPED_TRACE(name);
    const auto cell = test::deployed_cell(name);
    for (std::size_t k = 0; k < test::scaled(5); ++k) expect_agreement(*cell, wander(seed, *cell, 10));
  }
}

TEST(TraceCheck, LeavesOutNothingThatMattersForArmsOfAnyKind) {
  test::Seed seed{32};
  for (std::size_t k = 0; k < test::scaled(40); ++k) {
    model::Cell cell;
    for (int i = 0; i < 3; ++i) {
      const auto arm = seed.chance(0.2) ? test::offset_arm() : test::random_arm(seed);
      cell.robots.push_back(test::robot_at("r" + std::to_string(i), arm, {1.2 * i, seed.uniform(-0.5, 0.5), 0}, seed.uniform(-3, 3)));
      cell.robots.back().start = test::random_joints(seed, arm);
    }
    expect_agreement(cell, wander(seed, cell, 10));
  }
}

TEST(TraceCheck, LeavesOutNothingThatMattersAmongFixturesOfAnyKind) {
  test::Seed seed{33};
  for (std::size_t k = 0; k < test::scaled(10); ++k) {
    model::Cell cell;
    for (int i = 0; i < 2; ++i) {
      const auto arm = seed.chance(0.2) ? test::offset_arm() : test::random_arm(seed);
      cell.robots.push_back(test::robot_at("r" + std::to_string(i), arm, {1.2 * i, seed.uniform(-0.5, 0.5), 0}, seed.uniform(-3, 3)));
      cell.robots.back().start = test::random_joints(seed, arm);
    }
    for (int type = 0; type < test::kFixtureTypes; ++type) cell.fixtures.push_back(test::random_fixture(seed, type, 1.5));
    expect_agreement(cell, wander(seed, cell, 5));
  }
}

TEST(TraceCheck, NamesTheFixtureThatIsTouched) {
  const auto cell = test::deployed_cell("fixtures-square-4");
  std::vector<Joints> row;
  for (const auto& robot : cell->robots) row.push_back(robot.start);
  TraceCheck check{*cell};
  monitor::ClearanceObserver observer{*cell, kStep, 1e9};
  const auto show = [&](std::size_t k) {
    const double t = kStep * static_cast<double>(k);
    check.step(t, row);
    for (std::size_t i = 0; i < row.size(); ++i) observer.on_posture(i, t, row[i]);
  };
  for (std::size_t k = 0; k < 10; ++k) show(k);
  EXPECT_EQ(check.collisions(), 0U);
  const auto& robot = cell->robots[0];
  row[0] = model::preferred_posture(robot.model, robot.X_WB.inverse() * test::pose_mm(320, 120, 110)).value();
  for (std::size_t k = 10; k < 20; ++k) show(k);
  EXPECT_EQ(check.collisions(), 1U);
  EXPECT_EQ(check.fixture_contacts(), 1U);
  EXPECT_EQ(check.least().link_b, "fixture table");
  EXPECT_LT(check.least().clearance, 0);
  EXPECT_EQ(observer.contacts(), 1U);
  const auto touched = observer.fixtures().report();
  ASSERT_EQ(touched.size(), 1U);
  EXPECT_EQ(touched.front().robot.str(), "r1");
  EXPECT_EQ(touched.front().fixture, "table");
  EXPECT_EQ(touched.front().count, 1U);
  EXPECT_LT(touched.front().clearance, 0);
  EXPECT_NEAR(touched.front().at, 0.010, 2 * kStep);
}

TEST(TraceCheck, FindsAPlantedCollision) {
  const auto cell = test::deployed_cell("exp-4-2");
  Trace trace(100, {cell->robots[0].start, cell->robots[1].start});
  // For one millisecond both hands are where r1 and r2 meet.
  for (std::size_t i = 0; i < 2; ++i) {
    const auto& robot = cell->robots[i];
    trace[50][i] = model::preferred_posture(robot.model, robot.X_WB.inverse() * test::pose_mm(350, 0, 200)).value();
  }
  TraceCheck check{*cell};
  for (std::size_t k = 0; k < 50; ++k) check.step(kStep * static_cast<double>(k), trace[k]);
  EXPECT_EQ(check.collisions(), 0U);
  EXPECT_GT(check.least().clearance, 0);
  for (std::size_t k = 50; k < 100; ++k) check.step(kStep * static_cast<double>(k), trace[k]);
  EXPECT_EQ(check.collisions(), 1U);
  EXPECT_DOUBLE_EQ(check.least().t, 0.050);
  EXPECT_NEAR(check.least().clearance, -0.200, 1e-6) << "the forearms' axes meet: both radii deep";
  EXPECT_EQ(check.least().link_a, "link2");
  EXPECT_EQ(check.least().link_b, "link2");
  EXPECT_LE(check.measured(), 4U) << "standing robots are not measured again";
}

TEST(TraceCheck, AndTheObserverSeeWhatIsHeld) {
  auto cell = *test::deployed_cell("exp-4-2");
  cell.tools = {
      {model::ToolName{"pole"},
       {{"pole", 6, {0, 0, 0}, {0.6, 0, 0}, 0.02}, {"pole", 6, {0, 0, 0}, {0, 0.6, 0}, 0.02}, {"pole", 6, {0, 0, 0}, {0, -0.6, 0}, 0.02}}}};
  TraceCheck check{cell};
  monitor::ClearanceObserver observer{cell, kStep, 1e9};
  const std::vector<Joints> standing{cell.robots[0].start, cell.robots[1].start};
  const auto pole = model::ToolSet::of(0);
  for (std::size_t k = 0; k < 30; ++k) {
    const double t = kStep * static_cast<double>(k);
    const bool held = k >= 10 && k < 20;
    if (k == 10 || k == 20) check.hold(0, held ? pole : model::ToolSet{});
    check.step(t, standing);
    for (std::size_t i = 0; i < 2; ++i) observer.on_posture(i, t, standing[i], i == 0 && held ? pole : model::ToolSet{});
  }
  EXPECT_EQ(check.collisions(), 1U);
  EXPECT_EQ(check.least().link_a, "pole");
  EXPECT_DOUBLE_EQ(check.least().t, 0.010);
  EXPECT_EQ(observer.contacts(), 1U);
  EXPECT_EQ(observer.least()->link_a, "pole");
  EXPECT_NEAR(observer.least()->least, check.least().clearance, 1e-9);
  EXPECT_GT(check.least().clearance, -0.3);
}

}  // namespace
}  // namespace interlace::sim
