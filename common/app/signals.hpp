#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <thread>

#include <csignal>

namespace interlace::app {

/// SIGTERM and SIGINT as something to wait for, not as interruptions. Build it first in main: it blocks both in the calling thread, and
/// threads started later inherit that. Nothing runs in signal context. The old mask returns with the destructor.
/// One object per process; use fd, wait_until or on_signal, not two of them at a time.
class Signals {
 public:
  /// Throws std::system_error when the kernel refuses.
  Signals();
  ~Signals();
  Signals(const Signals&) = delete;
  Signals& operator=(const Signals&) = delete;

  /// Readable while a signal waits to be taken; for poll. Owned by this object.
  [[nodiscard]] int fd() const { return signal_fd_; }

  /// Takes the next signal and returns its number; empty when `deadline` passes first. A deadline in the past asks without waiting.
  [[nodiscard]] std::optional<int> wait_until(std::chrono::steady_clock::time_point deadline);

  /// Calls `callback(signal, count)` from a thread of its own for each signal from now on; `count` is 1 for the first, so a program can end
  /// at once at the second. The thread ends with this object; the callback must not destroy it. Call at most once.
  void on_signal(std::function<void(int signal, int count)> callback);

  /// Returns when the callback is done and will not be called again: before what it touches goes. Signals stay blocked.
  void stop_calling();

 private:
  enum class Wake { signal, stop, deadline };
  [[nodiscard]] Wake wait(std::optional<std::chrono::steady_clock::time_point> deadline) const;
  [[nodiscard]] std::optional<int> take() const;

  sigset_t old_mask_{};
  int signal_fd_ = -1;
  int stop_fd_ = -1;
  std::thread thread_;
};

}  // namespace interlace::app
