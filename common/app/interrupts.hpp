#pragma once

#include <atomic>
#include <functional>
#include <mutex>

#include "common/app/signals.hpp"

namespace interlace::app {

/// Ctrl-C and SIGTERM for a program that works until it is done: the first asks it to end, the second ends the process at once with exit
/// code 130. Build it first in main. Functions from the main thread, `requested` from any.
class Interrupts {
 public:
  Interrupts();

  [[nodiscard]] bool requested() const { return requested_; }

  /// Calls `waker` from another thread at the first signal, while the returned object lives; at once when there was one already.
  class Scope {
   public:
    Scope(Interrupts& owner, std::function<void()> waker);
    ~Scope();
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

   private:
    Interrupts& owner_;
  };

 private:
  std::atomic<bool> requested_{false};
  std::mutex mutex_;
  std::function<void()> waker_;
  Signals signals_;  // last: its thread ends before what it calls goes
};

}  // namespace interlace::app
