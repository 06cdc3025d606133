#include "simulator/reproduce/map_picture.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "simulator/reproduce/results_page.hpp"
#include "tests/unit/reproduce/pictures.hpp"

namespace interlace::reproduce {
namespace {

Case experiment_4_2() {
  const std::string folder = std::string{INTERLACE_CELLS_DIR} + "/exp-4-2";
  auto input = load_case(folder + "/cell.yaml", folder + "/program.yaml");
  EXPECT_TRUE(input) << input.error();
  return std::move(*input);
}

/// Whether the motion, started at `start`, is inside an area some time.
bool meets(const MapSubject& s, const std::vector<core::CollisionArea>& areas, double start) {
  for (double tau = 0; tau <= s.motion.duration(); tau += 0.005) {
    const double length = s.motion.length(tau);
    for (const auto& a : areas) {
      if (start + tau > a.t0 && start + tau < a.t1 && length > a.length0 && length < a.length1) return true;
    }
  }
  return false;
}

TEST(NamedCommands, AreCountedAsInTheDissertationAndAgainInEachRepetition) {
  const NamedCommands named = named_commands(experiment_4_2());
  ASSERT_EQ(named.size(), 16U);
  EXPECT_EQ(named.at(model::CommandId{"r1-1"}).label, "C11");
  EXPECT_EQ(named.at(model::CommandId{"r2-4"}).label, "C24");
  EXPECT_EQ(named.at(model::CommandId{"r2-6"}).label, "C22");
}

TEST(MapPicture, ShowsTheAreasAndBothTrajectories) {
  const Case input = experiment_4_2();
  const StrategyRun run = run_strategy(input, "event", true);
  const auto subject = first_delayed(input, run, named_commands(input));
  ASSERT_TRUE(subject);
  EXPECT_EQ(subject->label, "C22");
  EXPECT_EQ(subject->moving.front().label, "C12");
  const auto areas = collision_areas(*subject, input.cell->planning);
  ASSERT_FALSE(areas.empty());
  EXPECT_TRUE(meets(*subject, areas, subject->ready));
  EXPECT_FALSE(meets(*subject, areas, subject->start)) << "the chosen start crosses no area";

  const std::string svg = map_picture("C22 against C12", *subject, areas);
  EXPECT_EQ(test::fault_in_xml(svg), "");
  const auto area = svg.find("class=\"area\"");
  ASSERT_NE(area, std::string::npos);
  EXPECT_NE(svg.find("<path d=\"M"), std::string::npos);
  EXPECT_EQ(test::count_of(svg, "class=\"original\""), 1U);
  EXPECT_EQ(test::count_of(svg, "class=\"chosen\""), 1U);
}

TEST(Pictures, AreTheSameBytesEachTime) {
  const auto make = [] {
    ExperimentRun run{experiments()[1], experiment_4_2(), {}};
    for (const char* strategy : {"direct", "event"}) run.runs.push_back(run_strategy(run.input, strategy, true));
    return run;
  };
  Results results;
  results.experiments.push_back(make());
  const auto first = pictures(results.experiments[0]);
  const auto second = pictures(make());
  ASSERT_EQ(first.size(), 4U) << "two charts, the distances, the map";
  ASSERT_EQ(second.size(), first.size());
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(first[i].file, second[i].file);
    EXPECT_TRUE(first[i].svg == second[i].svg) << first[i].file;
    EXPECT_EQ(test::fault_in_xml(first[i].svg), "") << first[i].file;
  }
  const std::string page = results_page(results, {first});
  for (const Picture& p : first) EXPECT_NE(page.find("(results/" + p.file + ")"), std::string::npos) << p.file;
}

TEST(LoadCase, NamesTheFileItCannotRead) {
  const auto input = load_case("nowhere/cell.yaml", "nowhere/program.yaml");
  ASSERT_FALSE(input);
  EXPECT_NE(input.error().find("nowhere/cell.yaml"), std::string::npos) << input.error();
}

}  // namespace
}  // namespace interlace::reproduce
