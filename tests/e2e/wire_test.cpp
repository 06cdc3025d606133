#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "common/dds/convert.hpp"
#include "tests/e2e/cells.hpp"
#include "tests/e2e/running_cell.hpp"
#include "tests/e2e/scratch.hpp"
#include "tests/e2e/view.hpp"
#include "tests/integration/dds/raw_writer.hpp"

// Strangers on the wire of a running cell: those who break the rules are refused and counted, one of another vendor who keeps them is
// served.
namespace interlace::test {
namespace {

using model::ExecutionState;

class Wire : public ::testing::Test {
 protected:
  Scratch scratch_;
  RunningCell cell_{unique_domain(), "fast", scratch_.file("cell.yaml", cell_text())};
  View view_{unique_domain(), "fast"};
};

/// A command of r1 that breaks no rule.
::interlace::Command good_command() {
  model::CommandSubmitted c;
  c.id = model::CommandId{"foreign"};
  c.robot = model::RobotName{"r1"};
  c.motion.target = model::LinearTarget{model::make_pose({0.3, 0.25, 0.33}, model::Quaternion::Identity())};
  return dds::to_wire(dds::CommandMessage{c, "stranger"});
}

TEST_F(Wire, BadCommandsDuringARunAreRefusedAndCountedAndDisturbNothing) {
  ASSERT_TRUE(cell_.start());
  dds::Participant stranger{{unique_domain(), "stranger"}};
  RawWriter<::interlace::Command> writer{stranger, dds::topics::command("fast", model::RobotName{"r1"}).name, dds::qos::Stream::command};
  Process& run = cell_.client({"run", scratch_.file("program.yaml", table_4_4(2))});
  ASSERT_TRUE(view_.until([&] { return view_.planner() && view_.planner()->accepted == 16 && view_.moving("r1"); }));

  const std::vector<std::pair<std::string, std::function<void(::interlace::Command&)>>> spoilings{
      {"motion.position.x: nan", [](auto& c) { c.motion().position().x(std::numeric_limits<double>::quiet_NaN()); }},
      {"robot: 'r9'", [](auto& c) { c.robot("r9"); }},
      {"kind: 7", [](auto& c) { c.kind(static_cast<::interlace::CommandKind>(7)); }},
  };
  for (const auto& [what, spoil] : spoilings) {
    const auto before = view_.planner()->refused_samples;
    ::interlace::Command bad = good_command();
    spoil(bad);
    // Written until it is counted: what is written before the planner's reader is known to this writer is lost.
    EXPECT_TRUE(view_.until([&] { return view_.planner()->refused_samples > before || !writer.write(bad); })) << what;
    EXPECT_TRUE(cell_.planner().logs(what, kPatience)) << "not in the log: " << what;
  }
  EXPECT_TRUE(run.running()) << "it was over before all was said";

  const Outcome o = outcome(run, 30s);
  EXPECT_EQ(o.exit_code, 0) << o;
  ASSERT_TRUE(view_.until([&] { return view_.planner()->completed == 16; }));
  EXPECT_EQ(view_.planner()->accepted, 16u);
  EXPECT_EQ(view_.planner()->rejected, 0u);
  EXPECT_GE(view_.planner()->refused_samples, 3u);
  EXPECT_EQ(view_.status("foreign"), nullptr) << "a refused sample is not answered";
  EXPECT_EQ(view_.executions(ExecutionState::started, "foreign"), 0u);
}

TEST_F(Wire, APeerOfAnotherVendorReadsPosturesAndIsServed) {
  ASSERT_TRUE(cell_.start());
  const std::string domain = std::to_string(unique_domain());
  const Outcome postures = run({INTERLACE_CYCLONE_PEER, domain, "fast", "r1", "postures", "20", "20"}, 30s);
  EXPECT_EQ(postures.exit_code, 0) << postures;
  EXPECT_EQ(Process::count(postures.output, "r1 joints "), 20u) << postures;
  EXPECT_TRUE(postures.says("position 0.450000 0.250000 0.300000")) << postures;

  const Outcome command =
      run({INTERLACE_CYCLONE_PEER, domain, "fast", "r1", "command", "from-afar", "0.3", "0.25", "0.33", "1", "0", "0", "0", "20"}, 30s);
  EXPECT_EQ(command.exit_code, 0) << command;
  EXPECT_TRUE(command.says("from-afar completed")) << command;
  ASSERT_TRUE(view_.until([&] { return view_.planner() && view_.planner()->completed == 1; }));
  EXPECT_TRUE(view_.until([&] { return view_.stands_at("r1", {0.3, 0.25, 0.33}); }));
}

}  // namespace
}  // namespace interlace::test
