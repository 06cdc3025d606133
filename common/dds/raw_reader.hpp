#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/dds/reader.hpp"

namespace interlace::dds {

/// A sample as it came: checked like every other, but not changed.
struct RawSample {
  std::vector<std::uint8_t> cdr;  ///< with its four bytes of head
  std::int64_t published = 0;     ///< when its writer sent it, by the writer's wall clock [ns since 1970]
};

/// Receives the bytes of `Message` on one topic, for recording; keeps many samples of a state where a Reader keeps the newest. What a
/// Reader would refuse is refused here. A participant has either readers or raw readers of a type. Not thread-safe, as Reader.
template <typename Message>
class RawReader : public ReaderBase {
 public:
  /// Throws std::runtime_error when Fast DDS refuses the topic.
  RawReader(Participant& participant, const Topic<Message>& topic);

  /// Calls `each(const RawSample&, const Message&)` for every good sample that has come, oldest first. Never blocks.
  template <typename Each>
  void take(Each&& each) {
    refresh();
    RawSample sample;
    for (Message message; next(sample, message);) each(sample, message);
  }

 private:
  [[nodiscard]] bool next(RawSample& sample, Message& message);

  std::string owner_;
};

extern template class RawReader<CommandMessage>;
extern template class RawReader<StatusMessage>;
extern template class RawReader<DispatchMessage>;
extern template class RawReader<ExecutionMessage>;
extern template class RawReader<PostureMessage>;
extern template class RawReader<model::PlannerState>;
extern template class RawReader<model::PlannerJournal>;

}  // namespace interlace::dds
