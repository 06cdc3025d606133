#include "monitor/live_view.hpp"

#include <gtest/gtest.h>

#include "tests/unit/monitor/cells.hpp"

namespace interlace::monitor {
namespace {

using namespace std::chrono_literals;
using model::at_seconds;
using test::newest;
using test::parsed;

constexpr std::uint64_t kPlanner = 7;
const LiveView::LocalTime kOrigin{1h};

/// A cell of two arms as its processes would tell it: planner time is the time since the origin.
class LiveViewTest : public testing::Test {
 protected:
  static model::MotionRequest linear(double x, double y, double z) {
    model::MotionRequest request;
    request.target = model::LinearTarget{model::make_pose({x, y, z}, model::Quaternion::Identity())};
    return request;
  }
  static LiveView::LocalTime at(double t) {
    return kOrigin + std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::duration<double>(t));
  }

  void heartbeat(double t) {
    dds::DispatchMessage message{kPlanner, cell_.fingerprint, dds::Heartbeat{}};
    std::get<dds::Heartbeat>(message.order).planner_sent = at_seconds(t);
    view_.on_dispatch(message, at(t));
  }
  void posture(const char* robot, double t, const model::Joints* q = nullptr) {
    dds::PostureMessage message;
    message.fingerprint = cell_.fingerprint;
    message.planner_incarnation = kPlanner;
    message.posture.robot = model::RobotName{robot};
    message.posture.at = at_seconds(t);
    const model::Robot& arm = cell_.cell.robots[*cell_.cell.find(message.posture.robot)];
    message.posture.joints = q != nullptr ? *q : arm.start;
    message.posture.X_WT = arm.X_WB * model::tcp_pose(arm.model, message.posture.joints);
    view_.on_posture(message, at(t));
  }
  void all_stand(double t) {
    heartbeat(t);
    posture("r1", t);
    posture("r2", t);
  }
  model::CommandStatus status(const char* id, const char* robot, model::CommandState state) {
    model::CommandStatus s;
    s.id = model::CommandId{id};
    s.robot = model::RobotName{robot};
    s.state = state;
    return s;
  }
  void say(const model::CommandStatus& s, double t) { view_.on_status({kPlanner, s}, at(t)); }
  void dispatch(const char* id, const char* robot, const model::MotionRequest& motion, double earliest, double t) {
    model::Dispatch d;
    d.id = model::CommandId{id};
    d.robot = model::RobotName{robot};
    d.motion = motion;
    d.from = cell_.cell.robots[*cell_.cell.find(d.robot)].start;
    d.earliest = at_seconds(earliest);
    d.latest = at_seconds(earliest + 0.06);
    view_.on_dispatch({kPlanner, cell_.fingerprint, d}, at(t));
  }
  std::vector<Frame> advance(double t) {
    view_.advance(at(t));
    return view_.take_events();
  }

