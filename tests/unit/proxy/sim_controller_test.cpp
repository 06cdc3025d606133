#include "robot_proxy/drivers/sim/sim_controller.hpp"

#include <gtest/gtest.h>

#include "tests/unit/proxy/support.hpp"

namespace interlace::proxy {
namespace {

using model::Duration;
using model::from_seconds;
using model::to_seconds;
using test::arm;
using test::joints_to;
using test::line_to;
using test::local;
using namespace std::chrono_literals;

const model::Vector3 kThere{0.45, 0.1, 0.3};  // 0.1 m from the start: 2 s

class SimControllerTest : public ::testing::Test {
 protected:
  model::Robot robot_ = arm();
  SimController controller_{robot_};
  double y(LocalTime t) const { return controller_.observe(t).X_WT.translation().y(); }
};

TEST_F(SimControllerTest, StandsAtItsStart) {
  const ControllerState s = controller_.observe(local(3));
  EXPECT_EQ(s.joints, robot_.start);
  EXPECT_TRUE(s.ready);
  EXPECT_FALSE(s.moving);
  EXPECT_EQ(s.motion.phase, MotionPhase::none);
  EXPECT_EQ(s.at, local(3));
  EXPECT_FALSE(controller_.next_event(local(3)));
  EXPECT_NEAR(s.X_WT.translation().x(), 0.45, 1e-9);
}

TEST_F(SimControllerTest, BeginsAndEndsExactly) {
  ASSERT_TRUE(controller_.execute(line_to(kThere), 7, local(10)));
  EXPECT_EQ(controller_.next_event(local(10)), local(12));
  EXPECT_TRUE(controller_.observe(local(10)).moving);
  EXPECT_EQ(controller_.observe(local(10)).motion.began, local(10));
  EXPECT_NEAR(y(local(11)), 0.05, 1e-6);
  EXPECT_TRUE(controller_.observe(local(12) - 1ns).moving);
  const ControllerState end = controller_.observe(local(12));
  EXPECT_FALSE(end.moving);
  EXPECT_EQ(end.motion.number, 7u);
  EXPECT_EQ(end.motion.phase, MotionPhase::finished);
  EXPECT_EQ(end.motion.ended, local(12));
  EXPECT_LT((end.X_WT.translation() - kThere).norm(), 1e-9);
  EXPECT_FALSE(controller_.next_event(local(12)));
  EXPECT_TRUE(controller_.execute(line_to({0.45, 0, 0.3}), 8, local(12))) << "the next one may begin at the very end";
}

class SimControllerTools : public SimControllerTest {
 protected:
  static model::MotionRequest with(const std::string& attach, const std::string& detach, model::ToolTime when) {
    model::MotionRequest request = line_to(kThere);
    request.tools = model::ToolChange{model::ToolName{attach}, model::ToolName{detach}, when};
    return request;
  }
  using Tools = std::vector<model::ToolName>;
  const Tools none_, long_{model::ToolName{"long"}};
};

TEST_F(SimControllerTools, AreTakenWhereTheCommandSaysSo) {
  ASSERT_TRUE(controller_.execute(with("long", "", model::ToolTime::completion), 1, local(10)));
  EXPECT_EQ(controller_.observe(local(12) - 1ns).holds, none_);
  EXPECT_EQ(controller_.observe(local(12)).holds, long_);
  ASSERT_TRUE(controller_.execute(with("", "long", model::ToolTime::start), 2, local(20)));
  EXPECT_EQ(controller_.observe(local(20)).holds, none_);
}

TEST_F(SimControllerTools, AreNotTakenByAMotionThatDoesNotArrive) {
  controller_.fail_next(0.5, "stuck");
  ASSERT_TRUE(controller_.execute(with("long", "", model::ToolTime::completion), 1, local(10)));
  EXPECT_EQ(controller_.observe(local(30)).holds, none_);
}

TEST_F(SimControllerTools, ThatCannotBeTakenOrLeftAreRefused) {
  EXPECT_EQ(controller_.execute(with("", "long", model::ToolTime::start), 1, local(10)).error(), "there is no long in its hand to leave");
  robot_.holds = long_;
  SimController holding{robot_};
  EXPECT_EQ(holding.observe(local(0)).holds, long_);
  EXPECT_EQ(holding.execute(with("long", "", model::ToolTime::start), 1, local(10)).error(), "long is in its hand already");
}

TEST_F(SimControllerTest, LatencyAndSpeedErrorStayInTheirBoundsAndRepeatWithTheSeed) {
  robot_.controller = {0.02, 0.01, 0.05};
  SimController a{robot_, {Duration{0}, true, 42}};
  SimController b{robot_, {Duration{0}, true, 42}};
  SimController c{robot_, {Duration{0}, true, 43}};
  EXPECT_EQ(a.capabilities().earliest_start, 10ms);
  EXPECT_EQ(a.capabilities().latest_start, 30ms);
  double least = 1, most = 0;
  bool differs = false;
  for (int i = 0; i < 200; ++i) {
    const LocalTime now = local(10.0 * i);
    const auto request = line_to(i % 2 == 0 ? kThere : model::Vector3{0.45, 0, 0.3});
    for (SimController* controller : {&a, &b, &c}) ASSERT_TRUE(controller->execute(request, i + 1, now));
    EXPECT_EQ(a.observe(now).motion.phase, MotionPhase::commanded);
    const LocalTime begin = *a.next_event(now);
    const LocalTime end = *a.next_event(begin);
    EXPECT_EQ(begin, b.next_event(now));
    EXPECT_EQ(end, b.next_event(begin));
    differs = differs || begin != c.next_event(now);
    EXPECT_GE(begin, now + 10ms);
    EXPECT_LE(begin, now + 30ms);
    const double taken = to_seconds(end - begin);
    EXPECT_GE(taken, 2 * 0.95 - 1e-9);
    EXPECT_LE(taken, 2 * 1.05 + 1e-9);
    least = std::min(least, taken);
    most = std::max(most, taken);
  }
  EXPECT_TRUE(differs);
  EXPECT_LT(least, 1.92);
  EXPECT_GT(most, 2.08);
}

TEST_F(SimControllerTest, APeriodHoldsPosturesButNotTheEnd) {
  robot_.tcp.velocity = 0.0999;  // an end that no period hits
  SimController stepped{robot_, {4ms, true, 1}};
  EXPECT_DOUBLE_EQ(stepped.capabilities().posture_rate, 250);
  ASSERT_TRUE(stepped.execute(line_to(kThere), 1, local(0)));
  EXPECT_EQ(stepped.observe(local(1.0)).joints, stepped.observe(local(1.0039)).joints);
  EXPECT_NE(stepped.observe(local(1.0)).joints, stepped.observe(local(1.004)).joints);
  const LocalTime end = *stepped.next_event(local(0));
  EXPECT_NE((end - local(0)) % 4ms, 0ns);
  EXPECT_EQ(stepped.observe(end).motion.phase, MotionPhase::finished);
  EXPECT_LT((stepped.observe(end).X_WT.translation() - kThere).norm(), 1e-9);
}

TEST_F(SimControllerTest, RefusesWhatItCannotDo) {
  EXPECT_FALSE(controller_.execute(line_to({5, 0, 0}), 1, local(0)));
  EXPECT_EQ(controller_.observe(local(0)).motion.phase, MotionPhase::none);
  ASSERT_TRUE(controller_.execute(line_to(kThere), 2, local(0)));
  EXPECT_FALSE(controller_.execute(line_to(kThere), 3, local(1))) << "busy";
  EXPECT_EQ(controller_.observe(local(1)).motion.number, 2u);
}

TEST_F(SimControllerTest, StopsOnItsPathAndKeepsStanding) {
  const model::Vector3 far{0.45, 0.3, 0.3};
  ASSERT_TRUE(controller_.execute(line_to(far), 1, local(0)));
  ASSERT_TRUE(controller_.stop(local(2)));
  EXPECT_NEAR(y(local(2)), 0.15, 1e-6);
  EXPECT_EQ(controller_.next_event(local(2)), local(3)) << "v/a = 1 s";
  // Cruising: from 0.1 m/s to rest in 1 s, 0.05 m further, at a falling speed.
  EXPECT_NEAR(y(local(2.5)), 0.15 + 0.0375, 1e-6);
  EXPECT_NEAR(y(local(3)), 0.2, 1e-6);
  EXPECT_NEAR(controller_.observe(local(2.5)).X_WT.translation().z(), 0.3, 1e-6) << "on the line";
  const ControllerState end = controller_.observe(local(9));
  EXPECT_EQ(end.motion.phase, MotionPhase::failed);
  EXPECT_TRUE(end.ready);
  EXPECT_NEAR(y(local(9)), 0.2, 1e-6);
  ASSERT_TRUE(controller_.execute(line_to(far), 2, local(9)));
  EXPECT_EQ(controller_.observe(local(9)).joints, end.joints);
}

TEST_F(SimControllerTest, StopBeforeTheBeginCancelsAndStopAtTheEndIsTooLate) {
  robot_.controller.start_latency = 0.5;
  ASSERT_TRUE(controller_.execute(line_to(kThere), 1, local(0)));
  ASSERT_TRUE(controller_.stop(local(0.25)));
  EXPECT_EQ(controller_.observe(local(0.25)).motion.phase, MotionPhase::refused);
  EXPECT_FALSE(controller_.observe(local(0.25)).motion.began);
  EXPECT_EQ(controller_.observe(local(9)).joints, robot_.start);
  EXPECT_FALSE(controller_.next_event(local(0.25)));
  ASSERT_TRUE(controller_.execute(line_to(kThere), 2, local(10)));
  ASSERT_TRUE(controller_.stop(local(12.4)));
  EXPECT_EQ(controller_.observe(local(12.5)).motion.phase, MotionPhase::finished);
  SimController deaf{robot_, {Duration{0}, false, 1}};
  EXPECT_FALSE(deaf.stop(local(0)));
  EXPECT_FALSE(deaf.capabilities().can_stop);
}

TEST_F(SimControllerTest, FaultsFollowTheirScript) {
  controller_.refuse_next("not today");
  controller_.fail_next(0.5, "servo off");
  const auto refused = controller_.execute(line_to(kThere), 1, local(0));
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error(), "not today");
  ASSERT_TRUE(controller_.execute(line_to(kThere), 2, local(0)));
  EXPECT_EQ(controller_.next_event(local(0)), local(1));
  const ControllerState broken = controller_.observe(local(5));
  EXPECT_EQ(broken.motion.phase, MotionPhase::failed);
  EXPECT_EQ(broken.fault, "servo off");
  EXPECT_FALSE(broken.ready);
  EXPECT_NEAR(y(local(5)), 0.05, 1e-6);
  EXPECT_FALSE(controller_.execute(line_to(kThere), 3, local(5)));
  controller_.clear_fault(local(6));
  EXPECT_TRUE(controller_.observe(local(6)).ready);
  EXPECT_TRUE(controller_.execute(line_to(kThere), 4, local(6)));
}

TEST_F(SimControllerTest, AFrozenPostureRepeatsWithFreshStamps) {
  ASSERT_TRUE(controller_.execute(line_to(kThere), 1, local(0)));
  const ControllerState then = controller_.observe(local(1));
  controller_.freeze_posture(local(1));
  const ControllerState later_on = controller_.observe(local(3));
  EXPECT_EQ(later_on.joints, then.joints);
  EXPECT_EQ(later_on.at, local(3));
  EXPECT_EQ(later_on.motion.phase, MotionPhase::finished);
  controller_.unfreeze_posture();
  EXPECT_NEAR(y(local(3)), 0.1, 1e-6);
}

TEST_F(SimControllerTest, NotReadyOnRequest) {
  controller_.raise_fault("teach mode");
  EXPECT_FALSE(controller_.observe(local(0)).ready);
  EXPECT_FALSE(controller_.execute(line_to(kThere), 1, local(0)));
  controller_.clear_fault(local(0));
  EXPECT_TRUE(controller_.execute(joints_to(robot_.start), 1, local(0)));
  EXPECT_EQ(controller_.observe(local(0)).motion.phase, MotionPhase::finished) << "a move to where it stands takes no time";
}

}  // namespace
}  // namespace interlace::proxy
