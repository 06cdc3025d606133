#include "planner/core/untangle.hpp"

#include <gtest/gtest.h>

#include "tests/support/turnstile.hpp"

/// The order in which robots that stand in each other's way come apart.
namespace interlace::test {
namespace {

using core::EscapeView;
using core::UntangleStep;
using model::EscapeWay;

/// Robots that stand, what they know of their past, and the search on them.
struct Tangle {
  explicit Tangle(std::shared_ptr<model::Cell> its_cell)
      : cell(std::move(its_cell)), neighbourhood(*cell), strategy(core::make_strategy("event", *cell)), maps(cell->planning.margin, {}) {
    for (model::RobotIndex i = 0; i < cell->robots.size(); ++i) stand(i, cell->robots[i].start);
  }

  void stand(model::RobotIndex i, const model::Joints& q) {
    if (views.size() <= i) views.resize(i + 1);
    core::Neighbour n;
    n.robot = i;
    n.motion = std::make_shared<core::SampledMotion>(model::Motion::rest(cell->robots[i], q), cell->planning.resolution);
    views[i].seen = {n};
  }

  std::optional<std::vector<UntangleStep>> search(model::RobotIndex robot, const model::MotionRequest& request) {
    const auto& from = views[robot].motion()->motion().to();
    auto motion = core::admit(*cell, robot, cell->robots[robot], from, request);
    EXPECT_TRUE(motion);
    if (!motion) return std::nullopt;
    return core::untangle(*cell, neighbourhood, views, neighbourhood.around(robot), {robot, *motion, {}}, request, *strategy, {}, maps);
  }

  /// Carries the steps out one by one: each must be clear of all that stand, and in the end so must `request`.
  void expect_carried_out(const std::vector<UntangleStep>& steps, model::RobotIndex robot, const model::MotionRequest& request) {
    const auto go = [&](model::RobotIndex i, const model::MotionRequest& what) {
      auto motion = core::admit(*cell, i, cell->robots[i], views[i].motion()->motion().to(), what);
      ASSERT_TRUE(motion) << motion.error().text;
      for (model::RobotIndex other = 0; other < views.size(); ++other) {
        if (other == i) continue;
        EXPECT_TRUE(maps.get(*motion, views[other].motion()).map.blocked.empty()) << "robot " << i << " meets robot " << other;
      }
      stand(i, (*motion)->motion().to());
    };
    for (const UntangleStep& step : steps) go(step.robot, step.request);
    go(robot, request);
  }

  std::shared_ptr<model::Cell> cell;
  core::Neighbourhood neighbourhood;
  std::unique_ptr<core::Strategy> strategy;
  core::MapStore maps;
  std::vector<EscapeView> views;
};

TEST(Untangle, ARetreatIsOneStep) {
  const Turnstile t{0.5};
  Tangle tangle{t.cell};
  tangle.stand(1, t.in_the_way);
  tangle.views[1].trail = {joints_to(t.aside)};
  const auto steps = tangle.search(0, Turnstile::across());
  ASSERT_TRUE(steps);
  ASSERT_EQ(steps->size(), 1U);
  EXPECT_EQ(steps->front().robot, 1U);
  EXPECT_EQ(steps->front().way, EscapeWay::retreat);
  tangle.expect_carried_out(*steps, 0, Turnstile::across());
}

TEST(Untangle, NothingIsFoundWhereTheRobotCannotBeSentAnywhere) {
  const Turnstile t{0.5};
  Tangle tangle{t.cell};
  tangle.stand(1, t.in_the_way);
  EXPECT_FALSE(tangle.search(0, Turnstile::across())) << "no past, no home: it can turn, but nobody knows where to";
  tangle.views[1].trail = {joints_to(t.aside)};
  tangle.views[1].immovable = "it is not heard from";
  EXPECT_FALSE(tangle.search(0, Turnstile::across()));
}

TEST(Untangle, WhoeverIsInTheWayOfTheOneInTheWayLeavesFirst) {
  const Turnstile t{0.5};
  t.cell->robots[2] = experiment_robot("r3", {0, -0.75, 0}, pose_mm(450, -750, 300));
  Tangle tangle{t.cell};
  tangle.stand(1, t.in_the_way);
  tangle.views[1].trail = {joints_to(t.aside)};
  // r3's hand is where r2's hand would go back to.
  const model::Robot& r3 = t.cell->robots[2];
  const auto there = core::admit(*t.cell, 2, t.cell->robots[2], r3.start, line_to(pose_mm(345, -560, 300)));
  ASSERT_TRUE(there) << there.error().text;
  tangle.stand(2, (*there)->motion().to());
  tangle.views[2].immovable = "its controller is not ready";
  EXPECT_FALSE(tangle.search(0, Turnstile::across())) << "r2 would go back through r3";
  tangle.views[2].immovable.clear();
  tangle.views[2].home = {line_to(pose_mm(450, -750, 300))};
  const auto steps = tangle.search(0, Turnstile::across());
  ASSERT_TRUE(steps);
  ASSERT_EQ(steps->size(), 2U);
  EXPECT_EQ((*steps)[0].robot, 2U);
  EXPECT_EQ((*steps)[0].way, EscapeWay::home);
  EXPECT_EQ((*steps)[1].robot, 1U);
  EXPECT_EQ((*steps)[1].way, EscapeWay::retreat);
  tangle.expect_carried_out(*steps, 0, Turnstile::across());
}

}  // namespace
}  // namespace interlace::test
