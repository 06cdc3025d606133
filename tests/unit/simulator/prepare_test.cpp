#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "common/app/config/cell_file.hpp"
#include "common/app/config/program_file.hpp"
#include "simulator/virtual_cell.hpp"

/// What a planner does while nothing is due changes how long its decisions take, and nothing else.
namespace interlace::test {
namespace {

struct Run {
  std::vector<std::string> decisions;  // in words, in order
  core::MapStatistics maps;
};

Run run(const std::string& folder, const std::string& program, const std::string& strategy, bool prepare) {
  const std::string base = std::string{INTERLACE_CELLS_DIR} + "/" + folder + "/";
  const auto cell = std::make_shared<const model::Cell>(std::move(app::load_cell(base + "cell.yaml").value().cell));
  const auto steps = app::load_program(base + program, cell.get()).value();
  Run r;
  sim::VirtualOptions options;
  options.strategy = strategy;
  options.prepare = prepare;
  options.observe = false;
  options.check_period = 1;
  options.on_decision = [&](double, const core::Decisions& d) {
    for (const auto& s : d.statuses) {
      r.decisions.push_back(fmt::format("{} {} {} {} {:.9f} {} {} {}", s.id.str(), s.robot.str(), model::to_string(s.state),
                                        model::to_string(s.reason), s.start ? model::to_seconds(*s.start) : -1, s.text, s.conflicts.size(),
                                        s.refusals.size()));
    }
    for (const auto& x : d.dispatches)
      r.decisions.push_back(fmt::format("{} {:.9f} {:.9f}", x.id.str(), model::to_seconds(x.earliest), model::to_seconds(x.latest)));
    for (const auto& w : d.withdrawals) r.decisions.push_back("withdrawn " + w.id.str());
  };
  options.on_maps = [&](const core::MapStatistics& m) { r.maps = m; };
  (void)sim::run_virtual(cell, steps, options);
  return r;
}

void expect_the_same(const std::string& folder, const std::string& program, const std::string& strategy) {
  SCOPED_TRACE(folder + " " + strategy);
  const Run without = run(folder, program, strategy, false);
  const Run with = run(folder, program, strategy, true);
  EXPECT_EQ(without.decisions, with.decisions);
  EXPECT_GT(without.decisions.size(), 40U);
  EXPECT_GT(with.maps.built, without.maps.built) << "some maps are prepared in vain";
  EXPECT_EQ(with.maps.evicted, 0U);
}

TEST(Prepare, ChangesNoDecisionOfTwoArms) {
  expect_the_same("exp-4-2", "program.yaml", "event");
}

TEST(Prepare, ChangesNoDecisionWithEscapes) {
  expect_the_same("exp-6-1", "program.yaml", "event");
  expect_the_same("exp-5-2", "program.yaml", "acm");
}

TEST(Prepare, ChangesNoDecisionOfFourArms) {
  expect_the_same("pattern-square-4", "program-1.yaml", "event");
}

}  // namespace
}  // namespace interlace::test
