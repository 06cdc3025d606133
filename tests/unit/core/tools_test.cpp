#include <gtest/gtest.h>

#include "common/model/bodies.hpp"
#include "planner/core/eef_map.hpp"
#include "planner/core/neighbourhood.hpp"
#include "tests/unit/core/desk.hpp"

/// What robots hold: admitted, moved with, seen by others, and told by those who know.
namespace interlace::test {
namespace {

using model::ToolName;
using model::ToolSet;
using model::ToolTime;

model::Tool rod(const std::string& name, double length) {
  return {ToolName{name}, {{name, 6, {0, 0, 0}, {0, 0, length}, 0.03}}};
}

/// Two arms that face each other, 1.1 m apart, their hands 0.4 m; the tools are rods straight ahead. r2 starts with the short one.
std::shared_ptr<model::Cell> facing() {
  auto cell = std::make_shared<model::Cell>();
  cell->name = "facing";
  cell->tools = {rod("short", 0.06), rod("long", 0.25), rod("boom", 0.7)};
  cell->robots = {experiment_robot("r1", {0, 0, 0}, pose_mm(350, 150, 300)),
                  experiment_robot("r2", {1.1, 0, 0}, pose_mm(750, 150, 300, 0, 0, 180), kPi)};
  cell->robots[1].holds = {ToolName{"short"}};
  return cell;
}

model::MotionRequest with(model::MotionRequest request, const std::string& attach, const std::string& detach = {},
                          ToolTime when = ToolTime::completion) {
  request.tools = model::ToolChange{ToolName{attach}, ToolName{detach}, when};
  return request;
}

model::MotionRequest r1_to(double y) {
  return line_to(pose_mm(350, y, 300));
}
model::MotionRequest r2_to(double y) {
  return line_to(pose_mm(750, y, 300, 0, 0, 180));
}

class Tools : public ::testing::Test {
 protected:
  Tools() {
    desk.hands["r2"] = {ToolName{"short"}};
    desk.all_stand();
  }
  /// The robot takes (or leaves) what its command says, as its proxy reports.
  void carry_out(const std::string& id, std::vector<ToolName> then) {
    const auto d = desk.dispatch_of(id);
    desk.begin(d);
    desk.hands[d.robot.str()] = std::move(then);
    desk.finish(d);
  }
  [[nodiscard]] std::vector<ToolName> held(std::size_t robot) const { return desk.planner.state(desk.now).robots[robot].holds; }

