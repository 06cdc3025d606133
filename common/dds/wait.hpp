#pragma once

#include <chrono>
#include <memory>

#include "common/dds/reader.hpp"

namespace eprosima::fastdds::dds {
class GuardCondition;
class WaitSet;
}  // namespace eprosima::fastdds::dds

namespace interlace::dds {

/// Where the one thread of a process waits for its readers. Loop: until(next deadline), take() from every attached reader, act.
class Wait {
 public:
  using Clock = std::chrono::steady_clock;

  Wait();
  ~Wait();
  Wait(const Wait&) = delete;
  Wait& operator=(const Wait&) = delete;

  /// Wakes for `reader` too. It must outlive this object, and be taken from after every wake: what is not taken wakes again at once.
  void attach(ReaderBase& reader);

  /// Returns true when an attached reader has a sample or an event (matched, deadline missed, liveliness), or after wake();
  /// false when `deadline` passed first.
  bool until(Clock::time_point deadline);

  /// Ends the running or the next until(). From any thread, not from a signal handler.
  void wake();

 private:
  std::unique_ptr<eprosima::fastdds::dds::WaitSet> set_;
  std::unique_ptr<eprosima::fastdds::dds::GuardCondition> woken_;
};

}  // namespace interlace::dds
