#include "tests/support/process.hpp"

#include <gtest/gtest.h>

// The promise every other test here relies on: no process outlives its test.
namespace interlace::test {
namespace {

using namespace std::chrono_literals;

/// True once the process has ended.
bool gone(int pidfd, std::chrono::milliseconds patience) {
  pollfd ended{pidfd, POLLIN, 0};
  return ::poll(&ended, 1, static_cast<int>(patience.count())) == 1;
}

int pidfd_of(pid_t pid) {
  return static_cast<int>(::syscall(SYS_pidfd_open, pid, 0));
}

TEST(ProcessSupport, TellsExitCodesAndOutput) {
  Process process{{"/bin/sh", "-c", "echo out; echo err >&2; exit 7"}, true};
  EXPECT_EQ(process.wait(20s), 7);
  EXPECT_EQ(process.output(), "out\n");
  EXPECT_EQ(process.errors(), "err\n");
  EXPECT_EQ(process.wait(0ms), 7) << "asked again";
}

TEST(ProcessSupport, WaitsNoLongerThanAllowed) {
  Process process{{"/bin/sleep", "60"}};
  EXPECT_EQ(process.wait(10ms), std::nullopt);
  EXPECT_TRUE(process.running());
  process.kill(SIGTERM);
  EXPECT_EQ(process.wait(20s), 128 + SIGTERM);
}

TEST(ProcessSupport, AMissingProgramIsNoSuccess) {
  Process process{{"/no/such/program"}};
  EXPECT_EQ(process.wait(20s), 127);
}

TEST(ProcessSupport, EndsWithItsObjectTogetherWithItsChildren) {
  int child = -1;
  int grandchild = -1;
  {
    Process process{{"/bin/sh", "-c", "sleep 60 & echo $! >&2; wait"}, true};
    ASSERT_TRUE(process.logs("\n", 20s));
    child = pidfd_of(process.pid());
    grandchild = pidfd_of(std::stoi(process.errors()));
    ASSERT_GE(child, 0);
    ASSERT_GE(grandchild, 0);
  }
  EXPECT_TRUE(gone(child, 20s));
  EXPECT_TRUE(gone(grandchild, 20s));
  ::close(child);
  ::close(grandchild);
}

TEST(ProcessSupport, EndsWithATestThatCrashes) {
  int ends[2];
  ASSERT_EQ(::pipe(ends), 0);
  const pid_t crashing = ::fork();
  ASSERT_GE(crashing, 0);
  if (crashing == 0) {
    const Process process{{"/bin/sleep", "60"}};
    const pid_t pid = process.pid();
    if (::write(ends[1], &pid, sizeof pid) == sizeof pid) ::pause();  // until it is killed, as by a crash: no destructor runs
    ::_exit(1);
  }
  pid_t pid = -1;
  ASSERT_EQ(::read(ends[0], &pid, sizeof pid), static_cast<ssize_t>(sizeof pid));
  const int pidfd = pidfd_of(pid);
  ASSERT_GE(pidfd, 0);
  ::kill(crashing, SIGKILL);
  ::waitpid(crashing, nullptr, 0);
  EXPECT_TRUE(gone(pidfd, 20s));
  for (const int fd : {pidfd, ends[0], ends[1]}) ::close(fd);
}

}  // namespace
}  // namespace interlace::test
