#include "simulator/reproduce/command_chart.hpp"

#include <gtest/gtest.h>

#include "tests/support/arms.hpp"
#include "tests/unit/reproduce/pictures.hpp"

namespace interlace::reproduce {
namespace {

model::Cell two_arms() {
  model::Cell cell;
  for (const char* name : {"r1", "r2"}) {
    model::Robot robot;
    robot.name = model::RobotName{name};
    robot.model = test::arm4();
    cell.robots.push_back(robot);
  }
  return cell;
}

app::CommandRow row(const std::string& id, const std::string& robot, std::optional<double> start, std::optional<double> end) {
  app::CommandRow r;
  r.id = model::CommandId{id};
  r.robot = model::RobotName{robot};
  r.start = start;
  r.end = end;
  r.state = end ? model::CommandState::completed : model::CommandState::waiting;
  return r;
}

TEST(CommandChart, HasOneBoxPerStartedCommandAndOnePerEscape) {
  app::RunReport report;
  report.commands = {row("r1-1", "r1", 0, 2), row("r2-1", "r2", 3, 5), row("r1-2", "r1", 2, 4), row("e-1", "r2", 0.5, 1),
                     row("r2-2", "r2", {}, {})};
  report.commands[3].escape = true;
  NamedCommands named;
  named[model::CommandId{"r1-1"}].label = "C11";
  named[model::CommandId{"r2-2"}].label = "C22 & <more>";
  const std::string svg = command_chart("title", report, two_arms(), named, last_end(report));
  EXPECT_EQ(test::fault_in_xml(svg), "") << svg;
  EXPECT_EQ(test::count_of(svg, "class=\"command\""), 3U);
  EXPECT_EQ(test::count_of(svg, "class=\"escape\" fill=\"#000000\""), 1U);
  EXPECT_EQ(test::count_of(svg, ">C11</text>"), 1U);
  EXPECT_EQ(test::count_of(svg, ">r1-2</text>"), 1U) << "a command without a name is called by its id";
  EXPECT_EQ(test::count_of(svg, "never starts"), 1U);
}

TEST(CommandChart, DrawsWaitsBetweenMotions) {
  app::RunReport report;  // r2 stands 0 to 0.5, 1 to 3 and, for its last command, from 5 on; r1 never waits
  report.commands = {row("r1-1", "r1", 0, 6), row("e-1", "r2", 0.5, 1), row("r2-1", "r2", 3, 5), row("r2-2", "r2", {}, {})};
  report.commands[1].escape = true;
  const std::string svg = command_chart("title", report, two_arms(), {}, last_end(report));
  EXPECT_EQ(test::count_of(svg, "class=\"waiting\""), 3U);
}

TEST(CommandChart, ARejectedCommandIsNotWaitedFor) {
  app::RunReport report;
  report.commands = {row("r1-1", "r1", {}, {}), row("r1-2", "r1", 0, 1)};
  report.commands[0].state = model::CommandState::rejected;
  const std::string svg = command_chart("title", report, two_arms(), {}, last_end(report));
  EXPECT_EQ(test::count_of(svg, "class=\"command\""), 1U);
  EXPECT_EQ(test::count_of(svg, "class=\"waiting\""), 0U);
}

}  // namespace
}  // namespace interlace::reproduce
