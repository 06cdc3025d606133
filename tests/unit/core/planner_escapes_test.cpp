#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/turnstile.hpp"
#include "tests/unit/core/desk.hpp"

/// What the planner says and sends when it makes room, and what it takes back when a robot does not do its part.
namespace interlace::test {
namespace {

using model::ExecutionState;

/// r1 stands idle at the centre and r2 has been told to go there: r1 is sent away with `escape-1` for `in`.
Desk with_an_escape(const std::string& strategy = "event") {
  auto options = Desk::usual();
  options.strategy = strategy;
  Desk desk{experiment_cell(true), options};
  desk.all_stand();
  desk.go("out", "r1", to_centre());
  desk.submit("in", "r2", to_centre());
  return desk;
}

/// Nothing is left over: every command and escape heard of has exactly one final status, and no robot has anything to do.
void expect_nothing_dangles(const Desk& desk) {
  for (const auto& status : desk.statuses) EXPECT_EQ(desk.finals_of(status.id.str()), 1U) << status.id.str();
  for (const auto& robot : desk.planner.state(desk.now).robots) {
    EXPECT_EQ(robot.queued, 0U) << robot.name.str();
    EXPECT_TRUE(robot.current.empty()) << robot.name.str() << " still has " << robot.current.str();
  }
}

/// Carries out what is dispatched, in the order it is sent, until nothing more is.
void carry_out_the_rest(Desk& desk, std::size_t from) {
  for (std::size_t i = from; i < desk.dispatches.size() || desk.pass_until_dispatch(); ++i) {
    const auto d = desk.dispatches[i];
    if (desk.finals_of(d.id.str()) == 0) desk.carry_out(d);
    ASSERT_LT(i, 50U) << "no end";
  }
}

TEST(PlannerEscapes, AreCommittedTogetherWithTheCommandTheyServe) {
  Desk desk{experiment_cell(true)};
  desk.all_stand();
  desk.go("out", "r1", to_centre());
  const std::size_t before = desk.statuses.size();
  desk.submit("in", "r2", to_centre());
  // Both in the answer to one event.
  for (const char* id : {"escape-1", "in"}) {
    EXPECT_TRUE(std::any_of(desk.statuses.begin() + static_cast<std::ptrdiff_t>(before), desk.statuses.end(), [&](const auto& status) {
      return status.id.str() == id && status.state == CommandState::scheduled;
    })) << id;
  }
  const auto escape = desk.status_of("escape-1");
  EXPECT_EQ(escape.state, CommandState::scheduled);
  EXPECT_EQ(escape.reason, Reason::escape);
  EXPECT_TRUE(escape.escape);
  EXPECT_EQ(escape.robot.str(), "r1");
  EXPECT_EQ(escape.serves.str(), "in");
  EXPECT_NE(escape.text.find("r1 goes "), std::string::npos) << escape.text;
  EXPECT_NE(escape.text.find(" for in"), std::string::npos) << escape.text;
  const auto in = desk.status_of("in");
  EXPECT_EQ(in.state, CommandState::scheduled);
  EXPECT_EQ(in.reason, Reason::escape);
  EXPECT_FALSE(in.escape);
  ASSERT_TRUE(in.start && escape.start);
  EXPECT_GT(*in.start, *escape.start);
  EXPECT_EQ(desk.dispatches_of("escape-1"), 1U);
  EXPECT_EQ(desk.dispatches_of("in"), 0U) << "not before the escape is known to have begun";
  desk.carry_out(desk.dispatch_of("escape-1"));
  ASSERT_TRUE(desk.dispatches_of("in") == 1 || desk.pass_until_dispatch());
  desk.carry_out(desk.dispatch_of("in"));
  EXPECT_EQ(desk.status_of("escape-1").state, CommandState::completed);
  EXPECT_EQ(desk.status_of("in").state, CommandState::completed);
  expect_nothing_dangles(desk);
}

TEST(PlannerEscapes, TheServedCommandSaysWhoWhichLinksAndUntilWhen) {
  Desk desk = with_an_escape();
  const auto in = desk.status_of("in");
  ASSERT_EQ(in.conflicts.size(), 1U);
  const auto& conflict = in.conflicts.front();
  EXPECT_EQ(conflict.blocker.str(), "r1");
  EXPECT_FALSE(conflict.own_link.empty());
  EXPECT_FALSE(conflict.blocker_link.empty());
  EXPECT_LT(conflict.until, model::kForever) << "r1 will have left";
  EXPECT_LE(conflict.until, in.start.value());
  EXPECT_LE(conflict.clearance, 0);
  EXPECT_NE(in.text.find("r2"), std::string::npos) << in.text;
  EXPECT_NE(in.text.find("r1's"), std::string::npos) << in.text;
}

TEST(PlannerEscapes, ARefusedEscapeIsCancelledAndTheServedCommandPlannedAnew) {
  Desk desk = with_an_escape();
  const auto escape = desk.dispatch_of("escape-1");
  desk.report(escape, ExecutionState::refused, escape.from, "the controller is busy");
  EXPECT_EQ(desk.status_of("escape-1").state, CommandState::cancelled);
  EXPECT_EQ(desk.dispatches_of("in"), 0U) << "r1 is still in its way";
  EXPECT_EQ(desk.status_of("in").state, CommandState::scheduled);
  const auto again = desk.status_of("escape-2");
  EXPECT_EQ(again.state, CommandState::scheduled);
  EXPECT_EQ(again.serves.str(), "in");
  ASSERT_NO_FATAL_FAILURE(carry_out_the_rest(desk, desk.dispatches.size() - 1));
  EXPECT_EQ(desk.dispatches_of("escape-1"), 1U) << "what is cancelled is not sent again";
  EXPECT_EQ(desk.status_of("in").state, CommandState::completed);
  expect_nothing_dangles(desk);
}

TEST(PlannerEscapes, AFailedEscapeLeavesNothingBehindWhereverItStopped) {
  // Stopped at 20 % of its time it is still in the way and another escape begins there; at 90 % the way may be free.
  for (const double share : {0.0, 0.2, 0.9}) {
    Desk desk = with_an_escape();
    const auto escape = desk.dispatch_of("escape-1");
    desk.begin(escape);
    const model::Motion motion = model::plan_motion(desk.robot("r1"), escape.from, escape.motion).value();
    desk.pass(model::from_seconds(share * motion.duration()));
    const std::size_t before = desk.dispatches.size();
    const bool was_sent = desk.dispatches_of("in") > 0;
    desk.report(escape, ExecutionState::failed, motion.joints(share * motion.duration()), "protective stop");
    EXPECT_EQ(desk.status_of("escape-1").state, CommandState::failed) << share;
    if (was_sent) {
      // Its start was proven for an escape that goes on: it is called back before anything else.
      ASSERT_FALSE(desk.withdrawals.empty()) << share;
      for (const auto& withdrawal : desk.withdrawals) EXPECT_EQ(withdrawal.id.str(), "in");
      desk.report(desk.dispatch_of("in"), ExecutionState::withdrawn);
    }
    ASSERT_NO_FATAL_FAILURE(carry_out_the_rest(desk, before)) << share;
    EXPECT_EQ(desk.status_of("in").state, CommandState::completed) << share;
    expect_nothing_dangles(desk);
  }
}

TEST(PlannerEscapes, TheServedCommandIsNotSentWhileTheEscapeIsNotConfirmed) {
  Desk desk = with_an_escape();
  const auto planned = desk.status_of("in").start.value();
  desk.report(desk.dispatch_of("escape-1"), ExecutionState::accepted);
  const auto at = desk.dispatch_of("escape-1").from;
  while (desk.now < planned + 5s) {
    desk.pass(100ms);
    desk.stands("r1", at);
    desk.stands("r2", desk.robot("r2").start);
    ASSERT_EQ(desk.dispatches_of("in"), 0U) << model::to_seconds(desk.now);
  }
}

TEST(PlannerEscapes, AreNotMadeForABlockerThatWillMoveByItself) {
  // It moves in, with the way out next in its queue: whoever waits for it waits.
  Desk desk{experiment_cell(true)};
  desk.all_stand();
  desk.submit("out", "r1", to_centre());
  desk.begin(desk.dispatch_of("out"));
  desk.submit("in", "r2", to_centre());
  desk.submit("back", "r1", r1_home());
  EXPECT_EQ(desk.status_of("in").state, CommandState::waiting);
  EXPECT_EQ(desk.status_of("in").reason, Reason::blocked);
  desk.finish(desk.dispatch_of("out"));
  ASSERT_NO_FATAL_FAILURE(carry_out_the_rest(desk, 1));
  for (const char* id : {"out", "back", "in"}) EXPECT_EQ(desk.status_of(id).state, CommandState::completed) << id;
  for (const auto& status : desk.statuses) EXPECT_FALSE(status.escape) << status.id.str() << ": " << status.text;
  expect_nothing_dangles(desk);
}

TEST(PlannerEscapes, GoWithTheCommandTheyServeWhenItIsCancelledBeforeTheyBegin) {
  // Cancelled while the escape may already have begun: it ends where it goes, and nothing waits for it.
  Desk desk = with_an_escape();
  desk.cancel("in", "r2");
  EXPECT_EQ(desk.status_of("in").state, CommandState::cancelled);
  ASSERT_NO_FATAL_FAILURE(carry_out_the_rest(desk, desk.dispatches.size() - 1));
  EXPECT_EQ(desk.dispatches_of("in"), 0U);
  expect_nothing_dangles(desk);
}

TEST(PlannerEscapes, AreThePlannersOwnAndNotTheClientsToCancel) {
  Desk desk = with_an_escape();
  const auto current = desk.planner.state(desk.now).robots[0];
  EXPECT_EQ(current.current.str(), "escape-1");
  EXPECT_EQ(current.serves.str(), "in") << "who looks at the robots sees what it is for";
  desk.cancel("escape-1", "r1");
  EXPECT_EQ(desk.status_of("escape-1").state, CommandState::scheduled);
  EXPECT_NE(desk.status_of("escape-1").text.find("cancel in"), std::string::npos) << desk.status_of("escape-1").text;
  ASSERT_NO_FATAL_FAILURE(carry_out_the_rest(desk, desk.dispatches.size() - 1));
  EXPECT_EQ(desk.status_of("escape-1").state, CommandState::completed);
  EXPECT_EQ(desk.status_of("in").state, CommandState::completed);
  expect_nothing_dangles(desk);
}

TEST(PlannerEscapes, PeopleAreAskedForHelpOnceWhileNothingChanges) {
  const Turnstile t{0.5};
  t.cell->robots[1].start = t.in_the_way;
  Desk desk{t.cell};
  desk.all_stand();
  desk.submit("across", "r1", Turnstile::across());
  const auto warning = desk.status_of("across");
  EXPECT_EQ(warning.state, CommandState::waiting);
  EXPECT_EQ(warning.reason, Reason::deadlock);
  EXPECT_GE(warning.refusals.size(), 6U);
  const std::size_t said = desk.statuses.size();
  for (int i = 0; i < 1000; ++i) {
    desk.pass(100ms);
    for (const auto& robot : t.cell->robots) desk.stands(robot.name.str(), robot.start);
  }
  EXPECT_EQ(desk.statuses.size(), said) << "nothing new, nothing said";
  EXPECT_TRUE(desk.dispatches.empty());
  // Who listens only now still learns it.
  const auto state = desk.planner.state(desk.now).robots[0];
  EXPECT_EQ(state.current.str(), "across");
  EXPECT_EQ(state.reason, Reason::deadlock);
  EXPECT_EQ(state.text, warning.text);
  EXPECT_EQ(state.refusals.size(), warning.refusals.size());
  // A person moves the robot: the waiting command is planned with that motion, and says what kept it so long.
  desk.submit("away", "r2", joints_to(t.aside));
  const auto scheduled = desk.status_of("across");
  EXPECT_EQ(scheduled.state, CommandState::scheduled);
  EXPECT_EQ(scheduled.reason, Reason::delayed);
  EXPECT_GT(scheduled.delay, 99);
  ASSERT_EQ(scheduled.conflicts.size(), 1U);
  EXPECT_EQ(scheduled.conflicts.front().blocker.str(), "r2");
  EXPECT_TRUE(scheduled.refusals.empty());
  ASSERT_NO_FATAL_FAILURE(carry_out_the_rest(desk, 0));
  for (const char* id : {"away", "across"}) EXPECT_EQ(desk.status_of(id).state, CommandState::completed) << id;
  expect_nothing_dangles(desk);
}

/// As the dissertation has it: one at a time in the order of the cell, and nobody else while one is deadlocked.
TEST(Acm, NobodyElseIsCommittedWhileADeadlockedRobotWaitsForAllToStand) {
  for (const std::string strategy : {"acm", "event"}) {
    auto options = Desk::usual();
    options.strategy = strategy;
    Desk desk{experiment_cell(true), options};
    desk.all_stand();
    desk.go("out", "r1", to_centre());
    desk.submit("far-1", "r3", line_to(pose_mm(300, 5250, 330)));
    const auto far = desk.dispatch_of("far-1");
    desk.begin(far);
    desk.submit("in", "r2", to_centre());
    desk.submit("far-2", "r3", line_to(pose_mm(450, 5250, 300)));
    if (strategy == "event") {
      EXPECT_EQ(desk.status_of("in").state, CommandState::scheduled) << "room is made while others move";
      continue;
    }
    EXPECT_EQ(desk.status_of("in").state, CommandState::waiting);
    EXPECT_EQ(desk.status_of("in").reason, Reason::blocked);
    for (const auto& status : desk.statuses) EXPECT_FALSE(status.escape) << status.text;
    // r3 stands: now the escape and what it serves; r3's next command can meet nobody, and waits for all of it nevertheless.
    desk.finish(far);
    EXPECT_EQ(desk.status_of("escape-1").state, CommandState::scheduled);
    EXPECT_EQ(desk.status_of("in").state, CommandState::scheduled);
    EXPECT_EQ(desk.dispatches_of("far-2"), 0U);
    desk.begin(desk.dispatch_of("escape-1"));
    ASSERT_TRUE(desk.dispatches_of("in") == 1 || desk.pass_until_dispatch());
    desk.begin(desk.dispatch_of("in"));
    desk.finish(desk.dispatch_of("escape-1"));
    EXPECT_EQ(desk.dispatches_of("far-2"), 0U);
    desk.finish(desk.dispatch_of("in"));
    EXPECT_EQ(desk.dispatches_of("far-2"), 1U) << "the round is over";
    desk.carry_out(desk.dispatch_of("far-2"));
    expect_nothing_dangles(desk);
  }
}

TEST(Acm, ServesRobotsInTheOrderOfTheCell) {
  // While the round lasts, r3 gets its command before r1: acm serves r1 first all the same.
  Desk desk = with_an_escape("acm");
  desk.submit("third", "r3", line_to(pose_mm(300, 5250, 330)));
  desk.begin(desk.dispatch_of("escape-1"));
  desk.submit("first", "r1", r1_home());
  ASSERT_TRUE(desk.dispatches_of("in") == 1 || desk.pass_until_dispatch());
  desk.begin(desk.dispatch_of("in"));
  desk.finish(desk.dispatch_of("escape-1"));
  EXPECT_EQ(desk.dispatches_of("first") + desk.dispatches_of("third"), 0U);
  const std::size_t before = desk.statuses.size();
  desk.finish(desk.dispatch_of("in"));
  std::vector<std::string> order;
  for (std::size_t i = before; i < desk.statuses.size(); ++i) {
    if (desk.statuses[i].state == CommandState::scheduled) order.push_back(desk.statuses[i].id.str());
  }
  EXPECT_EQ(order, (std::vector<std::string>{"first", "third"}));
}

}  // namespace
}  // namespace interlace::test
