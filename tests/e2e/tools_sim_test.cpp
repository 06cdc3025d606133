#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/e2e/programs.hpp"
#include "tests/e2e/scratch.hpp"

// One program with three tools: safe at once, safe one after the other, impossible.
namespace interlace::test {
namespace {

class ToolsInVirtualTime : public ::testing::Test {
 protected:
  Outcome simulate(const std::string& tool, const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments{kSim, deployed("tools-2/cell.yaml"), deployed("tools-2/program-" + tool + ".yaml"), "--report",
                                       scratch_.path("report.json")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(std::move(arguments));
  }
  [[nodiscard]] nlohmann::json report() const { return nlohmann::json::parse(read_text(scratch_.path("report.json"))).at(0); }
  [[nodiscard]] nlohmann::json command(const std::string& id) const {
    const auto all = report();
    for (const auto& c : all["commands"]) {
      if (c["id"] == id) return c;
    }
    ADD_FAILURE() << "no command " << id;
    return {};
  }
  Scratch scratch_;
};

TEST_F(ToolsInVirtualTime, TheShortOnePassesAtOnce) {
  const Outcome o = simulate("short");
  EXPECT_EQ(o.exit_code, 0) << o;
  const auto r = report();
  EXPECT_EQ(r["completed"], 6);
  for (const auto& c : r["commands"]) EXPECT_LT(c["delay_s"], 0.005) << c;
}

TEST_F(ToolsInVirtualTime, TheLongOneWaitsAndSaysForWhat) {
  const Outcome o = simulate("long");
  EXPECT_EQ(o.exit_code, 0) << o;
  EXPECT_EQ(report()["completed"], 6);
  EXPECT_EQ(report()["collisions"], 0);
  const auto delayed = command("r1-2");
  EXPECT_EQ(delayed["reason"], "delayed");
  EXPECT_GT(delayed["delay_s"], 1.0);
  EXPECT_EQ(delayed["conflicts"].at(0)["link"], "long") << delayed;
  EXPECT_EQ(delayed["conflicts"].at(0)["blocker_link"], "short") << "what r2 holds from the start";
}

TEST_F(ToolsInVirtualTime, TheBoomIsRejectedByName) {
  const Outcome o = simulate("boom");
  EXPECT_EQ(o.exit_code, 1) << o;
  EXPECT_EQ(report()["rejected"], 1);
  EXPECT_EQ(report()["collisions"], 0);
  EXPECT_TRUE(o.says("boom would touch base of r2 at ")) << o;
}

TEST_F(ToolsInVirtualTime, TheObserverSeesTheToolsThatNobodyLooksOutFor) {
  const Outcome o = simulate("long", {"--strategy", "direct"});
  EXPECT_EQ(o.exit_code, 3) << o;
}

TEST_F(ToolsInVirtualTime, ATypingErrorIsToldWithItsPlace) {
  const std::string text = read_text(deployed("tools-2/program-long.yaml"));
  const auto at = text.find("attach: long");
  ASSERT_NE(at, std::string::npos);
  const std::string file = scratch_.file("program.yaml", text.substr(0, at) + "attach: lnog" + text.substr(at + 12));
  const Outcome o = run({kSim, deployed("tools-2/cell.yaml"), file});
  EXPECT_EQ(o.exit_code, 2) << o;
  EXPECT_TRUE(o.says("program.r1[0].attach: found \"lnog\"")) << o;
  EXPECT_TRUE(o.says("did you mean \"long\"?")) << o;
}

}  // namespace
}  // namespace interlace::test
