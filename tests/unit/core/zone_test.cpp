#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "planner/core/shared_zone.hpp"
#include "tests/support/motions.hpp"
#include "tests/unit/core/desk.hpp"

/// Zone blocking: where the zone is, when a motion is in it, and who holds its token.
namespace interlace::test {
namespace {

using core::SampledMotion;
using core::SharedZone;
using core::ZoneVisit;
using model::ExecutionState;

// ---- the zone

ZoneVisit visit(const SharedZone& zone, const model::Cell& cell, model::RobotIndex robot, const model::Joints& from,
                const model::MotionRequest& request) {
  SampledMotion motion{model::plan_motion(cell.robots[robot], from, request).value(), cell.planning.resolution};
  return zone.visit(robot, motion);
}

bool stands_in(const SharedZone& zone, const model::Cell& cell, model::RobotIndex robot, const model::Joints& q) {
  SampledMotion standing{model::Motion::rest(cell.robots[robot], q), cell.planning.resolution};
  const ZoneVisit v = zone.visit(robot, standing);
  EXPECT_EQ(v.enters, v.from_start);
  EXPECT_EQ(v.enters, v.to_end);
  return v.enters;
}

TEST(SharedZone, LeavesOutTheHomesAndMotionsInTheirPlane) {
  const auto cell = experiment_cell(true);
  const SharedZone zone{*cell};
  for (model::RobotIndex i = 0; i < 3; ++i) EXPECT_FALSE(stands_in(zone, *cell, i, cell->robots[i].home));
  EXPECT_FALSE(visit(zone, *cell, 0, cell->robots[0].start, r1_aside()).enters);
  EXPECT_FALSE(visit(zone, *cell, 1, cell->robots[1].start, r2_aside()).enters);
  EXPECT_TRUE(zone.within_reach_of(0));
  EXPECT_FALSE(zone.within_reach_of(2)) << "5 m away";
}

TEST(SharedZone, IsEnteredAndLeftInTheMiddleOfMotions) {
  const auto cell = experiment_cell();
  const SharedZone zone{*cell};
  const auto in = model::plan_motion(cell->robots[0], cell->robots[0].start, to_centre()).value();
  const auto entering = visit(zone, *cell, 0, cell->robots[0].start, to_centre());
  EXPECT_TRUE(entering.enters);
  EXPECT_FALSE(entering.from_start);
  EXPECT_TRUE(entering.to_end);
  EXPECT_GT(entering.entered, 0.1);
  EXPECT_NEAR(entering.left, in.duration(), 1e-9);
  EXPECT_TRUE(stands_in(zone, *cell, 0, in.to()));
  const auto leaving = visit(zone, *cell, 0, in.to(), line_to(pose_mm(450, 400, 300)));
  EXPECT_TRUE(leaving.enters);
  EXPECT_TRUE(leaving.from_start);
  EXPECT_FALSE(leaving.to_end);
  EXPECT_EQ(leaving.entered, 0);
  EXPECT_LT(leaving.left, model::plan_motion(cell->robots[0], in.to(), line_to(pose_mm(450, 400, 300))).value().duration() - 0.5);
}

TEST(SharedZone, OfARowKeepsEveryHomeOut) {
  model::Cell cell;
  for (const double y : {0.75, 0.25, -0.25, -0.75}) {
    cell.robots.push_back(experiment_robot("r" + std::to_string(cell.robots.size() + 1), {0, y, 0}, pose_mm(450, 1e3 * y, 300)));
  }
  const SharedZone zone{cell};
  for (model::RobotIndex i = 0; i < 4; ++i) EXPECT_FALSE(stands_in(zone, cell, i, cell.robots[i].home)) << i;
}

TEST(SharedZone, DividesHomesThatTheLineOfTheirBasesDoesNot) {
  // r3 opposite the two: its hand at home lies between theirs, 16 mm from each.
  auto cell = experiment_cell();
  cell->robots.push_back(experiment_robot("r3", {0.6, 0, 0}, pose_mm(150, 0, 300, 0, 0, 180), kPi));
  const SharedZone zone{*cell};
  for (model::RobotIndex i = 0; i < 3; ++i) EXPECT_FALSE(stands_in(zone, *cell, i, cell->robots[i].home)) << i;
}

TEST(SharedZone, OfTheFileIsThatBox) {
  auto cell = experiment_cell();
  cell->planning.zone = model::Box{{0.3, -0.05, 0.1}, {0.4, 0.05, 0.3}};
  const SharedZone zone{*cell};
  EXPECT_TRUE(visit(zone, *cell, 0, cell->robots[0].start, to_centre()).to_end);
  EXPECT_FALSE(visit(zone, *cell, 0, cell->robots[0].start, line_to(pose_mm(450, 200, 300))).enters) << "in the made zone, not in the box";
  EXPECT_TRUE(zone.within_reach_of(0));
  cell->planning.zone = model::Box{{3, 3, 3}, {4, 4, 4}};
  EXPECT_FALSE(SharedZone{*cell}.within_reach_of(0));
}

/// 300 random motions of r1, each at 500 times against the zone's definition written for this cell (r1's side ends 128 mm from the middle,
/// as far as r2 reaches): a body that is in the zone by more than a nanometre is so only between `entered` and `left`.
TEST(SharedZone, VisitsMissNothing) {
  Seed seed{31};
  const auto cell = experiment_cell();
  const SharedZone zone{*cell};
  const model::Robot& r1 = cell->robots[0];
  const model::Vector3 shoulder2{0, -0.25, 0.29};
  std::size_t inside = 0, partly = 0;
  for (int i = 0; i < 300; ++i) {
    SampledMotion motion{random_linear(seed, r1), 0.01};
    const double duration = motion.motion().duration();
    const ZoneVisit v = zone.visit(0, motion);
    partly += v.enters && !(v.from_start && v.to_end) ? 1 : 0;
    for (int k = 0; k < 500; ++k) {
      const double t = seed.uniform(0, duration);
      std::vector<model::Capsule> bodies;
      model::place_capsules(r1.model, r1.X_WB, motion.motion().joints(t), bodies);
      for (const auto& c : bodies) {
        const model::Vector3 axis = c.b - c.a;
        const double s = axis.squaredNorm() > 0 ? std::clamp(axis.dot(shoulder2 - c.a) / axis.squaredNorm(), 0.0, 1.0) : 0.0;
        const bool beyond = std::min(c.a.y(), c.b.y()) - c.radius < 0.128 - 1e-9;
        const bool reached = (c.a + s * axis - shoulder2).norm() - c.radius < 0.668 - 1e-9;
        if (!beyond || !reached) continue;
        ++inside;
        ASSERT_TRUE(v.enters) << "case " << i << " at " << t;
        ASSERT_GE(t, v.from_start ? 0 : v.entered) << "case " << i;
        ASSERT_LE(t, v.to_end ? duration : v.left) << "case " << i;
      }
    }
  }
  EXPECT_GT(inside, 1000U);
  EXPECT_GT(partly, 30U);
}

/// What the zone is for: 200 random pairs of neighbours, 200 pairs of postures each; two robots that are both out of the zone are clear of
/// each other by the margin, without any tolerance.
TEST(SharedZone, RobotsOutOfItAreApart) {
  Seed seed{32};
  std::size_t both_out = 0;
  for (int i = 0; i < 200; ++i) {
    model::Cell cell;
    cell.planning.margin = seed.chance(0.5) ? 0.0 : 0.02;
    for (std::size_t r = 0; r < 2; ++r) {
      cell.robots.push_back(
          robot_at(r == 0 ? "a" : "b", random_arm(seed), {r == 0 ? 0 : seed.uniform(0.4, 2), 0, 0}, seed.uniform(-kPi, kPi)));
      cell.robots[r].home = random_joints(seed, cell.robots[r].model);
    }
    const SharedZone zone{cell};
    for (int k = 0; k < 200; ++k) {
      std::vector<std::unique_ptr<SampledMotion>> standing;
      bool out = true;
      for (model::RobotIndex r = 0; r < 2; ++r) {
        const auto& robot = cell.robots[r];
        const model::Joints q = seed.chance(0.3) ? robot.home : random_joints(seed, robot.model);
        standing.push_back(std::make_unique<SampledMotion>(model::Motion::rest(robot, q), 0.01));
        out = out && !zone.visit(r, *standing.back()).enters;
      }
      if (!out) continue;
      ++both_out;
      for (const auto& x : standing[0]->piece(0, 0).bodies) {
        for (const auto& y : standing[1]->piece(0, 0).bodies) {
          ASSERT_GT(core::clearance(x, y), cell.planning.margin) << "pair " << i << ", postures " << k;
        }
      }
    }
  }
  EXPECT_GT(both_out, 1000U);
}

// ---- the token

core::PlannerOptions zone_options() {
  auto options = Desk::usual();
  options.strategy = "zone";
  return options;
}

struct ZoneDesk : Desk {
  explicit ZoneDesk(const std::shared_ptr<const model::Cell>& its_cell = experiment_cell(true)) : Desk(its_cell, zone_options()) {
    all_stand();
  }
  /// r1 in the zone, asked to leave it.
  void r1_leaves() {
    go("out", "r1", to_centre());
    submit("back", "r1", line_to(pose_mm(450, 400, 300)));
  }
};

TEST(Zone, MotionsOutsideStartAtOnce) {
  ZoneDesk desk;
  EXPECT_EQ(desk.planner.state(desk.now).strategy, "zone");
  desk.submit("in", "r1", to_centre());
  desk.begin(desk.dispatch_of("in"));
  desk.submit("aside", "r2", r2_aside());
  EXPECT_EQ(desk.dispatches_of("aside"), 1U);
  EXPECT_EQ(desk.status_of("aside").reason, Reason::none);
  desk.submit("far", "r3", line_to(pose_mm(300, 5250, 330)));
  EXPECT_EQ(desk.dispatches_of("far"), 1U);
}

TEST(Zone, ItsTokenIsReturnedWhenTheBodyIsOut) {
  ZoneDesk desk;
  desk.r1_leaves();
  const auto back = desk.dispatch_of("back");
  const model::Joints from = back.from;
  const SharedZone zone{*desk.cell};
  const double left = visit(zone, *desk.cell, 0, from, back.motion).left;
  desk.begin(back);
  desk.submit("in", "r2", to_centre());
  const auto in = desk.status_of("in");
  ASSERT_EQ(in.state, CommandState::scheduled);
  EXPECT_EQ(in.reason, Reason::delayed);
  EXPECT_NEAR(model::to_seconds(*in.start - back.earliest), left, 1e-6);
  EXPECT_LT(left, back.duration - 0.5) << "not only at the end of the motion";
  ASSERT_EQ(in.conflicts.size(), 1U);
  EXPECT_EQ(in.conflicts.front().blocker.str(), "r1");
  EXPECT_NEAR(model::to_seconds(in.conflicts.front().until - *in.start), 0, 1e-6);
  EXPECT_NE(in.text.find("would be in the zone that r1 holds"), std::string::npos) << in.text;
}

TEST(Zone, TwoRobotsExcludeEachOtherWhereTheyWouldNotMeet) {
  // Each only a little way into the zone, 200 mm apart: by the maps both could go at once.
  for (const std::string strategy : {"event", "zone"}) {
    auto options = Desk::usual();
    options.strategy = strategy;
    Desk desk{experiment_cell(), options};
    desk.all_stand();
    desk.submit("a", "r1", line_to(pose_mm(450, 200, 300)));
    desk.begin(desk.dispatch_of("a"));
    desk.submit("b", "r2", line_to(pose_mm(450, -200, 300)));
    EXPECT_EQ(desk.dispatches_of("b"), strategy == "event" ? 1U : 0U) << strategy;
  }
}

TEST(Zone, WhoEndsInsideBlocksTheOtherForEverAndIsNamed) {
  ZoneDesk desk;
  desk.submit("out", "r1", line_to(pose_mm(450, 200, 300)));
  desk.begin(desk.dispatch_of("out"));
  desk.submit("in", "r2", line_to(pose_mm(450, -200, 300)));
  for (const bool arrived : {false, true}) {
    if (arrived) desk.finish(desk.dispatch_of("out"));
    const auto in = desk.status_of("in");
    EXPECT_EQ(in.state, CommandState::waiting);
    EXPECT_EQ(in.reason, Reason::blocked);
    ASSERT_EQ(in.conflicts.size(), 1U);
    EXPECT_EQ(in.conflicts.front().blocker.str(), "r1");
    EXPECT_FALSE(in.conflicts.front().own_link.empty());
    EXPECT_EQ(in.conflicts.front().until, model::kForever);
    EXPECT_NE(in.text.find("would be in the zone that r1 holds"), std::string::npos) << in.text;
    EXPECT_NE(in.text.find("as long as r1 stays there"), std::string::npos) << in.text;
    desk.pass(100s);
    EXPECT_EQ(desk.dispatches_of("in"), 0U);
  }
  desk.submit("back", "r1", r1_home());
  desk.begin(desk.dispatch_of("back"));
  EXPECT_EQ(desk.status_of("in").state, CommandState::scheduled);
  ASSERT_TRUE(desk.pass_until_dispatch());
  EXPECT_EQ(desk.dispatches.back().id.str(), "in");
}

TEST(Zone, ATokenIsNotPassedOnBeforeItsHolderIsKnownToLeave) {
  ZoneDesk desk;
  desk.r1_leaves();
  desk.submit("in", "r2", line_to(pose_mm(450, -200, 300)));
  const auto back = desk.dispatch_of("back");
  const auto planned = desk.status_of("in").start;
  ASSERT_TRUE(planned);
  desk.report(back, ExecutionState::accepted);
  while (desk.now < *planned + 5s) {  // neither started nor refused
    desk.pass(100ms);
    desk.stands("r1", back.from);
  }
  EXPECT_EQ(desk.dispatches_of("in"), 0U);
}

TEST(Zone, HasNoTokenForAnybodyWhileARobotIsLost) {
  auto options = zone_options();
  options.posture_timeout = 100ms;
  Desk desk{experiment_cell(), options};
  desk.stands("r1", desk.robot("r1").start);
  desk.submit("in", "r1", line_to(pose_mm(450, 200, 300)));
  EXPECT_EQ(desk.dispatches_of("in"), 0U);
  EXPECT_EQ(desk.status_of("in").reason, Reason::robot_unknown);
}

TEST(Zone, DrawnTooSmallDoesNotMakeRobotsCollide) {
  auto cell = experiment_cell();
  cell->planning.zone = model::Box{{0.3, 0.9, 0.1}, {0.4, 1.0, 0.3}};
  ZoneDesk desk{cell};
  desk.go("out", "r1", to_centre());
  desk.submit("in", "r2", to_centre());
  EXPECT_EQ(desk.dispatches_of("in"), 0U);
  EXPECT_NE(desk.status_of("in").text.find("would meet r1's"), std::string::npos) << desk.status_of("in").text;
}

}  // namespace
}  // namespace interlace::test
