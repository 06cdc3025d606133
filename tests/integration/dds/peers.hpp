#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/dds/participant.hpp"
#include "common/dds/reader.hpp"
#include "common/dds/wait.hpp"
#include "common/dds/writer.hpp"
#include "tests/support/domain.hpp"

namespace interlace::test {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

/// Longest time anything may take on a busy machine before a test gives up; nothing waits this long when all is well.
inline constexpr auto kPatience = 20s;

/// Waits on `wait`, running `step` after every wake, until it returns true. False after kPatience.
inline bool wait_until(dds::Wait& wait, const std::function<bool()>& step, Clock::duration patience = kPatience) {
  const auto deadline = Clock::now() + patience;
  while (!step()) {
    if (Clock::now() >= deadline) return false;
    wait.until(std::min(deadline, Clock::now() + 20ms));
  }
  return true;
}

/// A writer and a reader of one topic, each in a participant of its own, as in two processes.
template <typename Message>
class Pair {
 public:
  explicit Pair(const dds::Topic<Message>& topic) : writer(sender_, topic), reader(receiver_, topic) { wait_.attach(reader); }

  [[nodiscard]] bool match() {
    return wait_until(wait_, [&] {
      reader.take([](Message&&) {});
      return writer.matched() == 1 && reader.counters().writers == 1;
    });
  }

  /// Sends `message` and returns what arrives.
  [[nodiscard]] std::optional<Message> pass(const Message& message) {
    std::optional<Message> arrived;
    if (!writer.write(message)) return arrived;
    wait_until(wait_, [&] {
      reader.take([&](Message&& m) { arrived = std::move(m); });
      return arrived.has_value();
    });
    return arrived;
  }

 private:
  dds::Participant sender_{{unique_domain(), "sender"}};
  dds::Participant receiver_{{unique_domain(), "receiver"}};

 public:
  dds::Writer<Message> writer;
  dds::Reader<Message> reader;

 private:
  dds::Wait wait_;
};

}  // namespace interlace::test
