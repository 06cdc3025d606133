#include "robot_proxy/drivers/sim/sim_driver.hpp"

#include <gtest/gtest.h>

#include <atomic>

#include "tests/unit/proxy/support.hpp"

namespace interlace::proxy {
namespace {

using test::arm;
using test::line_to;
using namespace std::chrono_literals;

/// What a proxy does: sleeps until the driver calls, then looks. Every wait ends after 10 s.
class Watcher {
 public:
  explicit Watcher(Driver& driver) : driver_(driver) {}
  Driver::Changed changed() {
    return [this] {
      const std::lock_guard lock(mutex_);
      ++calls_;
      wake_.notify_one();
    };
  }
  bool wait_for(MotionNumber number, MotionPhase phase) {
    const auto deadline = std::chrono::steady_clock::now() + 10s;
    int seen = -1;
    while (true) {
      const ControllerState state = driver_.observe();
      if (state.motion.number == number && state.motion.phase == phase) return true;
      std::unique_lock lock(mutex_);
      if (!wake_.wait_until(lock, deadline, [&] { return calls_ != seen; })) return false;
      seen = calls_;
    }
  }
  int calls() {
    const std::lock_guard lock(mutex_);
    return calls_;
  }

 private:
  Driver& driver_;
  std::mutex mutex_;
  std::condition_variable wake_;
  int calls_ = 0;
};

model::Robot quick_arm() {
  model::Robot robot = arm();
  robot.tcp.velocity = 1;
  robot.tcp.acceleration = 10;
  robot.controller = {0.005, 0.003, 0.05};
  return robot;
}

const model::Vector3 kHere{0.45, 0, 0.3};
const model::Vector3 kThere{0.45, 0.02, 0.3};

TEST(SimDriver, TellsOfBeginAndEndWithoutBeingPolled) {
  SimDriver driver{quick_arm()};
  Watcher watcher{driver};
  ASSERT_TRUE(driver.connect(watcher.changed(), 1s));
  EXPECT_FALSE(driver.connect(watcher.changed(), 1s)) << "connected already";
  for (MotionNumber n = 1; n <= 10; ++n) {
    const LocalTime before = std::chrono::steady_clock::now();
    ASSERT_TRUE(driver.execute(line_to(n % 2 == 1 ? kThere : kHere), n));
    ASSERT_TRUE(watcher.wait_for(n, MotionPhase::finished));
    const ControllerState state = driver.observe();
    EXPECT_GE(*state.motion.began, before + driver.capabilities().earliest_start);
    EXPECT_LE(*state.motion.began, state.at);
    EXPECT_LE(*state.motion.ended, state.at);
    EXPECT_LT((state.X_WT.translation() - (n % 2 == 1 ? kThere : kHere)).norm(), 1e-9);
  }
}

TEST(SimDriver, IsSilentAfterDisconnectAndConnectsAgain) {
  SimDriver driver{quick_arm()};
  Watcher watcher{driver};
  ASSERT_TRUE(driver.connect(watcher.changed(), 1s));
  ASSERT_TRUE(driver.execute(line_to(kThere), 1));
  driver.disconnect();
  driver.disconnect();
  const int calls = watcher.calls();
  ASSERT_TRUE(driver.stop());
  EXPECT_EQ(watcher.calls(), calls);
  ASSERT_TRUE(driver.connect(watcher.changed(), 1s));
  EXPECT_TRUE(watcher.wait_for(1, MotionPhase::refused) || watcher.wait_for(1, MotionPhase::failed));
}

TEST(SimDriver, StopsAndFailsAsTheContractSays) {
  SimDriver driver{quick_arm()};
  Watcher watcher{driver};
  ASSERT_TRUE(driver.connect(watcher.changed(), 1s));
  ASSERT_TRUE(driver.execute(line_to({0.45, 0.3, 0.3}), 1));
  ASSERT_TRUE(watcher.wait_for(1, MotionPhase::moving));
  ASSERT_TRUE(driver.stop());
  ASSERT_TRUE(watcher.wait_for(1, MotionPhase::failed));
  driver.with_controller([](SimController& controller, LocalTime) { controller.fail_next(0.3, "servo off"); });
  ASSERT_TRUE(driver.execute(line_to(kHere), 2));
  ASSERT_TRUE(watcher.wait_for(2, MotionPhase::failed));
  EXPECT_EQ(driver.observe().fault, "servo off");
}

TEST(SimDriver, MayBeWatchedFromManyThreads) {
  SimDriver driver{quick_arm()};
  Watcher watcher{driver};
  std::atomic<bool> done{false};
  ASSERT_TRUE(driver.connect(watcher.changed(), 1s));
  std::thread reader([&] {
    LocalTime last{};
    while (!done) {
      const ControllerState state = driver.observe();
      EXPECT_GE(state.at, last);
      last = state.at;
      std::this_thread::yield();
    }
  });
  for (MotionNumber n = 1; n <= 5; ++n) {
    EXPECT_TRUE(driver.execute(line_to(n % 2 == 1 ? kThere : kHere), n));
    EXPECT_TRUE(watcher.wait_for(n, MotionPhase::finished));
  }
  done = true;
  reader.join();
}

TEST(SimDriver, MayBeDestroyedWhileMoving) {
  const LocalTime before = std::chrono::steady_clock::now();
  {
    SimDriver driver{arm()};
    ASSERT_TRUE(driver.connect({}, 1s));
    ASSERT_TRUE(driver.execute(line_to(kThere), 1));
  }
  EXPECT_LT(std::chrono::steady_clock::now() - before, 500ms) << "it must not wait for the end of the motion or of an idle wait";
}

}  // namespace
}  // namespace interlace::proxy
