#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/e2e/programs.hpp"
#include "tests/e2e/running_cell.hpp"
#include "tests/e2e/scratch.hpp"
#include "tests/e2e/view.hpp"

// What robots hold, with real processes: taken and left, known to everyone, and still known when one of them is another process.
namespace interlace::test {
namespace {

using model::CommandState;
using model::ToolName;

class Tools : public ::testing::Test {
 protected:
  [[nodiscard]] bool holds(const std::string& robot, const std::vector<std::string>& tools) {
    std::vector<ToolName> names;
    for (const std::string& tool : tools) names.emplace_back(tool);
    return view_.until([&] {
      if (!view_.planner() || view_.posture(robot) == nullptr || view_.posture(robot)->posture.holds != names) return false;
      for (const auto& r : view_.planner()->robots) {
        if (r.name.str() == robot) return r.holds == names;
      }
      return false;
    });
  }
  /// r1 takes or leaves something where it stands.
  Outcome r1(const std::vector<std::string>& change) {
    std::vector<std::string> arguments{"send", "r1", "linear", "350", "150", "300", "0", "0", "0"};
    arguments.insert(arguments.end(), change.begin(), change.end());
    return cell_.ask(std::move(arguments));
  }

  Scratch scratch_;
  RunningCell cell_{unique_domain(), "tools-2", deployed("tools-2/cell.yaml")};
  View view_{unique_domain(), "tools-2"};
};

TEST_F(Tools, AreTakenAndLeftAndSeenByEveryone) {
  ASSERT_TRUE(cell_.start());
  EXPECT_TRUE(holds("r1", {}));
  EXPECT_TRUE(holds("r2", {"short"})) << "from the cell file";
  EXPECT_EQ(r1({"--attach", "long"}).exit_code, 0);
  EXPECT_TRUE(holds("r1", {"long"}));
  EXPECT_TRUE(cell_.ask({"status"}).says("holds long"));
  EXPECT_EQ(r1({"--detach", "long", "--when", "start"}).exit_code, 0);
  EXPECT_TRUE(holds("r1", {}));
}

TEST_F(Tools, ThatCannotBeAreRefusedWithTheReason) {
  ASSERT_TRUE(cell_.start());
  const Outcome unknown = r1({"--attach", "saw"});
  EXPECT_EQ(unknown.exit_code, 1);
  EXPECT_TRUE(unknown.says("there is no tool \"saw\" in cell tools-2")) << unknown;
  const Outcome not_held = r1({"--detach", "long"});
  EXPECT_EQ(not_held.exit_code, 1);
  EXPECT_TRUE(not_held.says("rejected: tool")) << not_held;
}

TEST_F(Tools, ProgramsRunWithThemUnderTheEyesOfAnObserver) {
  ASSERT_TRUE(cell_.start());
  const std::string report = scratch_.path("report.json");
  const Outcome o = cell_.ask({"run", deployed("tools-2/program-long.yaml"), "--cell-file", cell_.file(), "--report", report}, 40s);
  EXPECT_EQ(o.exit_code, 0) << o;
  const auto r = nlohmann::json::parse(read_text(report)).at(0);
  EXPECT_EQ(r["completed"], 6);
  EXPECT_EQ(r["collisions"], 0);
  bool waited_for_the_tool = false;
  for (const auto& c : r["commands"]) {
    for (const auto& conflict : c["conflicts"]) waited_for_the_tool = waited_for_the_tool || conflict["link"] == "long";
  }
  EXPECT_TRUE(waited_for_the_tool) << r;
  EXPECT_TRUE(holds("r1", {})) << "it has left it";
}

TEST_F(Tools, AreStillKnownToThePlannerThatFollows) {
  ASSERT_TRUE(cell_.start());
  ASSERT_EQ(r1({"--attach", "long"}).exit_code, 0);
  cell_.planner().kill(SIGKILL);
  cell_.start_planner();
  ASSERT_TRUE(cell_.knows("r1") && cell_.knows("r2"));
  EXPECT_TRUE(holds("r1", {"long"}));
  const Outcome twice = r1({"--attach", "long"});
  EXPECT_EQ(twice.exit_code, 1);
  EXPECT_TRUE(twice.says("would take long, which it will hold already")) << twice;
  EXPECT_EQ(r1({"--detach", "long"}).exit_code, 0);
}

}  // namespace
}  // namespace interlace::test
