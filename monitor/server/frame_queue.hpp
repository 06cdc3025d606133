#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>

#include "monitor/frame.hpp"

namespace interlace::monitor {

/// How much may wait for one viewer.
struct QueueLimits {
  std::size_t frames = 256;
  std::size_t bytes = 4U << 20U;
};

/// What waits to be written to one viewer, bounded however slow it is. A pose that waits is replaced by a newer one; when too much else
/// waits, all of it is dropped and made up for by a snapshot, which is never dropped for its size. What was skipped is counted and told
/// to the viewer before the next frame. Pure. Not thread-safe.
class FrameQueue {
 public:
  explicit FrameQueue(QueueLimits limits = {}) : limits_(limits) {}

  /// Until the first snapshot everything else is left out: the snapshot has it.
  void push(const Frame& frame);
  /// The next text to write; null when there is none.
  [[nodiscard]] std::shared_ptr<const std::string> pop();

  /// Nothing useful can be shown before a snapshot comes.
  [[nodiscard]] bool wants_snapshot() const { return !current_; }
  [[nodiscard]] bool empty() const { return waiting_.empty(); }
  [[nodiscard]] std::size_t size() const { return waiting_.size(); }
  [[nodiscard]] std::size_t bytes() const { return bytes_; }
  [[nodiscard]] std::uint64_t skipped() const { return skipped_; }  ///< so far, told or not

 private:
  void append(const Frame& frame);
  void drop_pose();
  void drop_all();

  QueueLimits limits_;
  std::deque<Frame> waiting_;
  std::size_t bytes_ = 0;
  bool current_ = false;  // a snapshot and everything since is written or waits
  std::uint64_t skipped_ = 0, told_ = 0;
};

}  // namespace interlace::monitor
