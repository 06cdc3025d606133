#include "simulator/optimum.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "tests/unit/simulator/cells.hpp"

/// The yardstick on the dissertation's experiments and on programs with known answers.
namespace interlace::test {
namespace {

sim::Optimum optimum_of(const std::string& name, const std::function<void(model::Program&)>& change = {}, bool confirmed = false,
                        double promise = 0) {
  const auto cell = deployed_cell(name);
  auto program = app::load_program(deployed(name + "/program.yaml"), cell.get());
  if (!program) throw std::runtime_error(to_string(program.error()));
  if (change) change(*program);
  sim::OptimumOptions options;
  options.confirmed = confirmed;
  options.promise = promise;
  const auto found = sim::least_makespan(*cell, *program, options);
  if (!found) throw std::runtime_error(found.error());
  return *found;
}

/// Against the figures of the search that came before this one, with lattices of other steps: 0.1 s.
TEST(Optimum, OfTheExperiments) {
  constexpr double kTolerance = 0.1;
  EXPECT_NEAR(optimum_of("exp-4-1").makespan.value(), 41.22, kTolerance);
  EXPECT_NEAR(optimum_of("exp-4-2").makespan.value(), 28.90, kTolerance);
  EXPECT_NEAR(optimum_of("exp-5-1").makespan.value(), 39.78, kTolerance);
  const auto three = optimum_of("exp-6-1");
  EXPECT_NEAR(three.makespan.value(), 36.15, kTolerance);
  EXPECT_TRUE(three.exact);
  EXPECT_FALSE(optimum_of("exp-6-2").exact) << "four robots have a bound";
}

/// What the planner does in virtual time on four of the experiments cannot be done sooner by sending starts that are clear of everybody
/// whatever becomes of the others. Strategy `event` takes 41.72, 29.03, 42.39 and 40.11 s; tolerance: two steps of the lattices.
TEST(Optimum, OfStartsThatRelyOnNobodyIsWhatThePlannerReaches) {
  const auto confirmed = [](const std::string& name) { return optimum_of(name, {}, true).makespan.value(); };
  EXPECT_NEAR(confirmed("exp-4-1"), 41.72, 0.02);
  EXPECT_NEAR(confirmed("exp-4-2"), 29.03, 0.02);
  EXPECT_NEAR(confirmed("exp-5-1"), 42.39, 0.02);
  EXPECT_NEAR(confirmed("exp-6-1"), 40.11, 0.04);
}

/// How long a promised departure must be relied on for the targets of strategy `lookahead`: 40.57 s in 5.1, 37.23 s in 6.1.
TEST(Optimum, ComesDownAsDeparturesAreReliedOnForLonger) {
  const auto promised = [](const std::string& name, double promise) { return optimum_of(name, {}, true, promise).makespan.value(); };
  EXPECT_NEAR(promised("exp-5-1", 1), 41.40, 0.02);
  EXPECT_NEAR(promised("exp-5-1", 2), 40.40, 0.02);
  EXPECT_NEAR(promised("exp-5-1", 5), optimum_of("exp-5-1").makespan.value(), 0.02);
  EXPECT_NEAR(promised("exp-6-1", 1), 37.14, 0.04);
}

TEST(Optimum, OfOneRobotIsLess) {
  const auto alone = optimum_of("exp-4-1", [](model::Program& p) { p.robots.resize(1); });
  const auto both = optimum_of("exp-4-1");
  EXPECT_LT(alone.makespan.value(), both.makespan.value());
}

TEST(Optimum, NobodyIsDoneBeforeItsRelease) {
  const auto late = optimum_of("exp-4-1", [](model::Program& p) { p.robots[0].second.back().at = 100; });
  EXPECT_GT(late.makespan.value(), 100);
  EXPECT_FALSE(late.exact);
}

TEST(Optimum, NamesTheCommandThatIsInadmissible) {
  const auto cell = deployed_cell("exp-4-1");
  auto program = app::load_program(deployed("exp-4-1/program.yaml"), cell.get()).value();
  std::get<model::LinearTarget>(program.robots[1].second[2].motion.target).X_WT.translation().x() = 5;
  const auto found = sim::least_makespan(*cell, program, {});
  ASSERT_FALSE(found);
  EXPECT_NE(found.error().find("r2, command 3"), std::string::npos) << found.error();
}

}  // namespace
}  // namespace interlace::test