  const app::LoadedCell cell_ = test::two_arms();
  LiveView view_{cell_, kOrigin};
};

TEST_F(LiveViewTest, TheSnapshotHasAllThatANewViewerNeeds) {
  all_stand(1);
  (void)advance(1.01);
  const auto snapshot = parsed(view_.snapshot());
  EXPECT_EQ(snapshot["type"], "snapshot");
  std::map<std::string, nlohmann::json> frames;
  for (const auto& frame : snapshot["frames"]) frames[frame["type"]] = frame;
  EXPECT_EQ(frames["cell"]["version"], kFrameVersion);
  EXPECT_EQ(frames["cell"]["robots"][1]["links"], (nlohmann::json{"base", "link1", "link2", "eef"}));
  EXPECT_EQ(frames["cell"]["pairs"], nlohmann::json::array({nlohmann::json::array({"r1", "r2"})}));
  EXPECT_EQ(frames["pose"]["robots"][0]["ends"].size(), 4U * 6);
  for (const char* type : {"alarms", "curves", "state"}) EXPECT_EQ(frames.count(type), 1U) << type;
}

TEST_F(LiveViewTest, APoseShowsBodiesInTheWorldAndHowNearTheyAre) {
  all_stand(1);
  (void)advance(1.01);
  const auto pose = parsed(view_.pose());
  // r2's base capsule stands from (0, −250, 0) to its shoulder, 290 mm up.
  const auto& ends = pose["robots"][1]["ends"];
  EXPECT_NEAR(ends[1].get<double>(), -0.25, 1e-4);
  EXPECT_NEAR(ends[5].get<double>(), 0.29, 1e-4);
  // Both stand alike 500 mm apart: the thickest links, 117 mm each, are the nearest.
  EXPECT_NEAR(pose["pairs"][0].get<double>(), 0.5 - 2 * 0.117, 1e-4);
  EXPECT_NEAR(pose["robots"][0]["clearance"][1].get<double>(), 0.266, 1e-3);
}

TEST_F(LiveViewTest, ARobotThatWasNeverHeardIsNotInvented) {
  heartbeat(1);
  posture("r1", 1);
  (void)advance(1.01);
  const auto pose = parsed(view_.pose());
  EXPECT_TRUE(pose["robots"][1].is_null());
  EXPECT_TRUE(pose["pairs"][0].is_null());
}

TEST_F(LiveViewTest, ThePictureTellsWhoIsHeardFromWhoWasAndWhoNeverWas) {
  heartbeat(1);
  posture("r1", 1);
  (void)advance(1.01);
  const CellPicture first = view_.picture();
  ASSERT_EQ(first.robots.size(), 2U);
  EXPECT_TRUE(first.planner_heard);
  EXPECT_TRUE(first.robots[0].heard);
  EXPECT_EQ(first.robots[0].capsules.size(), first.robots[0].clearance.size());
  EXPECT_FALSE(first.robots[1].heard || first.robots[1].posture);
  EXPECT_TRUE(first.robots[1].capsules.empty());
  ASSERT_NE(first.robots[1].body, nullptr);
  EXPECT_EQ(first.robots[1].body->name.str(), "r2");

  (void)advance(4);
  const CellPicture later = view_.picture();
  EXPECT_FALSE(later.planner_heard || later.robots[0].heard);
  EXPECT_TRUE(later.robots[0].posture) << "where it was last";
  EXPECT_FALSE(later.alarms.empty());
}

TEST_F(LiveViewTest, SaysInOneSentenceAndAsDataWhyARobotWaits) {
  all_stand(10);
  auto s = status("c", "r2", model::CommandState::waiting);
  s.reason = model::Reason::blocked;
  model::Conflict conflict;
  conflict.blocker = model::RobotName{"r1"};
  conflict.own_link = "link2";
  conflict.blocker_link = "eef";
  conflict.clearance = -0.024;
  s.conflicts = {conflict};
  say(s, 10.1);
  const auto waiting = newest(advance(12.1), "state")["robots"][1]["waiting"];
  EXPECT_EQ(waiting["sentence"], "r2 waits for 2.0 s so far: r1's eef in the way of link2, 24.0 mm deep, no end known");
  EXPECT_EQ(waiting["conflicts"][0]["blocker"], "r1");
  EXPECT_EQ(waiting["conflicts"][0]["blocker_link"], "eef");
  EXPECT_TRUE(waiting["conflicts"][0]["until"].is_null());
}

TEST_F(LiveViewTest, ADelayedCommandIsHeldUpUntilItStarts) {
  all_stand(10);
  auto s = status("c", "r2", model::CommandState::scheduled);
  s.reason = model::Reason::delayed;
  s.start = at_seconds(14);
  s.end = at_seconds(17);
  s.delay = 3.5;
  say(s, 10.1);
  const auto waiting = newest(advance(12), "state")["robots"][1]["waiting"];
  EXPECT_EQ(waiting["sentence"].get<std::string>().rfind("r2 starts in 2.0 s, 3.5 s later than it could: ", 0), 0U) << waiting;
  s.state = model::CommandState::started;
  say(s, 14);
  EXPECT_TRUE(newest(advance(14.5), "state")["robots"][1]["waiting"].is_null());
}

TEST_F(LiveViewTest, AMapShowsTheWindowThatWasChosen) {
  all_stand(10);
  // r1 goes to the middle and back is not known; r2 wants to the same place and may start at once only where nobody will be.
  dispatch("a", "r1", linear(0.35, 0.0, 0.2), 10.1, 10.05);
  auto s = status("b", "r2", model::CommandState::scheduled);
  s.start = at_seconds(10.2);
  say(s, 10.1);
  (void)advance(10.15);
  dispatch("b", "r2", linear(0.3, -0.25, 0.3), 10.2, 10.16);
  const auto map = parsed(view_.map(model::CommandId{"b"}));
  ASSERT_FALSE(map.contains("why_not")) << map["why_not"];
  EXPECT_EQ(map["robot"], "r2");
  EXPECT_NEAR(map["length_m"].get<double>(), 0.15, 1e-4);
  EXPECT_NEAR(map["start"].get<double>(), 10.2, 1e-3);
  ASSERT_FALSE(map["windows"].empty());
  EXPECT_LE(map["windows"][0][0].get<double>(), 10.2 + 1e-3);
  const auto blocked = parsed([&] {
    dispatch("d", "r2", linear(0.35, 0.05, 0.2), 10.3, 10.25);
    auto d = status("d", "r2", model::CommandState::scheduled);
    d.start = at_seconds(10.3);
    say(d, 10.25);
    (void)advance(10.3);
    return view_.map(model::CommandId{"d"});
  }());
  EXPECT_TRUE(blocked["windows"].empty()) << "r1 will stand at the same place for ever, as far as is known: " << blocked["windows"];
  ASSERT_FALSE(blocked["neighbours"][0]["areas"].empty());
  EXPECT_TRUE(blocked["neighbours"][0]["areas"][0].size() == 7);
}

TEST_F(LiveViewTest, SaysWhyThereIsNoMap) {
  all_stand(10);
  EXPECT_TRUE(parsed(view_.map(model::CommandId{"unheard"})).contains("why_not"));
  say(status("q", "r1", model::CommandState::queued), 10);
  EXPECT_TRUE(parsed(view_.map(model::CommandId{"q"})).contains("why_not"));
}

TEST_F(LiveViewTest, ASweepIsShownFromItsDispatchUntilItIsOver) {
  all_stand(10);
  dispatch("escape-1-1", "r1", linear(0.3, 0.25, 0.3), 10.1, 10.05);
  const auto motion = newest(advance(10.06), "motion");
  EXPECT_EQ(motion["id"], "escape-1-1");
  EXPECT_TRUE(motion["escape"].get<bool>());
  EXPECT_NEAR(motion["path"].back()[0].get<double>(), 0.3, 1e-4);
  model::ExecutionReported report;
  report.id = model::CommandId{"escape-1-1"};
  report.robot = model::RobotName{"r1"};
  report.state = model::ExecutionState::completed;
  report.at = at_seconds(12);
  view_.on_execution({kPlanner, 1, report}, at(12));
  EXPECT_EQ(newest(advance(12.1), "motion_over")["id"], "escape-1-1");
}

TEST_F(LiveViewTest, NewsThatComeAfterTheOrderDoNotTakeItBack) {
  all_stand(10);
  dispatch("c", "r1", linear(0.3, 0.25, 0.3), 10.1, 10.05);
  say(status("c", "r1", model::CommandState::queued), 10.051);
  auto s = status("c", "r1", model::CommandState::scheduled);
  s.start = at_seconds(10.1);
  say(s, 10.052);
  const auto frames = advance(10.06);
  EXPECT_TRUE(newest(frames, "motion_over").is_null());
  model::ExecutionReported report;
  report.id = model::CommandId{"c"};
  report.robot = model::RobotName{"r1"};
  report.state = model::ExecutionState::completed;
  report.at = at_seconds(12);
  view_.on_execution({kPlanner, 1, report}, at(12));
  EXPECT_EQ(newest(advance(12.1), "motion_over")["id"], "c");
}

TEST_F(LiveViewTest, AlarmsComeAndGo) {
  all_stand(10);
  const auto alarms = [&](double t) { return newest(advance(t), "alarms")["alarms"]; };
  EXPECT_TRUE(alarms(10.1).empty());
  heartbeat(11);
  posture("r1", 11);
  auto now = alarms(11);
  ASSERT_EQ(now.size(), 1U) << now;
  EXPECT_EQ(now[0]["kind"], "proxy_silent");
  EXPECT_EQ(now[0]["robots"], nlohmann::json{"r2"});
  EXPECT_TRUE(now[0]["ended"].is_null());
  posture("r2", 11.2);
  posture("r1", 11.2);
  now = alarms(11.3);
  ASSERT_EQ(now.size(), 1U);
  EXPECT_FALSE(now[0]["ended"].is_null());
  posture("r1", 13);
  posture("r2", 13);
  EXPECT_EQ(alarms(13)[0]["kind"], "planner_silent");
}

TEST_F(LiveViewTest, ADeadlockAndAFailureAreAlarms) {
  all_stand(10);
  auto s = status("c", "r2", model::CommandState::waiting);
  s.reason = model::Reason::deadlock;
  say(s, 10);
  say(status("another", "r2", model::CommandState::queued), 10.05);
  const auto holding = newest(advance(10.1), "alarms")["alarms"];
  EXPECT_EQ(holding[0]["kind"], "deadlock");
  EXPECT_TRUE(holding[0]["ended"].is_null()) << "news of another command do not end it";
  s.state = model::CommandState::failed;
  s.reason = model::Reason::controller_fault;
  say(s, 10.2);
  const auto alarms = newest(advance(10.3), "alarms")["alarms"];
  ASSERT_EQ(alarms.size(), 2U) << alarms;
  EXPECT_FALSE(alarms[0]["ended"].is_null()) << "the deadlock is over";
  EXPECT_EQ(alarms[1]["kind"], "controller_fault");
}

TEST_F(LiveViewTest, ContactIsAnAlarmWithItsLinks) {
  all_stand(10);
  const model::Robot& arm = cell_.cell.robots[1];
  const auto q =
      model::preferred_posture(arm.model, arm.X_WB.inverse() * model::make_pose({0.35, 0.15, 0.3}, model::Quaternion::Identity()));
  ASSERT_TRUE(q);
  for (int i = 1; i < 30; ++i) {
    heartbeat(10 + 0.01 * i);
    posture("r1", 10 + 0.01 * i);
    posture("r2", 10 + 0.01 * i, &*q);
  }
  auto alarms = newest(advance(10.3), "alarms")["alarms"];
  ASSERT_EQ(alarms.size(), 1U) << alarms;
  EXPECT_EQ(alarms[0]["kind"], "contact");
  EXPECT_EQ(alarms[0]["text"], "r1 and r2 touch each other");
  EXPECT_TRUE(alarms[0]["ended"].is_null());
  for (int i = 31; i < 40; ++i) all_stand(10 + 0.01 * i);
  alarms = newest(advance(10.4), "alarms")["alarms"];
  ASSERT_EQ(alarms.size(), 1U) << alarms;
  EXPECT_FALSE(alarms[0]["ended"].is_null());
  EXPECT_EQ(alarms[0]["text"].get<std::string>().rfind("r1 and r2 touched; deepest so far ", 0), 0U) << alarms[0]["text"];
}

TEST_F(LiveViewTest, WhatAPlannerLeftUndoneIsOverWithIt) {
  all_stand(10);
  say(status("c", "r2", model::CommandState::waiting), 10);
  dds::DispatchMessage message{kPlanner + 1, cell_.fingerprint, dds::Heartbeat{}};
  view_.on_dispatch(message, at(10.5));
  EXPECT_TRUE(newest(advance(10.6), "command")["state"] == "waiting") << "two planners: the one in charge stays it";
  view_.on_dispatch(message, at(13));
  EXPECT_EQ(newest(advance(13.1), "command")["state"], "failed");
}

TEST_F(LiveViewTest, StrangersWithAnotherCellFileAreNotShown) {
  heartbeat(1);
  dds::PostureMessage message;
  message.fingerprint = cell_.fingerprint + 1;
  message.posture.robot = model::RobotName{"r1"};
  view_.on_posture(message, at(1));
  const auto frames = advance(1.1);
  EXPECT_EQ(newest(frames, "alarms")["alarms"][0]["kind"], "other_cell");
  EXPECT_TRUE(parsed(view_.pose())["robots"][0].is_null());
}

TEST_F(LiveViewTest, MemoryIsBoundedHoweverLongItRuns) {
  all_stand(10);
  for (int i = 0; i < 3000; ++i) {
    auto s = status(("c" + std::to_string(i)).c_str(), "r1", model::CommandState::completed);
    say(s, 10 + i);
    (void)view_.take_events();
  }
  (void)advance(4000);
  const auto snapshot = parsed(view_.snapshot());
  std::size_t commands = 0;
  for (const auto& frame : snapshot["frames"]) commands += frame["type"] == "command" ? 1 : 0;
  EXPECT_EQ(commands, CommandBook::kFinished);
}

}  // namespace
}  // namespace interlace::monitor
