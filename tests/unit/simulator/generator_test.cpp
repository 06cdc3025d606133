#include "simulator/generator.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "common/app/config/program_text.hpp"
#include "common/model/fixture_distance.hpp"
#include "common/model/motion.hpp"
#include "common/model/segment_distance.hpp"
#include "tests/support/arms.hpp"
#include "tests/support/motions.hpp"
#include "tests/unit/simulator/cells.hpp"

namespace interlace::sim {
namespace {

using model::Joints;
using test::deployed_cell;

model::Program generated(const model::Cell& cell, const GeneratorOptions& options) {
  auto program = generate_program(cell, options);
  if (!program) throw std::runtime_error(program.error());
  return std::move(*program);
}

bool same(const model::MotionRequest& a, const model::MotionRequest& b) {
  if (a.velocity != b.velocity || a.acceleration != b.acceleration || a.target.index() != b.target.index()) return false;
  if (const auto* line = std::get_if<model::LinearTarget>(&a.target)) {
    return line->X_WT.matrix() == std::get<model::LinearTarget>(b.target).X_WT.matrix();
  }
  return std::get<model::JointTarget>(a.target).q == std::get<model::JointTarget>(b.target).q;
}

/// Least clearance [m] of `robot` on `motion`, every 5 ms, to the others at home and to the fixtures, with distances that are not the
/// planner's.
double least_clearance(const model::Cell& cell, std::size_t robot, const model::Motion& motion) {
  std::vector<std::vector<model::Capsule>> homes(cell.robots.size());
  for (std::size_t i = 0; i < homes.size(); ++i) {
    model::place_capsules(cell.robots[i].model, cell.robots[i].X_WB, cell.robots[i].home, homes[i]);
  }
  double least = 1e9;
  std::vector<model::Capsule> own;
  const int steps = static_cast<int>(std::ceil(motion.duration() / 0.005));
  for (int k = 0; k <= steps; ++k) {
    model::place_capsules(cell.robots[robot].model, cell.robots[robot].X_WB, motion.joints(0.005 * k), own);
    for (std::size_t other = 0; other < homes.size(); ++other) {
      if (other == robot) continue;
      for (const auto& a : own) {
        for (const auto& b : homes[other]) least = std::min(least, model::segment_distance(a.a, a.b, b.a, b.b) - a.radius - b.radius);
      }
    }
    for (std::size_t i = 0; i < own.size(); ++i) {
      if (cell.robots[robot].model.capsules[i].link == 0) continue;
      for (const auto& fixture : cell.fixtures) {
        if (model::clearance_lower_bound(own[i], fixture) < least) least = std::min(least, model::clearance(own[i], fixture));
      }
    }
  }
  return least;
}

/// Joints at the end of `request`, of which every posture must be clear of the others at home.
std::optional<Joints> carry_out(const model::Cell& cell, std::size_t robot, const Joints& from, const model::MotionRequest& request) {
  const auto motion = model::plan_motion(cell.robots[robot], from, request);
  if (!motion || least_clearance(cell, robot, *motion) <= 0) return std::nullopt;
  return motion->to();
}

bool can_go_home(const model::Cell& cell, std::size_t robot, const Joints& from) {
  const model::Robot& r = cell.robots[robot];
  return carry_out(cell, robot, from, test::line_to(r.X_WB * model::tcp_pose(r.model, r.home))) ||
         carry_out(cell, robot, from, test::joints_to(r.home));
}

const char* const kCells[] = {"exp-4-2",          "exp-6-1",           "exp-6-2",          "pattern-triangle-3",
                              "pattern-serial-3", "pattern-zigzag-4",  "pattern-square-4", "pattern-ring-5",
                              "pattern-serial-8", "fixtures-square-4", "fixtures-serial-4"};

class GeneratedProgram : public testing::TestWithParam<const char*> {};

TEST_P(GeneratedProgram, IsWellFormedBySampling) {
  test::Seed seed{20};
  const auto cell = deployed_cell(GetParam());
  GeneratorOptions options;
  options.seed = seed.engine()();
  options.per_robot = test::scaled(12);
  const auto program = generated(*cell, options);
  ASSERT_EQ(program.robots.size(), cell->robots.size());
  for (std::size_t robot = 0; robot < cell->robots.size(); ++robot) {
    const auto& [name, steps] = program.robots[robot];
    EXPECT_EQ(name, cell->robots[robot].name);
    ASSERT_EQ(steps.size(), options.per_robot);
    Joints q = cell->robots[robot].start;
    for (std::size_t i = 0; i < steps.size(); ++i) {
      const auto end = carry_out(*cell, robot, q, steps[i].motion);
      ASSERT_TRUE(end) << name.str() << " cannot carry out its command " << i + 1 << " while the others are home";
      EXPECT_TRUE(can_go_home(*cell, robot, *end)) << name.str() << " cannot go home after its command " << i + 1;
      EXPECT_TRUE(carry_out(*cell, robot, cell->robots[robot].home, steps[i].motion)) << name.str() << " command " << i + 1 << " from home";
      q = *end;
    }
  }
}

TEST_P(GeneratedProgram, ComesBackFromItsFileAsItWas) {
  const auto cell = deployed_cell(GetParam());
  GeneratorOptions options;
  options.joint_moves = 0.5;
  const auto program = generated(*cell, options);
  const auto read = app::parse_program(app::program_text(program, "two\nlines"), "generated", cell.get());
  ASSERT_TRUE(read) << to_string(read.error());
  ASSERT_EQ(read->robots.size(), program.robots.size());
  for (std::size_t robot = 0; robot < program.robots.size(); ++robot) {
    EXPECT_EQ(read->robots[robot].first, program.robots[robot].first);
    ASSERT_EQ(read->robots[robot].second.size(), program.robots[robot].second.size());
    for (std::size_t i = 0; i < program.robots[robot].second.size(); ++i) {
      EXPECT_TRUE(same(read->robots[robot].second[i].motion, program.robots[robot].second[i].motion)) << robot << ", command " << i;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Deployed, GeneratedProgram, testing::ValuesIn(kCells), [](const testing::TestParamInfo<const char*>& info_of) {
  std::string name = info_of.param;
  for (auto& c : name) c = c == '-' ? '_' : c;
  return name;
});

TEST(Generator, SaysTheSameForASeedOnEveryMachine) {
  // The deployed programs are what the generator made of seeds 1 to 3. When it is meant to make others, make the files anew:
  // interlace-generate CELL --seed K --commands 4 --output program-K.yaml
  for (const char* name : {"pattern-triangle-3", "pattern-serial-3", "pattern-zigzag-4", "pattern-square-4", "pattern-serial-4"}) {
    const auto cell = deployed_cell(name);
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      GeneratorOptions options;
      options.seed = seed;
      options.per_robot = 4;
      const std::string comment = fmt::format("Made by interlace-generate for cell {}: seed {}, 4 commands for each robot.", name, seed);
      EXPECT_EQ(app::program_text(generated(*cell, options), comment),
                test::text_of(test::deployed(fmt::format("{}/program-{}.yaml", name, seed))))
          << name << ", seed " << seed;
    }
  }
}

TEST(Generator, AnotherSeedMakesAnotherProgram) {
  const auto cell = deployed_cell("pattern-serial-3");
  GeneratorOptions a;
  GeneratorOptions b;
  b.seed = 2;
  EXPECT_NE(app::program_text(generated(*cell, a)), app::program_text(generated(*cell, b)));
}

TEST(Generator, MakesLinearAndJointMovesAndSlowerOnes) {
  GeneratorOptions options;
  options.per_robot = 20;
  std::size_t joint = 0;
  std::size_t slower = 0;
  const auto program = generated(*deployed_cell("pattern-serial-4"), options);
  for (const auto& entry : program.robots) {
    for (const auto& step : entry.second) {
      joint += std::holds_alternative<model::JointTarget>(step.motion.target) ? 1 : 0;
      slower += step.motion.velocity ? 1 : 0;
    }
  }
  EXPECT_GT(joint, 0U);
  EXPECT_LT(joint, 40U);
  EXPECT_GT(slower, 0U);
}

TEST(Generator, SaysWhoFindsNoTarget) {
  // Other arms stand all around, nearer than any target: every place is in somebody's home.
  model::Cell cell;
  cell.name = "crowd";
  cell.robots.push_back(test::experiment_robot("r1", {0, 0, 0}, test::pose_mm(300, 0, 600)));
  for (int i = 0; i < 8; ++i) {
    const double angle = -1.6 + 0.4 * i;
    auto post = test::robot_at("post" + std::to_string(i), test::arm4(), {0.32 * std::cos(angle), 0.32 * std::sin(angle), 0});
    cell.robots.push_back(post);
  }
  const auto program = generate_program(cell, {});
  ASSERT_FALSE(program);
  EXPECT_NE(program.error().find("r1"), std::string::npos) << program.error();
  EXPECT_NE(program.error().find("home"), std::string::npos) << program.error();
}

TEST(ProgramText, WritesEveryKeyAndLosesNothing) {
  model::Program program;
  auto& steps = program.robots.emplace_back(model::RobotName{"r1"}, std::vector<model::ProgramStep>{}).second;
  test::Seed seed{3};
  for (int i = 0; i < 200; ++i) {
    model::ProgramStep step;
    step.motion = i % 2 == 0 ? test::line_to(model::make_pose(test::random_point(seed, 2), test::random_rotation(seed)))
                             : test::joints_to(Joints::NullaryExpr([&] { return seed.uniform(-6, 6); }));
    step.motion.velocity = seed.uniform(0.01, 1);
    step.motion.acceleration = seed.uniform(0.01, 1);
    step.priority = i - 100;
    step.at = seed.uniform(0, 100);
    if (i % 3 == 0) step.deadline = seed.uniform(0, 100);
    steps.push_back(step);
  }
  // Upright, where roll and yaw turn about one axis.
  steps.push_back({test::line_to(model::make_pose({0.1, -0.2, 0}, model::rotation_from_rpy({0.3, model::kPi / 2, 0.1}))), 0, 0});
  using What = model::ProgramEvent::What;
  program.events = {{What::hold, 1, model::RobotName{"r1"}, 0, {}},
                    {What::cancel, 1.5, model::RobotName{"r1"}, 3, {}},
                    {What::replace, 2, model::RobotName{"r1"}, 0, {steps.front()}},
                    {What::replace, 2.5, model::RobotName{"r1"}, 0, {}},
                    {What::resume, 3, model::RobotName{"r1"}, 0, {}}};
  program.events[2].commands[0].at = 0;
  const auto read = app::parse_program(app::program_text(program), "written", nullptr);
  ASSERT_TRUE(read) << to_string(read.error());
  const auto& back = read->robots.at(0).second;
  ASSERT_EQ(back.size(), steps.size());
  const double tolerance = 1e-10;  // of [m], [rad], [m/s], [s]: twelve digits of numbers up to 360
  for (std::size_t i = 0; i < steps.size(); ++i) {
    ASSERT_EQ(back[i].motion.target.index(), steps[i].motion.target.index());
    if (const auto* line = std::get_if<model::LinearTarget>(&steps[i].motion.target)) {
      const auto& X = std::get<model::LinearTarget>(back[i].motion.target).X_WT;
      EXPECT_LT((X.matrix() - line->X_WT.matrix()).cwiseAbs().maxCoeff(), i + 1 == steps.size() ? 1e-8 : tolerance) << i;
    } else {
      const auto& q = std::get<model::JointTarget>(back[i].motion.target).q;
      EXPECT_LT((q - std::get<model::JointTarget>(steps[i].motion.target).q).cwiseAbs().maxCoeff(), tolerance) << i;
    }
    EXPECT_EQ(back[i].priority, steps[i].priority);
    EXPECT_NEAR(back[i].at, steps[i].at, tolerance);
    ASSERT_EQ(back[i].deadline.has_value(), steps[i].deadline.has_value());
    EXPECT_NEAR(back[i].deadline.value_or(0), steps[i].deadline.value_or(0), tolerance);
    EXPECT_NEAR(back[i].motion.velocity.value_or(0), steps[i].motion.velocity.value_or(0), tolerance);
    EXPECT_NEAR(back[i].motion.acceleration.value_or(0), steps[i].motion.acceleration.value_or(0), tolerance);
  }
  ASSERT_EQ(read->events.size(), program.events.size());
  for (std::size_t i = 0; i < program.events.size(); ++i) {
    EXPECT_EQ(read->events[i].what, program.events[i].what);
    EXPECT_EQ(read->events[i].at, program.events[i].at);
    EXPECT_EQ(read->events[i].robot, program.events[i].robot);
    EXPECT_EQ(read->events[i].command, program.events[i].command);
    EXPECT_EQ(read->events[i].commands.size(), program.events[i].commands.size());
  }
}

}  // namespace
}  // namespace interlace::sim
