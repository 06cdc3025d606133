#include <gtest/gtest.h>

#include "tests/unit/core/desk.hpp"

/// What is said of deadlines, and that nothing else comes of them.
namespace interlace::test {
namespace {

using model::DeadlineVerdict;
using model::ExecutionState;

/// Seconds that r1's way aside takes.
double way_aside() {
  const auto cell = experiment_cell();
  return model::plan_motion(cell->robots[0], cell->robots[0].start, r1_aside()).value().duration();
}

TEST(PlannerDeadlines, NoneIsNone) {
  Desk desk;
  desk.all_stand();
  desk.go("a", "r1", r1_aside());
  for (const auto& status : desk.statuses) {
    EXPECT_FALSE(status.deadline);
    EXPECT_EQ(status.verdict, DeadlineVerdict::none);
  }
}

TEST(PlannerDeadlines, InTimeIsMet) {
  Desk desk;
  desk.all_stand();
  desk.pass(1s);
  desk.submit("a", "r1", r1_aside(), 0, 60);
  EXPECT_EQ(desk.statuses.back().verdict, DeadlineVerdict::open);
  EXPECT_EQ(desk.statuses.back().deadline, model::at_seconds(61));
  desk.carry_out(desk.dispatch_of("a"));
  EXPECT_EQ(desk.status_of("a").verdict, DeadlineVerdict::met);
}

TEST(PlannerDeadlines, PassedIsLateAtOnceAndOnce) {
  Desk desk;
  desk.all_stand();
  const double least = way_aside();
  desk.submit("a", "r1", r1_aside(), 0, least + 1);
  const auto d = desk.dispatch_of("a");
  desk.begin(d);
  const std::size_t said = desk.statuses.size();
  ASSERT_TRUE(desk.planner.next_deadline());
  EXPECT_EQ(*desk.planner.next_deadline(), *desk.status_of("a").deadline + core::Duration{1});
  desk.now = *desk.planner.next_deadline();
  desk.pass(0s);
  EXPECT_EQ(desk.statuses.size(), said + 1);
  EXPECT_EQ(desk.status_of("a").verdict, DeadlineVerdict::late);
  EXPECT_EQ(desk.status_of("a").state, CommandState::started);
  desk.pass(1s);
  EXPECT_EQ(desk.statuses.size(), said + 1);
  desk.finish(d);
  EXPECT_EQ(desk.status_of("a").state, CommandState::completed);
  EXPECT_EQ(desk.status_of("a").verdict, DeadlineVerdict::late);
}

TEST(PlannerDeadlines, WhatNoPlanCouldMeetIsSaidAtOnceAndCarriedOut) {
  Desk desk;
  desk.all_stand();
  const double least = way_aside();
  desk.submit("a", "r1", r1_aside(), 0, least * 0.9);
  const auto& first = desk.statuses.front();
  EXPECT_EQ(first.state, CommandState::queued);
  EXPECT_EQ(first.verdict, DeadlineVerdict::impossible);
  EXPECT_NE(first.text.find("it is carried out all the same"), std::string::npos) << first.text;
  desk.carry_out(desk.dispatch_of("a"));
  EXPECT_EQ(desk.status_of("a").state, CommandState::completed);
  EXPECT_EQ(desk.status_of("a").verdict, DeadlineVerdict::impossible) << "as was said";
}

TEST(PlannerDeadlines, WhatWaitsBeforeACommandCounts) {
  const double least = way_aside();
  for (const double within : {2 * least, 4 * least + 1}) {
    Desk desk;
    desk.all_stand();
    desk.submit("a", "r1", r1_aside());
    desk.begin(desk.dispatch_of("a"));
    desk.submit("b", "r1", r1_home());
    desk.submit("c", "r1", r1_aside(), 0, within);
    EXPECT_EQ(desk.status_of("c").verdict, within < 3 * least ? DeadlineVerdict::impossible : DeadlineVerdict::open);
  }
}

TEST(PlannerDeadlines, MoreRoomThanThoughtIsMetInTheEnd) {
  Desk desk;
  desk.all_stand();
  const double least = way_aside();
  desk.submit("a", "r1", r1_aside());
  desk.begin(desk.dispatch_of("a"));
  desk.submit("b", "r1", r1_home());
  desk.submit("c", "r1", r1_aside(), 0, 2.5 * least);
  EXPECT_EQ(desk.status_of("c").verdict, DeadlineVerdict::impossible);
  desk.cancel("b", "r1");
  desk.finish(desk.dispatch_of("a"));
  desk.carry_out(desk.dispatch_of("c"));
  EXPECT_EQ(desk.status_of("c").verdict, DeadlineVerdict::met);
}

TEST(PlannerDeadlines, TheFasterControllerThatIsAllowedCounts) {
  auto cell = experiment_cell();
  cell->robots[0].controller.speed_error = 0.1;
  Desk desk{cell};
  desk.all_stand();
  desk.submit("a", "r1", r1_aside(), 0, way_aside() * 0.95);
  EXPECT_EQ(desk.status_of("a").verdict, DeadlineVerdict::open) << "it may be a tenth faster";
}

TEST(PlannerDeadlines, OfOneThatIsRejectedNothingIsSaid) {
  Desk desk;
  desk.all_stand();
  desk.submit("a", "r1", line_to(pose_mm(900, 250, 300)), 0, 1);
  EXPECT_EQ(desk.status_of("a").state, CommandState::rejected);
  EXPECT_EQ(desk.status_of("a").verdict, DeadlineVerdict::none);
}

TEST(PlannerDeadlines, MoveNobodyUp) {
  Desk desk;
  desk.all_stand();
  desk.submit("a", "r1", r1_aside());
  desk.submit("b", "r1", r1_home());
  desk.submit("c", "r1", r1_home(), 0, 0.1);
  desk.carry_out(desk.dispatch_of("a"));
  EXPECT_EQ(desk.dispatches_of("b"), 1U);
}

}  // namespace
}  // namespace interlace::test