  Desk desk{facing(), Desk::without_escapes()};
};

TEST(ToolSteps, SayWhatIsHeldBeforeDuringAndAfter) {
  const auto cell = facing();
  const ToolSet held = ToolSet::of(0);
  const auto steps = [&](const char* attach, const char* detach, ToolTime when) {
    return model::tool_steps(*cell, cell->robots[0].name, held, model::ToolChange{ToolName{attach}, ToolName{detach}, when});
  };
  const auto at_end = steps("long", "short", ToolTime::completion);
  ASSERT_TRUE(at_end);
  EXPECT_EQ(at_end->during, held);
  EXPECT_EQ(at_end->after, ToolSet::of(1));
  EXPECT_EQ(at_end->at_end(), held | ToolSet::of(1));
  const auto at_start = steps("long", "", ToolTime::start);
  ASSERT_TRUE(at_start);
  EXPECT_EQ(at_start->during, held | ToolSet::of(1));
  EXPECT_EQ(at_start->at_start(), at_start->during);
  EXPECT_EQ(steps("", "long", ToolTime::start).error(), "r1 would leave long, which it will not hold then");
  EXPECT_EQ(steps("short", "", ToolTime::start).error(), "r1 would take short, which it will hold already");
  EXPECT_EQ(steps("saw", "", ToolTime::start).error(), "there is no tool \"saw\" in cell facing");
}

TEST(ToolSteps, ANameNobodyKnowsStandsForAllTools) {
  const auto cell = facing();
  EXPECT_EQ(cell->set_of({ToolName{"saw"}}), cell->all_tools());
  EXPECT_EQ(cell->names_of(cell->set_of({ToolName{"boom"}, ToolName{"short"}})).size(), 2U);
}

TEST(Bodies, AToolIsAPartOfTheLastLinkKeptOffTheArmBehindTheElbow) {
  const auto cell = facing();
  model::Bodies bodies{*cell};
  EXPECT_EQ(&bodies.of(0, {}), &cell->robots[0]) << "a robot that holds nothing is the cell's own";
  const model::Robot& body = bodies.of(0, ToolSet::of(1));
  EXPECT_EQ(&bodies.of(0, ToolSet::of(1)), &body);
  ASSERT_EQ(body.model.capsules.size(), 5U);
  EXPECT_EQ(body.model.capsules[4].name, "long");
  const std::vector<std::pair<std::size_t, std::size_t>> pairs{{0, 3}, {0, 4}, {1, 4}};
  EXPECT_EQ(body.model.self_pairs, pairs);
}

TEST(Bodies, NeighboursAreThoseThatMeetWithTheLargestTools) {
  auto cell = facing();
  cell->robots[1].X_WB.translation().x() = 2.4;
  EXPECT_TRUE(core::Neighbourhood{*cell}.meet(0, 1)) << "boom to boom";
  cell->tools.pop_back();
  EXPECT_FALSE(core::Neighbourhood{*cell}.meet(0, 1));
}

TEST_F(Tools, ChangesThatCannotBeAreRejectedWithTheReason) {
  desk.submit("unknown", "r1", with(r1_to(-150), "saw"));
  desk.submit("held", "r2", with(r2_to(-150), "short"));
  desk.submit("not-held", "r1", with(r1_to(-150), "", "long"));
  for (const char* id : {"unknown", "held", "not-held"}) {
    EXPECT_EQ(desk.status_of(id).state, CommandState::rejected) << id;
    EXPECT_EQ(desk.status_of(id).reason, Reason::tool) << id;
  }
  EXPECT_EQ(desk.status_of("unknown").text, "there is no tool \"saw\" in cell facing");
}

TEST_F(Tools, ACommandIsJudgedWithWhatItsRobotWillHoldWhenItsTurnComes) {
  desk.submit("take", "r1", with(r1_to(100), "long"));
  desk.submit("leave", "r1", with(r1_to(120), "", "long"));
  desk.submit("leave-again", "r1", with(r1_to(140), "", "long"));
  EXPECT_NE(desk.status_of("leave").state, CommandState::rejected);
  EXPECT_EQ(desk.status_of("leave-again").state, CommandState::rejected);
}

TEST_F(Tools, WhatACancelledCommandWouldHaveTakenCannotBeLeft) {
  desk.submit("first", "r1", r1_to(0));
  desk.submit("take", "r1", with(r1_to(100), "long"));
  desk.submit("leave", "r1", with(r1_to(120), "", "long"));
  desk.cancel("take", "r1");
  EXPECT_EQ(desk.status_of("leave").state, CommandState::rejected);
  EXPECT_EQ(desk.status_of("leave").reason, Reason::tool);
  EXPECT_EQ(desk.status_of("leave").text,
            "no longer possible with what the robot holds now: r1 would leave long, which it will not hold then");
}

TEST_F(Tools, WhatAFailedCommandDidNotTakeCannotBeLeft) {
  desk.submit("take", "r1", with(r1_to(100), "long"));
  desk.submit("leave", "r1", with(r1_to(120), "", "long"));
  const auto d = desk.dispatch_of("take");
  desk.begin(d);
  desk.report(d, model::ExecutionState::failed, d.from, "stopped");
  EXPECT_EQ(desk.status_of("leave").state, CommandState::rejected);
  EXPECT_TRUE(held(0).empty());
}

TEST_F(Tools, WhatIsTakenOnCompletionIsInTheWayFromThereOn) {
  desk.submit("bare", "r1", r1_to(-150));
  carry_out("bare", {});
  desk.submit("past", "r2", r2_to(-150));
  EXPECT_EQ(desk.status_of("past").state, CommandState::scheduled) << "short tool to bare hand: room enough";
  carry_out("past", {ToolName{"short"}});
  desk.submit("aside", "r2", r2_to(150));
  carry_out("aside", {ToolName{"short"}});

  desk.submit("take", "r1", with(r1_to(-140), "boom"));
  desk.submit("meets", "r2", r2_to(-150));
  EXPECT_EQ(desk.status_of("meets").reason, Reason::blocked) << "it will be there for good";
  ASSERT_FALSE(desk.status_of("meets").conflicts.empty());
  EXPECT_EQ(desk.status_of("meets").conflicts.front().blocker_link, "boom") << "although it is taken only at the end";
  carry_out("take", {ToolName{"boom"}});
  EXPECT_EQ(held(0), std::vector{ToolName{"boom"}});
  EXPECT_EQ(desk.dispatches_of("meets"), 0U);
}

TEST_F(Tools, WhatIsLeftOnStartIsInTheWayUntilThen) {
  desk.submit("take", "r1", with(r1_to(-150), "boom"));
  carry_out("take", {ToolName{"boom"}});
  desk.submit("meets", "r2", r2_to(-150));
  EXPECT_EQ(desk.dispatches_of("meets"), 0U);
  desk.submit("leave", "r1", with(r1_to(-100), "", "boom", ToolTime::start));
  const auto leave = desk.dispatch_of("leave");
  EXPECT_EQ(leave.holds, std::vector{ToolName{"boom"}}) << "planned with what is held before the change";
  EXPECT_EQ(desk.dispatches_of("meets"), 0U) << "nobody knows yet that it has been left";
  desk.hands["r1"] = {};
  desk.begin(leave);
  desk.pass(100ms);
  EXPECT_EQ(desk.dispatches_of("meets"), 1U);
}

TEST_F(Tools, ItIsInTheHandOnTheWayWhenItIsTakenOnStart) {
  desk.submit("at-start", "r1", with(r1_to(300), "boom", "", ToolTime::start));
  EXPECT_EQ(desk.status_of("at-start").reason, Reason::blocked);
  ASSERT_FALSE(desk.status_of("at-start").conflicts.empty());
  EXPECT_EQ(desk.status_of("at-start").conflicts.front().own_link, "boom");
  desk.cancel("at-start", "r1");
  desk.submit("at-end", "r1", with(r1_to(300), "boom"));
  EXPECT_EQ(desk.status_of("at-end").state, CommandState::scheduled) << "r2 is not in the way there";
}

TEST_F(Tools, APlannerLearnsFromAPostureWhatIsHeld) {
  Desk restarted{facing(), Desk::without_escapes()};
  restarted.hands["r1"] = {ToolName{"long"}};
  restarted.hands["r2"] = {ToolName{"short"}};
  restarted.all_stand();
  restarted.submit("leave", "r1", with(r1_to(100), "", "long"));
  EXPECT_EQ(restarted.status_of("leave").state, CommandState::scheduled);
}

TEST_F(Tools, SomethingNewInAHandTakesBackWhatWasDecidedWithoutIt) {
  desk.submit("wait", "r2", r2_to(-150));
  ASSERT_EQ(desk.dispatches_of("wait"), 1U);
  desk.hands["r1"] = {ToolName{"boom"}};
  desk.stands("r1", desk.robot("r1").start);
  ASSERT_EQ(desk.withdrawals.size(), 1U);
  EXPECT_EQ(desk.withdrawals.front().id.str(), "wait");
}

TEST_F(Tools, ARobotThatMovesWithMoreThanPromisedCouldDoAnything) {
  desk.submit("go", "r1", r1_to(-150));
  const auto d = desk.dispatch_of("go");
  desk.begin(d);
  desk.now += 100ms;
  desk.hands["r1"] = {ToolName{"long"}};
  desk.posture("r1", d.from, true, "go");
  EXPECT_EQ(desk.planner.state(desk.now).robots[0].mode, model::RobotMode::unknown);
  desk.submit("beside", "r2", r2_to(100));
  EXPECT_EQ(desk.status_of("beside").reason, Reason::robot_unknown);
}

TEST(ToolsOfTheLost, ARobotThatIsNotHeardFromMayHoldAnything) {
  auto far = facing();
  far->robots[1] = experiment_robot("r2", {1.5, 0, 0}, pose_mm(1150, 150, 300, 0, 0, 180), kPi);
  Desk with_tools{far, Desk::without_escapes()};
  with_tools.stands("r1", far->robots[0].start);
  with_tools.submit("towards", "r1", r1_to(-150));
  EXPECT_EQ(with_tools.status_of("towards").reason, Reason::robot_unknown);

  far->tools.clear();
  Desk without{far, Desk::without_escapes()};
  without.stands("r1", far->robots[0].start);
  without.submit("towards", "r1", r1_to(-150));
  EXPECT_EQ(without.status_of("towards").state, CommandState::scheduled) << "its bare hand does not come here";
}

TEST_F(Tools, AToolThatWouldMeetABaseIsRejectedByName) {
  desk.submit("take", "r1", with(line_to(pose_mm(400, 0, 300)), "boom"));
  EXPECT_EQ(desk.status_of("take").state, CommandState::rejected);
  EXPECT_EQ(desk.status_of("take").reason, Reason::base_collision);
  EXPECT_NE(desk.status_of("take").text.find("boom would touch base of r2"), std::string::npos) << desk.status_of("take").text;
}

}  // namespace
}  // namespace interlace::test
