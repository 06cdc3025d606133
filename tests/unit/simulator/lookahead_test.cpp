#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "simulator/generator.hpp"
#include "simulator/virtual_cell.hpp"
#include "tests/support/seed.hpp"
#include "tests/unit/simulator/cells.hpp"

/// Strategy `lookahead` beside `event`, in virtual time.
namespace interlace::test {
namespace {

app::RunReport run(const std::shared_ptr<const model::Cell>& cell, const model::Program& program, const std::string& strategy) {
  sim::VirtualOptions options;
  options.strategy = strategy;
  return sim::run_virtual(cell, program, options);
}

void expect_all_done(const app::RunReport& r) {
  EXPECT_EQ(r.completed, r.submitted);
  EXPECT_EQ(r.collisions.value_or(1), 0U);
  EXPECT_EQ(r.warnings, 0U);
}

app::RunReport run_experiment(const std::string& name, double promise, double slowest = 1, bool prepare = false) {
  auto cell = std::make_shared<model::Cell>(*deployed_cell(name));
  cell->planning.promise = promise;
  for (model::Robot& robot : cell->robots) robot.tcp.slowest = slowest;
  sim::VirtualOptions options;
  options.strategy = "lookahead";
  options.prepare = prepare;
  return sim::run_virtual(cell, app::load_program(deployed(name + "/program.yaml"), cell.get()).value(), options);
}

/// The targets of the experiments sent twice: within 2 or 3 % of the least possible makespan.
TEST(Lookahead, IsNearTheOptimum) {
  const std::vector<std::pair<std::string, double>> targets{
      {"exp-4-1", 42.04}, {"exp-4-2", 29.47}, {"exp-5-1", 40.57}, {"exp-6-1", 37.23}, {"exp-6-2", 38.6}};
  for (const auto& [name, most] : targets) {
    const auto report = run_experiment(name, 2);
    expect_all_done(report);
    EXPECT_LE(report.makespan, most) << name;
  }
}

TEST(Lookahead, ReliesOnNobodyWhereTheCellForbidsIt) {
  const auto three = run_experiment("exp-6-1", 0), four = run_experiment("exp-6-2", 0);
  expect_all_done(three);
  expect_all_done(four);
  EXPECT_GE(three.makespan, 40.10) << "the least that starts which rely on nobody allow; event takes as long";
  EXPECT_NEAR(four.makespan, 38.50, 0.02) << "the bound of all groups of three; event takes 42.14 s";
}

TEST(Lookahead, GoesSlowerOnlyWhereThatIsNotLater) {
  for (const char* name : {"exp-5-1", "exp-6-1", "exp-6-2"}) {
    const auto report = run_experiment(name, 0, 0.3);
    expect_all_done(report);
    EXPECT_LE(report.makespan, run_experiment(name, 0).makespan + 1e-6) << name;
  }
}

/// A command that sets out at once and goes slower: the whole ends no later, and commands are done sooner.
TEST(Lookahead, GoesSlowerWhereCommandsAreDoneSoonerSo) {
  const auto full = deployed_cell("pattern-triangle-3");
  auto slow = std::make_shared<model::Cell>(*full);
  for (model::Robot& robot : slow->robots) robot.tcp.slowest = 0.3;
  sim::GeneratorOptions what;
  what.seed = 4;
  what.per_robot = 6;
  const auto program = sim::generate_program(*full, what).value();
  const auto ends = [](const app::RunReport& r) {
    double sum = 0;
    for (const app::CommandRow& c : r.commands) sum += c.end.value_or(0);
    return sum;
  };
  const auto without = run(full, program, "lookahead"), with = run(slow, program, "lookahead");
  expect_all_done(with);
  const auto slower = [](const app::CommandRow& c) { return c.explanation.find("goes at once and takes") != std::string::npos; };
  EXPECT_GE(std::count_if(with.commands.begin(), with.commands.end(), slower), 1);
  EXPECT_LE(with.makespan, without.makespan + 1e-6);
  EXPECT_LT(ends(with), ends(without));
}

TEST(Lookahead, DecidesTheSameHoweverMuchWasPrepared) {
  EXPECT_EQ(run_experiment("exp-6-2", 2, 1, false).makespan, run_experiment("exp-6-2", 2, 1, true).makespan);
}

/// Where robots have to make way for each other, more is wished than can be found out in time.
TEST(Lookahead, MakesTheSameDetoursHoweverMuchWasPrepared) {
  const auto cell = deployed_cell("pattern-square-4");
  for (const std::uint64_t seed : {1U, 5U}) {
    sim::GeneratorOptions what;
    what.seed = seed;
    what.per_robot = 6;
    const auto program = sim::generate_program(*cell, what).value();
    const auto story = [&](bool prepare) {
      std::vector<std::string> said;
      sim::VirtualOptions options;
      options.strategy = "lookahead";
      options.prepare = prepare;
      options.on_status = [&](const model::CommandStatus& s) {
        said.push_back(s.id.str() + " " + (s.start ? std::to_string(s.start->time_since_epoch().count()) : "") + " " + s.text);
      };
      expect_all_done(sim::run_virtual(cell, program, options));
      return said;
    };
    EXPECT_EQ(story(false), story(true)) << "seed " << seed;
  }
}

TEST(Lookahead, IsNeverLaterThanEventAndTellsTheSameStoryTwice) {
  constexpr double kSame = 1e-6;  // [s] rounding
  Seed seed;
  double event = 0, lookahead = 0;
  for (const char* name : {"pattern-serial-3", "pattern-triangle-3"}) {
    const auto cell = deployed_cell(name);
    sim::GeneratorOptions what;
    what.seed = seed.value();
    what.per_robot = 6;
    const auto program = sim::generate_program(*cell, what).value();
    const auto before = run(cell, program, "event"), ahead = run(cell, program, "lookahead"), again = run(cell, program, "lookahead");
    expect_all_done(ahead);
    EXPECT_LE(ahead.makespan, before.makespan + kSame) << name;
    EXPECT_EQ(ahead.makespan, again.makespan) << name;
    event += before.makespan;
    lookahead += ahead.makespan;
  }
  EXPECT_LT(lookahead, event) << "it must be worth it somewhere";
}

/// What `event` would do is the first plan: without a budget it is followed, and ends sooner only where starts rely on promises.
TEST(Lookahead, WithoutABudgetStartsInTheOrderOfEvent) {
  auto cell = std::make_shared<model::Cell>(*deployed_cell("exp-6-2"));
  cell->planning.budget = 0;
  const auto program = app::load_program(deployed("exp-6-2/program.yaml"), cell.get()).value();
  const double event = run(cell, program, "event").makespan;
  EXPECT_LT(run(cell, program, "lookahead").makespan, event);
  cell->planning.promise = 0;
  EXPECT_NEAR(run(cell, program, "lookahead").makespan, event, 1e-6);
}

TEST(Lookahead, TakesUpCommandsThatComeLater) {
  const auto cell = deployed_cell("exp-6-2");
  auto program = app::load_program(deployed("exp-6-2/program.yaml"), cell.get()).value();
  double at = 0;
  for (auto& [robot, steps] : program.robots) {
    for (auto& step : steps) step.at = at += 0.7;
  }
  expect_all_done(run(cell, program, "lookahead"));
}

/// Regression: r4 relied on r2 leaving, which relied on an escape of r1, which had to wait until r3 had left. r2 could not leave in time.
TEST(Lookahead, ReliesOnNoDepartureThatWaitsForAnotherOne) {
  const auto cell = deployed_cell("pattern-square-4");
  sim::GeneratorOptions what;
  what.seed = 846;
  expect_all_done(run(cell, sim::generate_program(*cell, what).value(), "lookahead"));
}

TEST(Lookahead, SaysForWhomARobotWaits) {
  const auto cell = deployed_cell("exp-6-2");
  const auto program = app::load_program(deployed("exp-6-2/program.yaml"), cell.get()).value();
  sim::VirtualOptions options;
  options.strategy = "lookahead";
  std::size_t said = 0;
  options.on_status = [&](const model::CommandStatus& s) {
    if (s.text.find("go first, which ends sooner") == std::string::npos) return;
    ++said;
    EXPECT_EQ(s.state, model::CommandState::waiting);
    EXPECT_EQ(s.reason, model::Reason::delayed);
  };
  (void)sim::run_virtual(cell, program, options);
  EXPECT_GT(said, 0U);
}

}  // namespace
}  // namespace interlace::test
