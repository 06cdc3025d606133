#include <cmath>
#include <limits>
#include <ostream>
#include <set>

#include "tests/support/turnstile.hpp"
#include "tests/unit/simulator/standoff.hpp"

/// Crafted standoffs: nobody in the way would move by itself. In each nothing is touched and every command completes.
namespace interlace::test {
namespace {

/// `robot` starts with its TCP at `X_WT`, wherever its home is.
void start_at(model::Cell& cell, std::size_t robot, const model::Pose& X_WT) {
  model::Robot& r = cell.robots[robot];
  r.start = model::preferred_posture(r.model, r.X_WB.inverse() * X_WT).value();
}

struct Direction {
  const char* name;
  const char* way;        ///< as statuses write it
  Vector3 unit;           ///< where to
  const char* commanded;  ///< the other one is the idle blocker
  model::Pose X_from, X_to, X_blocker;
};

void PrintTo(const Direction& d, std::ostream* out) {
  *out << d.way;
}

class IdleBlockerEscapes : public ::testing::TestWithParam<Direction> {};

TEST_P(IdleBlockerEscapes, AlongTheAxisOfTheNearestFace) {
  const Direction& d = GetParam();
  auto cell = experiment_cell();
  const std::size_t commanded = cell->find(model::RobotName{d.commanded}).value();
  start_at(*cell, commanded, d.X_from);
  start_at(*cell, 1 - commanded, d.X_blocker);
  const model::Robot& robot = cell->robots[commanded];
  const auto swept = core::swept_cuboid(model::plan_motion(robot, robot.start, line_to(d.X_to)).value());
  EXPECT_EQ(core::escape_directions(swept, d.X_blocker.translation()).front().unit, d.unit) << "the nearest face lies that way";
  Standoff s{cell};
  s.command(d.commanded, line_to(d.X_to)).run();
  s.expect_safe_and_served();
  const auto escapes = s.escapes();
  ASSERT_EQ(escapes.size(), 1U) << s.story();
  const auto& escape = escapes.front();
  EXPECT_EQ(escape.robot, cell->robots[1 - commanded].name.str());
  EXPECT_EQ(escape.serves, std::string{d.commanded} + "-1");
  EXPECT_NE(escape.text.find(std::string{" goes "} + d.way + " "), std::string::npos) << escape.text;
  // Tolerance: 0.1 mm of the simulated controller's straight line.
  const double along = escape.way().dot(d.unit);
  EXPECT_GT(along, 0.02);
  EXPECT_LT((escape.way() - along * d.unit).norm(), 1e-4);
  EXPECT_TRUE(escape.orientation_kept());
  EXPECT_EQ(s.report.warnings, 0U);
}

INSTANTIATE_TEST_SUITE_P(Standoff, IdleBlockerEscapes,
                         ::testing::Values(Direction{"PlusX", "+x", Vector3::UnitX(), "r1", pose_mm(350, 400, 250), pose_mm(100, -50, 450),
                                                     pose_mm(350, -50, 500, 0, 0, 45)},
                                           Direction{"MinusX", "-x", -Vector3::UnitX(), "r1", pose_mm(400, 50, 200),
                                                     pose_mm(150, -100, 500), pose_mm(-50, 0, 500, 0, 0, 45)},
                                           Direction{"PlusY", "+y", Vector3::UnitY(), "r2", pose_mm(350, -300, 450), pose_mm(350, -50, 500),
                                                     pose_mm(250, -50, 500, 0, 90, 45)},
                                           Direction{"MinusY", "-y", -Vector3::UnitY(), "r1", pose_mm(350, 300, 450), pose_mm(350, 50, 500),
                                                     pose_mm(250, 50, 500, 0, 90, -45)},
                                           Direction{"PlusZ", "+z", Vector3::UnitZ(), "r1", pose_mm(550, 400, 100), pose_mm(250, -50, 100),
                                                     pose_mm(250, 50, 450, 0, -45, 0)},
                                           Direction{"MinusZ", "-z", -Vector3::UnitZ(), "r1", pose_mm(450, 350, 500), pose_mm(250, 50, 450),
                                                     pose_mm(300, 100, 300, 0, 90, -45)}),
                         [](const auto& direction) { return std::string{direction.param.name}; });

/// An arm of the experiments with its base at (x, y) [mm], turned by `yaw` [deg], standing at home with its TCP at `X_WT`.
model::Robot arm_at(const std::string& name, double x, double y, double yaw, const model::Pose& X_WT) {
  return experiment_robot(name, {x / 1e3, y / 1e3, 0}, X_WT, yaw * kPi / 180);
}

/// Length [m] of `motion` of `robot` after which it first touches `other` standing at `q`; infinite when it never does. Dense
/// samples, judged apart from the planner.
double free_length(const model::Cell& cell, std::size_t robot, const model::Motion& motion, std::size_t other, const model::Joints& q) {
  auto pair = cell;
  pair.robots = {cell.robots[robot], cell.robots[other]};
  sim::TraceCheck check{pair};
  constexpr int kSteps = 2000;
  for (int i = 0; i <= kSteps; ++i) {
    const double t = motion.duration() * i / kSteps;
    check.step(t, {motion.joints(t), q});
    if (check.collisions() > 0) return motion.length(t);
  }
  return std::numeric_limits<double>::infinity();
}

bool touches(const model::Cell& cell, std::size_t robot, const model::Motion& motion, std::size_t other, const model::Joints& q) {
  return std::isfinite(free_length(cell, robot, motion, other, q));
}

Standoff::Trip trip_of(const Standoff& s, const std::string& id) {
  for (const auto& trip : s.trips) {
    if (trip.id == id) return trip;
  }
  ADD_FAILURE() << id << " never went\n" << s.story();
  return {};
}

/// The dissertation's figure 6.12: three arms in a row; r2 is in the way of r1 and could go as far as the border of its workspace, but r3
/// stands near there.
TEST(Standoff, BlockerNearTheBorder) {
  for (const std::string strategy : {"event", "acm"}) {
    auto cell = std::make_shared<model::Cell>();
    cell->robots.push_back(arm_at("r1", 0, 500, 0, pose_mm(450, 500, 300)));
    cell->robots.push_back(arm_at("r2", 0, 0, 0, pose_mm(400, 150, 300)));
    cell->robots.push_back(arm_at("r3", 0, -500, 0, pose_mm(400, -120, 300, 0, 0, 30)));
    Standoff s{cell};
    s.command("r1", line_to(pose_mm(400, 250, 300))).run(strategy);
    s.expect_safe_and_served();
    const auto escapes = s.escapes();
    ASSERT_EQ(escapes.size(), 1U) << strategy << "\n" << s.story();
    const auto& escape = escapes.front();
    EXPECT_EQ(escape.robot, "r2");
    EXPECT_NE(escape.text.find(" goes -y "), std::string::npos) << escape.text;
    const auto whole = core::to_reachable_goal(*cell, 1, cell->robots[1], cell->robots[1].start, -Vector3::UnitY());
    ASSERT_TRUE(whole.motion);
    const double free = free_length(*cell, 1, whole.motion->motion(), 2, cell->robots[2].start);
    EXPECT_LT(free, 0.2) << "the border itself is no safe goal: r3 stands in the way";
    EXPECT_GT(-escape.way().y(), 0.02) << strategy;
    EXPECT_LT(-escape.way().y(), free) << strategy;
    // acm would brake for another 50 mm behind the collision area; the last sample before r3 stops it: 3 mm at its speed.
    if (strategy == "acm") {
      EXPECT_GT(-escape.way().y(), free - 0.003);
    }
  }
}

/// The dissertation's figure 6.10: two idle robots in the way of r3. The one whose TCP is nearest to a face of what r3 sweeps goes first.
TEST(Standoff, TwoBlockersInThePublishedOrder) {
  for (const bool r1_nearer : {true, false}) {
    const double r1_y = r1_nearer ? 100 : 80;
    const double r2_y = r1_nearer ? -80 : -100;
    auto cell = std::make_shared<model::Cell>();
    cell->robots.push_back(arm_at("r1", 0, 250, 0, pose_mm(350, r1_y, 250, 0, 0, -45)));
    cell->robots.push_back(arm_at("r2", 0, -250, 0, pose_mm(350, r2_y, 250, 0, 0, 45)));
    cell->robots.push_back(arm_at("r3", 600, 0, 180, pose_mm(450, 0, 550, 0, -45, 180)));
    Standoff s{cell};
    s.command("r3", line_to(pose_mm(200, 0, 250, 0, 0, 180))).run();
    s.expect_safe_and_served();
    const auto escapes = s.escapes();
    ASSERT_EQ(escapes.size(), 2U) << s.story();
    EXPECT_EQ(escapes[0].robot, r1_nearer ? "r1" : "r2") << s.story();
    EXPECT_EQ(escapes[1].robot, r1_nearer ? "r2" : "r1") << s.story();
    for (const auto& escape : escapes) EXPECT_EQ(escape.serves, "r3-1");
  }
}

/// r2 is in the way of r1. Its shoulder and elbow leave it little more than to turn about its base, and there r3 stands, in nobody else's
/// way: r3 must go first.
TEST(Standoff, CascadeOfTwo) {
  auto cell = std::make_shared<model::Cell>();
  cell->robots.push_back(arm_at("r1", 0, 500, 0, pose_mm(450, 500, 300)));
  cell->robots.push_back(arm_at("r2", 0, 0, 0, pose_mm(400, 150, 300)));
  cell->robots.push_back(arm_at("r3", 0, -500, 0, pose_mm(380, -30, 300, 0, 0, 50)));
  model::Robot& r2 = cell->robots[1];
  for (const int joint : {1, 2}) {
    r2.model.joints.min[joint] = r2.start[joint] - 15 * kPi / 180;
    r2.model.joints.max[joint] = r2.start[joint] + 15 * kPi / 180;
  }
  const auto command = line_to(pose_mm(400, 200, 300));
  const auto r1_motion = model::plan_motion(cell->robots[0], cell->robots[0].start, command).value();
  EXPECT_TRUE(touches(*cell, 0, r1_motion, 1, cell->robots[1].start)) << "r2 is in the way";
  EXPECT_FALSE(touches(*cell, 0, r1_motion, 2, cell->robots[2].start)) << "r3 is not";
  Standoff s{cell};
  s.command("r1", command).run();
  s.expect_safe_and_served();
  const auto escapes = s.escapes();
  ASSERT_EQ(escapes.size(), 2U) << s.story();
  EXPECT_EQ(escapes[0].robot, "r3") << s.story();
  EXPECT_EQ(escapes[1].robot, "r2") << s.story();
  for (const auto& escape : escapes) EXPECT_EQ(escape.serves, "r1-1");
  const auto r2_motion = core::to_reachable_goal(*cell, 1, cell->robots[1], escapes[1].from, escapes[1].way().normalized());
  ASSERT_TRUE(r2_motion.motion);
  EXPECT_TRUE(touches(*cell, 1, r2_motion.motion->motion(), 2, escapes[0].from)) << "r3 was in the way of r2's escape";
}

/// Four arms around a square. Each stands where the one before it wants to go.
TEST(Standoff, RingOfFour) {
  constexpr double kHalf = 400;  // [mm] of the square's sides
  constexpr double kHeight = 250;
  auto cell = std::make_shared<model::Cell>();
  const auto corner = [](std::size_t k) {
    const double angle = kPi / 4 + static_cast<double>(k) * kPi / 2;
    return Vector3{kHalf * std::sqrt(2) * std::cos(angle), kHalf * std::sqrt(2) * std::sin(angle), 0};
  };
  /// Middle of a side, the hand pointing there from the corner of robot `k`.
  const auto place = [&](std::size_t side, std::size_t k) {
    const double angle = static_cast<double>(side) * kPi / 2;
    const Vector3 p{kHalf * std::cos(angle), kHalf * std::sin(angle), kHeight};
    return pose_mm(p.x(), p.y(), p.z(), 0, 0, std::atan2(p.y() - corner(k).y(), p.x() - corner(k).x()) * 180 / kPi);
  };
  for (std::size_t k = 0; k < 4; ++k) {
    const double yaw = 225 + 90 * static_cast<double>(k);
    const Vector3 in{std::cos(yaw * kPi / 180), std::sin(yaw * kPi / 180), 0};
    const Vector3 home = corner(k) + 200 * in;
    cell->robots.push_back(
        arm_at("r" + std::to_string(k + 1), corner(k).x(), corner(k).y(), yaw, pose_mm(home.x(), home.y(), 500, 0, -45, yaw)));
  }
  Standoff s{cell};
  for (std::size_t k = 0; k < 4; ++k) {
    const std::string name = "r" + std::to_string(k + 1);
    s.command(name, line_to(place(k, k))).command(name, line_to(place(k + 1, k)));
  }
  s.run();
  s.expect_safe_and_served();
  // The ring closed: each waited for the next one, said so, and somebody went out of the way for one of them.
  for (std::size_t k = 0; k < 4; ++k) {
    const std::string id = "r" + std::to_string(k + 1) + "-2";
    const std::string next = "r" + std::to_string((k + 1) % 4 + 1);
    const auto& home = cell->robots;
    const model::Motion motion = model::plan_motion(home[k], trip_of(s, id).from, line_to(place(k + 1, k))).value();
    for (std::size_t other = 0; other < 4; ++other) {
      if (other != k) {
        EXPECT_FALSE(touches(*cell, k, motion, other, home[other].home)) << id << " is not clear of home";
      }
    }
    const auto before = trip_of(s, "r" + std::to_string((k + 1) % 4 + 1) + "-1").to;
    EXPECT_TRUE(touches(*cell, k, motion, (k + 1) % 4, before)) << id << " does not want the place of " << next;
  }
  const auto escapes = s.escapes();
  ASSERT_GE(escapes.size(), 1U) << s.story();
  std::size_t waited = 0;
  for (const auto& status : s.statuses) {
    if (status.escape) break;
    if (status.state != CommandState::waiting) continue;
    EXPECT_EQ(status.reason, Reason::blocked);
    EXPECT_NE(status.text.find(status.robot.str() + " cannot start"), std::string::npos) << status.text;
    ASSERT_EQ(status.conflicts.size(), 1U) << status.text;
    EXPECT_NE(status.text.find(status.conflicts.front().blocker.str() + "'s"), std::string::npos) << status.text;
    EXPECT_EQ(status.conflicts.front().until, model::kForever);
    ++waited;
  }
  EXPECT_GE(waited, 3U) << s.story();
  EXPECT_EQ(s.report.warnings, 0U);
}

/// Each wants where the other one is: one goes out of the way, and its own command is then carried out from where it went.
TEST(Standoff, CircleOfTwo) {
  Standoff s{experiment_cell()};
  s.command("r1", line_to(pose_mm(400, 100, 250))).command("r2", line_to(pose_mm(400, -150, 250)));
  s.command("r1", line_to(pose_mm(400, -100, 250))).command("r2", line_to(pose_mm(400, 100, 250)));
  s.run();
  s.expect_safe_and_served();
  const auto escapes = s.escapes();
  ASSERT_GE(escapes.size(), 1U) << s.story();
  EXPECT_EQ(escapes[0].robot, "r1") << s.story();
  EXPECT_EQ(escapes[0].serves, "r2-2");
  // r1's own command was judged from where its first one ended. It begins where the escape ended.
  EXPECT_EQ(s.report.rejected, 0U);
  const auto own = trip_of(s, "r1-2");
  EXPECT_GT((own.from - trip_of(s, "r1-1").to).cwiseAbs().maxCoeff(), 0.01) << "it was sent away before [rad]";
  EXPECT_LT((own.from - escapes[0].to).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_LT((own.X_WT1.translation() - Vector3{0.400, -0.100, 0.250}).norm(), 1e-4) << "the target is the same";
  EXPECT_EQ(s.report.warnings, 0U);
}

TEST(Standoff, CorridorWhereOnlyRetreatWorks) {
  const Turnstile t{0.5};
  Standoff s{t.cell};
  s.command("r2", joints_to(t.in_the_way)).command("r1", Turnstile::across(), 10).run();
  s.expect_safe_and_served();
  const auto escapes = s.escapes();
  ASSERT_EQ(escapes.size(), 1U) << s.story();
  EXPECT_EQ(escapes.front().robot, "r2");
  EXPECT_NE(escapes.front().text.find("goes back"), std::string::npos) << escapes.front().text;
  // Back to the joints it came from, as exactly as controllers arrive [rad].
  EXPECT_LT((escapes.front().to - t.aside).cwiseAbs().maxCoeff(), 1e-6);
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {1.0, -1.0}) {
      const auto goal = core::to_reachable_goal(*t.cell, 1, t.cell->robots[1], t.in_the_way, sign * Vector3::Unit(axis));
      EXPECT_FALSE(goal.motion) << "a way out along axis " << axis << ", " << sign;
    }
  }
}

/// Everything that was tried, to people, once; they move the robot by a command, and the waiting one goes.
void expect_help_is_asked_for(const Standoff& s, std::size_t refusals_at_most) {
  const auto said = s.said_of("r1-1");
  const auto warned = [](const model::CommandStatus& status) { return status.reason == Reason::deadlock; };
  ASSERT_EQ(std::count_if(said.begin(), said.end(), warned), 1) << s.story();
  const auto& warning = *std::find_if(said.begin(), said.end(), warned);
  EXPECT_EQ(warning.state, CommandState::waiting);
  EXPECT_NE(warning.text.find("r1"), std::string::npos) << warning.text;
  EXPECT_NE(warning.text.find("r2"), std::string::npos) << warning.text;
  EXPECT_NE(warning.text.find("move a robot by a command"), std::string::npos) << warning.text;
  std::set<model::EscapeWay> tried;
  for (const auto& refusal : warning.refusals) {
    EXPECT_EQ(refusal.robot.str(), "r2");
    EXPECT_FALSE(refusal.text.empty()) << model::to_string(refusal.way);
    tried.insert(refusal.way);
  }
  using model::EscapeWay;
  for (const auto way :
       {EscapeWay::plus_x, EscapeWay::minus_x, EscapeWay::plus_y, EscapeWay::minus_y, EscapeWay::plus_z, EscapeWay::minus_z})
    EXPECT_EQ(tried.count(way), 1U) << model::to_string(way);
  EXPECT_LE(warning.refusals.size(), refusals_at_most) << s.story();
  ASSERT_EQ(warning.conflicts.size(), 1U);
  EXPECT_EQ(warning.conflicts.front().blocker.str(), "r2");
  EXPECT_EQ(s.report.warnings, 1U);
  EXPECT_TRUE(s.escapes().empty()) << s.story();
}

TEST(Standoff, TrulyUnsolvable) {
  const Turnstile t{0.5};
  t.cell->robots[1].start = t.in_the_way;
  Standoff s{t.cell};
  s.command("r1", Turnstile::across()).command("r2", joints_to(t.aside), 30).run();
  s.expect_safe_and_served();
  ASSERT_NO_FATAL_FAILURE(expect_help_is_asked_for(s, 16));
  const auto scheduled = s.first_of("r1-1", CommandState::scheduled);
  EXPECT_EQ(scheduled.reason, Reason::delayed) << "what kept it for half a minute is told";
  ASSERT_EQ(scheduled.conflicts.size(), 1U);
  EXPECT_EQ(scheduled.conflicts.front().blocker.str(), "r2");
  EXPECT_LE(scheduled.conflicts.front().until, scheduled.start.value());
  EXPECT_GE(scheduled.delay, 30);
}

/// The dissertation's own method has the six directions and no more: where a retreat would help it calls for a person.
TEST(Standoff, AcmHasTheSixDirectionsOnly) {
  const Turnstile t{0.5};
  Standoff s{t.cell};
  s.command("r2", joints_to(t.in_the_way)).command("r1", Turnstile::across(), 10).command("r2", joints_to(t.aside), 30).run("acm");
  s.expect_safe_and_served();
  ASSERT_NO_FATAL_FAILURE(expect_help_is_asked_for(s, 6));
}

/// r2 was sent back; its next command is possible only from where it was. It is taken, and r2 brought there first.
TEST(Standoff, ACommandOnlyPossibleFromBeforeTheEscapeIsServedByTheWayBack) {
  const Turnstile t{3};
  const model::Robot& r2 = t.cell->robots[1];
  model::Pose up = r2.X_WB * model::tcp_pose(r2.model, t.in_the_way);
  up.translation().z() += 0.01;
  EXPECT_FALSE(core::admit(*t.cell, 1, t.cell->robots[1], t.aside, line_to(up))) << "not possible from aside";
  Standoff s{t.cell};
  s.command("r2", joints_to(t.in_the_way)).command("r1", Turnstile::across(), 10).command("r2", line_to(up), 20).run();
  s.expect_safe_and_served();
  EXPECT_EQ(s.report.rejected, 0U);
  std::vector<Standoff::Trip> of_r2;
  for (const auto& trip : s.trips) {
    if (trip.robot == "r2") of_r2.push_back(trip);
  }
  ASSERT_EQ(of_r2.size(), 4U) << s.story();
  EXPECT_EQ(of_r2[1].serves, "r1-1");
  const auto& back = of_r2[2];
  EXPECT_TRUE(back.escape);
  EXPECT_EQ(back.serves, "r2-2");
  EXPECT_LT((back.to - t.in_the_way).cwiseAbs().maxCoeff(), 1e-6) << "where it was before it was sent away";
  EXPECT_EQ(of_r2[3].id, "r2-2");
  EXPECT_LT((of_r2[3].X_WT1.translation() - up.translation()).norm(), 1e-4);
}

}  // namespace
}  // namespace interlace::test
