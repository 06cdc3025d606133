#include "common/app/signals.hpp"

#include <poll.h>
#include <sys/eventfd.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <system_error>

namespace interlace::app {

namespace {

using Clock = std::chrono::steady_clock;

[[noreturn]] void fail(int error, const char* what) {
  throw std::system_error(error, std::generic_category(), what);
}

/// Time left for poll, rounded up so that it never returns just before the deadline.
int milliseconds_until(Clock::time_point deadline) {
  const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now()).count();
  return static_cast<int>(std::clamp<std::int64_t>(left, 0, 3'600'000));
}

}  // namespace

Signals::Signals() {
  sigset_t mask;
  sigemptyset(&mask);
  sigaddset(&mask, SIGTERM);
  sigaddset(&mask, SIGINT);
  if (const int error = pthread_sigmask(SIG_BLOCK, &mask, &old_mask_); error != 0) fail(error, "blocking signals");
  signal_fd_ = signalfd(-1, &mask, SFD_NONBLOCK | SFD_CLOEXEC);
  if (signal_fd_ < 0) fail(errno, "signalfd");
  stop_fd_ = eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC);
  if (stop_fd_ < 0) {
    const int error = errno;
    close(signal_fd_);
    fail(error, "eventfd");
  }
}

void Signals::stop_calling() {
  if (!thread_.joinable()) return;
  const std::uint64_t one = 1;
  [[maybe_unused]] const auto written = write(stop_fd_, &one, sizeof one);  // an eventfd at 0 always takes a 1
  thread_.join();
}

Signals::~Signals() {
  stop_calling();
  while (take()) {  // a signal left over must not kill the process when the mask goes
  }
  close(stop_fd_);
  close(signal_fd_);
  pthread_sigmask(SIG_SETMASK, &old_mask_, nullptr);
}

Signals::Wake Signals::wait(std::optional<Clock::time_point> deadline) const {
  std::array<pollfd, 2> fds{{{signal_fd_, POLLIN, 0}, {stop_fd_, POLLIN, 0}}};
  while (true) {
    const int ready = poll(fds.data(), fds.size(), deadline ? milliseconds_until(*deadline) : -1);
    if (ready > 0) return fds[1].revents != 0 ? Wake::stop : Wake::signal;
    if (ready < 0 && errno != EINTR) fail(errno, "poll");
    if (deadline && Clock::now() >= *deadline) return Wake::deadline;
  }
}

std::optional<int> Signals::take() const {
  signalfd_siginfo info{};
  if (read(signal_fd_, &info, sizeof info) != static_cast<ssize_t>(sizeof info)) return std::nullopt;
  return static_cast<int>(info.ssi_signo);
}

std::optional<int> Signals::wait_until(Clock::time_point deadline) {
  while (wait(deadline) == Wake::signal) {
    if (const auto signal = take()) return signal;
  }
  return std::nullopt;
}

void Signals::on_signal(std::function<void(int signal, int count)> callback) {
  thread_ = std::thread([this, callback = std::move(callback)] {
    int count = 0;
    while (wait(std::nullopt) == Wake::signal) {
      if (const auto signal = take()) callback(*signal, ++count);
    }
  });
}

}  // namespace interlace::app
