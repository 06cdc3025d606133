#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>

#include "tests/e2e/cells.hpp"
#include "tests/e2e/running_cell.hpp"
#include "tests/e2e/scratch.hpp"

// A mesh table in front of r1 and a fence between both robots: who would run into one is told which, where and with which link; others run.
namespace interlace::test {
namespace {

/// A slab of 200 × 200 × 100 mm on z = 0.
constexpr const char* kTable =
    "v -100 -100 0\nv 100 -100 0\nv -100 100 0\nv 100 100 0\nv -100 -100 100\nv 100 -100 100\nv -100 100 100\nv 100 100 100\n"
    "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";

class Fixtures : public ::testing::Test {
 protected:
  Fixtures() {
    scratch_.file("table.obj", kTable);
    CellText text;
    text.fixtures =
        "  - {name: fence, type: box, size: [200, 10, 250], pose: {xyz: [250, 0, 125], rpy: [0, 0, 0]}}\n"
        "  - {name: table, type: mesh, file: table.obj, pose: {xyz: [480, 250, 0], rpy: [0, 0, 0]}}\n";
    cell_ = scratch_.file("cell.yaml", cell_text(text));
    program_ = scratch_.file("program.yaml", program_text({linear(300, 50, 200), linear(450, 250, 130), linear(400, 250, 330)},
                                                          {linear(300, -250, 330), linear(300, -50, 200)}));
  }

  /// Of r1's commands the first two and of r2's the second would touch something; the others are carried out.
  void expect_told(const nlohmann::json& report) const {
    EXPECT_EQ(report["submitted"], 5);
    EXPECT_EQ(report["rejected"], 3);
    EXPECT_EQ(report["completed"], 2);
    EXPECT_EQ(report["collisions"], 0);
    EXPECT_TRUE(report["fixture_contacts"].empty());
    EXPECT_GT(report["min_clearance_m"], 0);
    std::map<std::string, int> named;
    for (const auto& row : report["commands"]) {
      if (row["state"] != "rejected") continue;
      EXPECT_EQ(row["reason"], "fixture_collision") << row;
      const std::string why = row["explanation"];
      EXPECT_NE(why.find("link2 would touch fixture "), std::string::npos) << why;
      EXPECT_NE(why.find(" % of the path, TCP at ("), std::string::npos) << why;
      ++named[row["robot"].get<std::string>() + (why.find("fixture fence after ") != std::string::npos   ? " fence"
                                                 : why.find("fixture table after ") != std::string::npos ? " table"
                                                                                                         : " ?")];
    }
    EXPECT_EQ(named, (std::map<std::string, int>{{"r1 fence", 1}, {"r1 table", 1}, {"r2 fence", 1}}));
  }

  Scratch scratch_;
  std::string cell_, program_;
};

TEST_F(Fixtures, InVirtualTimeCommandsThroughThemAreRejectedAndOthersRun) {
  const std::string report = scratch_.path("report.json");
  const Outcome o = run({kSim, cell_, program_, "--report", report});
  EXPECT_EQ(o.exit_code, 1) << o;
  EXPECT_TRUE(o.says("would touch fixture fence after ") && o.says("would touch fixture table after ")) << o;
  expect_told(nlohmann::json::parse(read_text(report)).at(0));
}

TEST_F(Fixtures, OverDdsCommandsThroughThemAreRejectedAndOthersRun) {
  RunningCell cell{unique_domain(), "fast", cell_};
  ASSERT_TRUE(cell.start());
  const std::string report = scratch_.path("report.json");
  const Outcome o = cell.ask({"run", program_, "--cell-file", cell_, "--report", report}, 30s);
  EXPECT_EQ(o.exit_code, 1) << o;
  expect_told(nlohmann::json::parse(read_text(report)).at(0));
  const Outcome sent = outcome(cell.send("r1", "down", {450, 250, 130}));
  EXPECT_EQ(sent.exit_code, 1) << sent;
  EXPECT_TRUE(sent.says("fixture_collision") && sent.says("link2 would touch fixture table after ")) << sent;
}

TEST_F(Fixtures, AMeshThatIsNotThereIsToldWithItsPlaceInTheCellFile) {
  std::filesystem::remove(scratch_.path("table.obj"));
  const Outcome o = run({kSim, cell_, program_});
  EXPECT_EQ(o.exit_code, 2) << o;
  EXPECT_TRUE(o.says("cell.yaml:") && o.says("fixtures[1].file: found \"table.obj\", ")) << o;
}

}  // namespace
}  // namespace interlace::test
