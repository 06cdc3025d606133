#include "common/app/signals.hpp"

#include <gtest/gtest.h>
#include <poll.h>
#include <unistd.h>

#include <condition_variable>
#include <mutex>
#include <vector>

namespace interlace::app {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr auto kLong = 10s;  // a test that waits this long has failed

void send(int signal) {
  ASSERT_EQ(kill(getpid(), signal), 0);
}

TEST(Signals, AreTakenOneByOne) {
  Signals signals;
  send(SIGTERM);
  EXPECT_EQ(signals.wait_until(Clock::now() + kLong), SIGTERM);
  send(SIGINT);
  EXPECT_EQ(signals.wait_until(Clock::now() + kLong), SIGINT);
  EXPECT_EQ(signals.wait_until(Clock::now()), std::nullopt);
}

TEST(Signals, DeadlineEndsTheWait) {
  Signals signals;
  const auto deadline = Clock::now() + 30ms;
  EXPECT_EQ(signals.wait_until(deadline), std::nullopt);
  EXPECT_GE(Clock::now(), deadline);
}

TEST(Signals, WakeAWaiterInAnotherThread) {
  Signals signals;
  std::thread sender{[] { send(SIGTERM); }};
  EXPECT_EQ(signals.wait_until(Clock::now() + kLong), SIGTERM);
  sender.join();
}

TEST(Signals, DescriptorTellsOfThem) {
  Signals signals;
  pollfd fd{signals.fd(), POLLIN, 0};
  EXPECT_EQ(poll(&fd, 1, 0), 0);
  send(SIGINT);
  EXPECT_EQ(poll(&fd, 1, 10'000), 1);
  EXPECT_EQ(signals.wait_until(Clock::now()), SIGINT);
}

TEST(Signals, CallbackSeesFirstAndSecond) {
  std::mutex mutex;
  std::condition_variable changed;
  std::vector<std::pair<int, int>> seen;
  Signals signals;
  signals.on_signal([&](int signal, int count) {
    const std::lock_guard lock{mutex};
    seen.emplace_back(signal, count);
    changed.notify_all();
  });
  const auto wait_for = [&](std::size_t n) {
    std::unique_lock lock{mutex};
    return changed.wait_for(lock, kLong, [&] { return seen.size() >= n; });
  };
  send(SIGINT);
  ASSERT_TRUE(wait_for(1));
  send(SIGINT);
  ASSERT_TRUE(wait_for(2));
  const std::vector<std::pair<int, int>> expected{{SIGINT, 1}, {SIGINT, 2}};
  EXPECT_EQ(seen, expected);
}

TEST(Signals, CallbackThreadJoinsWithoutASignal) {
  int called = 0;
  {
    Signals signals;
    signals.on_signal([&](int, int) { ++called; });
  }
  EXPECT_EQ(called, 0);
}

TEST(Signals, MaskReturnsAndLeftoversDoNotKill) {
  sigset_t before;
  pthread_sigmask(SIG_SETMASK, nullptr, &before);
  {
    Signals signals;
    send(SIGTERM);
  }
  sigset_t after;
  pthread_sigmask(SIG_SETMASK, nullptr, &after);
  EXPECT_EQ(sigismember(&before, SIGTERM), sigismember(&after, SIGTERM));
  EXPECT_EQ(sigismember(&after, SIGTERM), 0);
}

}  // namespace
}  // namespace interlace::app
