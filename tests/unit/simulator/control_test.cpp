#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "simulator/generator.hpp"
#include "simulator/status_judge.hpp"
#include "simulator/trace_check.hpp"
#include "simulator/virtual_cell.hpp"
#include "tests/support/motions.hpp"
#include "tests/support/seed.hpp"
#include "tests/unit/simulator/cells.hpp"

/// Priorities, deadlines, holds and replacements in whole runs, judged from postures and statuses by code that is not the planner's.
namespace interlace::test {
namespace {

using model::CommandState;
using model::DeadlineVerdict;
using model::ProgramStep;
using model::Reason;
using What = model::ProgramEvent::What;

ProgramStep step(const model::MotionRequest& motion, int priority = 0) {
  ProgramStep s;
  s.motion = motion;
  s.priority = priority;
  return s;
}

struct Played {
  app::RunReport report;
  std::vector<model::CommandStatus> statuses;
  double longest = 0;  ///< motion of all that were made, with latency [s]

  [[nodiscard]] const app::CommandRow& row(const std::string& id) const {
    const auto found = std::find_if(report.commands.begin(), report.commands.end(), [&](const auto& r) { return r.id.str() == id; });
    if (found == report.commands.end()) throw std::out_of_range(id);
    return *found;
  }
};

Played play(const std::shared_ptr<const model::Cell>& cell, const model::Program& program, const std::string& strategy = "event",
            std::uint64_t seed = 1) {
  Played r;
  sim::VirtualOptions options;
  options.strategy = strategy;
  options.seed = seed;
  options.on_status = [&](const model::CommandStatus& s) { r.statuses.push_back(s); };
  r.report = sim::run_virtual(cell, program, options);
  for (const auto& row : r.report.commands) {
    if (row.start && row.end) r.longest = std::max(r.longest, *row.end - *row.start);
  }
  return r;
}

/// Two arms and places of which both can never be taken at once.
std::shared_ptr<model::Cell> two_arms(double patience) {
  auto cell = experiment_cell();
  cell->planning.patience = patience;
  return cell;
}
model::MotionRequest near_centre(int i) {
  return line_to(pose_mm(350 + 5 * (i % 3), 0, 200 + 5 * (i % 2)));
}

/// r1 gets `flood` commands to places in r2's way, all of priority `theirs`; r2 gets one.
model::Program flood(int flood, int theirs, int ours) {
  model::Program program;
  std::vector<ProgramStep> many;
  for (int i = 0; i < flood; ++i) many.push_back(step(near_centre(i), theirs));
  program.robots.emplace_back(model::RobotName{"r1"}, many);
  ProgramStep one = step(line_to(pose_mm(350, 0, 200)), ours);
  one.at = 1;  // r1 is under way
  program.robots.emplace_back(model::RobotName{"r2"}, std::vector<ProgramStep>{one});
  return program;
}

/// The bound of docs/architecture.md: m robots around, motions of at most `longest`, `e` motions to let one command through.
double bound(double patience, double m, double e, double longest) {
  return patience + m * (2 + e) * longest;
}

TEST(Fairness, AFloodOfHighPriorityHoldsNobodyUpForLongerThanTheBound) {
  for (const double patience : {1.0, 10.0, 30.0}) {
    const Played r = play(two_arms(patience), flood(300, 1'000'000, -1'000'000));
    const auto& modest = r.row("r2-1");
    ASSERT_TRUE(modest.start) << "patience " << patience;
    const double waited = *modest.start - modest.release;
    std::printf("patience %.0f s: started after %.2f s, bound %.2f s\n", patience, waited, bound(patience, 2, 1, r.longest));
    EXPECT_GT(waited, patience) << "the flood goes first until then";
    EXPECT_LE(waited, bound(patience, 2, 1, r.longest));
    EXPECT_EQ(r.report.completed, 301u);
    EXPECT_EQ(r.report.collisions, 0u);
    EXPECT_EQ(r.report.warnings, 0u);
  }
}

TEST(Fairness, AFloodOfEqualPriorityNeither) {
  const Played r = play(two_arms(10), flood(300, 0, 0));
  const auto& other = r.row("r2-1");
  ASSERT_TRUE(other.start);
  EXPECT_LE(*other.start - other.release, bound(10, 2, 1, r.longest));
  EXPECT_EQ(r.report.completed, 301u);
}

TEST(Fairness, AHigherPriorityDoesNotWaitForAFloodAtAll) {
  const Played r = play(two_arms(1000), flood(100, 0, 1));
  const auto& urgent = r.row("r2-1");
  ASSERT_TRUE(urgent.start);
  EXPECT_LE(*urgent.start - urgent.release, bound(0, 1, 1, r.longest));
  EXPECT_EQ(r.report.completed, 101u);
  EXPECT_EQ(r.report.collisions, 0u);
}

/// Floods on all robots but one of a pattern with four robots around one place.
TEST(Fairness, SeveralFloodsNeither) {
  auto cell = std::make_shared<model::Cell>(*deployed_cell("pattern-square-4"));
  cell->planning.patience = 20;
  cell->planning.resolution = 0.05;
  for (const std::uint64_t seed : {11, 12, 13}) {
    sim::GeneratorOptions generator;
    generator.seed = seed;
    generator.per_robot = 15;
    auto program = sim::generate_program(*cell, generator);
    ASSERT_TRUE(program);
    for (std::size_t i = 1; i < program->robots.size(); ++i) {
      for (ProgramStep& s : program->robots[i].second) s.priority = 100;
    }
    const Played r = play(cell, *program, "event", seed);
    EXPECT_EQ(r.report.completed, r.report.submitted);
    EXPECT_EQ(r.report.collisions, 0u);
    // Each of its commands in turn: from the end of the one before it.
    double free = 0, worst = 0;
    for (const auto& row : r.report.commands) {
      if (row.robot != program->robots[0].first || row.escape) continue;
      ASSERT_TRUE(row.start && row.end) << row.id.str();
      worst = std::max(worst, *row.start - free);
      free = *row.end;
    }
    std::printf("seed %d: longest wait %.2f s, bound %.2f s\n", static_cast<int>(seed), worst, bound(20, 4, 3, r.longest));
    EXPECT_LE(worst, bound(20, 4, 3, r.longest));
  }
}

/// Priorities of any kind on programs that can be served leave nothing undone, touch nothing and call nobody.
TEST(Priorities, OfRandomProgramsLeaveNothingUndone) {
  std::size_t gave_way = 0, commands = 0;
  for (const char* name : {"pattern-triangle-3", "pattern-zigzag-4", "pattern-square-4", "pattern-serial-4"}) {
    auto cell = std::make_shared<model::Cell>(*deployed_cell(name));
    cell->planning.resolution = 0.05;
    for (std::uint64_t seed = 100; seed < 100 + scaled(5); ++seed) {
      Seed random{seed};
      cell->planning.patience = random.chance(0.5) ? 5 : 60;
      sim::GeneratorOptions generator;
      generator.seed = seed;
      auto program = sim::generate_program(*cell, generator);
      ASSERT_TRUE(program);
      for (auto& entry : program->robots) {
        double at = 0;  // a robot's commands keep their order
        for (ProgramStep& s : entry.second) {
          s.priority = static_cast<int>(random.below(4));
          s.at = at += random.chance(0.3) ? random.uniform(0, 20) : 0;
          if (random.chance(0.5)) s.deadline = random.uniform(1, 200);
        }
      }
      sim::StatusJudge judge;
      const Played r = play(cell, *program, "event", seed);
      for (const auto& s : r.statuses) {
        judge.on_status(s);
        gave_way += s.reason == Reason::priority && s.state == CommandState::waiting ? 1 : 0;
      }
      const auto verdict = judge.verdict(r.report.commands);
      EXPECT_TRUE(verdict.good()) << name << " seed " << seed << ": " << (verdict.complaints.empty() ? "" : verdict.complaints.front());
      EXPECT_EQ(r.report.collisions, 0u) << name << " seed " << seed;
      EXPECT_EQ(r.report.warnings, 0u) << name << " seed " << seed;
      for (const auto& row : r.report.commands) {
        ++commands;
        if (!row.deadline) continue;
        const auto expected = *row.end <= *row.deadline ? DeadlineVerdict::met : DeadlineVerdict::late;
        EXPECT_TRUE(row.verdict == expected || (row.verdict == DeadlineVerdict::impossible && expected == DeadlineVerdict::late))
            << row.id.str() << " " << to_string(row.verdict);
      }
    }
  }
  std::printf("%zu commands, %zu times one gave way\n", commands, gave_way);
  EXPECT_GT(gave_way, 0u);
}

TEST(Events, HoldResumeCancelAndReplaceAreCarriedOut) {
  model::Program program;
  program.robots.emplace_back(model::RobotName{"r1"},
                              std::vector<ProgramStep>{step(line_to(pose_mm(300, 250, 330))), step(line_to(pose_mm(450, 250, 300))),
                                                       step(line_to(pose_mm(300, 250, 330)))});
  program.robots.emplace_back(model::RobotName{"r2"},
                              std::vector<ProgramStep>{step(line_to(pose_mm(300, -250, 330))), step(line_to(pose_mm(450, -250, 300)))});
  program.events = {{What::hold, 0.5, model::RobotName{"r1"}, 0, {}},
                    {What::cancel, 0.6, model::RobotName{"r1"}, 3, {}},
                    {What::replace, 0.7, model::RobotName{"r2"}, 0, {step(line_to(pose_mm(400, -250, 330)))}},
                    {What::resume, 20, model::RobotName{"r1"}, 0, {}}};
  const Played r = play(two_arms(120), program);
  EXPECT_EQ(r.row("r1-1").state, CommandState::completed) << "it had begun";
  EXPECT_LT(*r.row("r1-1").end, 20);
  EXPECT_GE(*r.row("r1-2").start, 20);
  EXPECT_EQ(r.row("r1-3").state, CommandState::cancelled);
  EXPECT_EQ(r.row("r2-2").state, CommandState::cancelled);
  EXPECT_EQ(r.row("r2-2").reason, Reason::replaced);
  EXPECT_EQ(r.row("r2-event-3-1").state, CommandState::completed);
  EXPECT_EQ(r.report.submitted, 6u);
  EXPECT_EQ(r.report.completed, 4u);
  EXPECT_EQ(r.report.cancelled, 2u);
  EXPECT_EQ(r.report.unserved, 0u);
}

TEST(Events, ARobotThatStaysHeldLeavesItsCommandsAndSaysWhy) {
  model::Program program;
  program.robots.emplace_back(model::RobotName{"r1"},
                              std::vector<ProgramStep>{step(line_to(pose_mm(350, 0, 200))), step(line_to(pose_mm(450, 250, 300)))});
  program.robots.emplace_back(model::RobotName{"r2"}, std::vector<ProgramStep>{step(line_to(pose_mm(350, 0, 200)))});
  program.robots.back().second[0].at = 1;
  program.events = {{What::hold, 0.5, model::RobotName{"r1"}, 0, {}}};
  const Played r = play(two_arms(120), program);
  EXPECT_EQ(r.report.completed, 1u);
  EXPECT_EQ(r.report.unserved, 2u);
  EXPECT_EQ(r.row("r1-2").reason, Reason::held);
  EXPECT_EQ(r.row("r2-1").reason, Reason::held);
  EXPECT_NE(r.row("r2-1").explanation.find("waits for r1, which is held"), std::string::npos) << r.row("r2-1").explanation;
  EXPECT_EQ(r.report.escapes, 0u);
  EXPECT_EQ(r.report.warnings, 0u);
}

/// Robots are held and resumed at any time while random programs run: nothing touches, nothing is lost, all is served in the end.
TEST(Events, HoldsAtAnyTimeAreSafeAndLeaveNothingUndone) {
  for (const char* name : {"pattern-triangle-3", "pattern-square-4"}) {
    auto cell = std::make_shared<model::Cell>(*deployed_cell(name));
    cell->planning.resolution = 0.05;
    for (std::uint64_t seed = 200; seed < 200 + scaled(5); ++seed) {
      Seed random{seed};
      sim::GeneratorOptions generator;
      generator.seed = seed;
      auto program = sim::generate_program(*cell, generator);
      ASSERT_TRUE(program);
      for (int i = 0; i < 12; ++i) {
        const auto& robot = cell->robots[random.below(cell->robots.size())].name;
        const double at = random.uniform(0, 60);
        program->events.push_back({What::hold, at, robot, 0, {}});
        program->events.push_back({What::resume, at + random.uniform(0, 20), robot, 0, {}});
      }
      for (const auto& robot : cell->robots) program->events.push_back({What::resume, 100, robot.name, 0, {}});
      sim::StatusJudge judge;
      const Played r = play(cell, *program, "event", seed);
      for (const auto& s : r.statuses) judge.on_status(s);
      EXPECT_EQ(r.report.completed, r.report.submitted) << name << " seed " << seed;
      EXPECT_EQ(r.report.collisions, 0u) << name << " seed " << seed;
      EXPECT_EQ(judge.verdict(r.report.commands).contradicted, 0u);
    }
  }
}

}  // namespace
}  // namespace interlace::test
