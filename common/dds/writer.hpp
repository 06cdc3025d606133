#pragma once

#include <cstdint>
#include <string>

#include "common/dds/participant.hpp"
#include "common/dds/topics.hpp"

namespace eprosima::fastdds::dds {
class DataWriter;
}  // namespace eprosima::fastdds::dds

namespace interlace::dds {

/// Sends `Message` on one topic. On dispatch, posture and planner_state each write also tells the readers that this process lives, so
/// write at the periods of topics.hpp. Not thread-safe: one thread creates it, writes and destroys it, before the Participant.
template <typename Message>
class Writer {
 public:
  /// Throws std::runtime_error when Fast DDS refuses the topic.
  Writer(Participant& participant, const Topic<Message>& topic);
  ~Writer();
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  /// False when the message breaks a rule its readers would refuse it for (see last_refusal) or DDS did not take it. True is no receipt:
  /// answers and retries are the application's. Blocks for 100 ms at most.
  [[nodiscard]] bool write(const Message& message);

  /// Readers that are matched now. Samples written before a reader matches are lost to it, except on posture and planner_state.
  [[nodiscard]] std::int32_t matched() const;

  [[nodiscard]] const std::string& name() const { return name_; }
  /// Why the last false write() was refused; empty when there was none, or when DDS itself failed.
  [[nodiscard]] const std::string& last_refusal() const { return last_refusal_; }

 private:
  Participant& participant_;
  std::string name_;
  std::string owner_;
  std::string last_refusal_;
  eprosima::fastdds::dds::DataWriter* writer_ = nullptr;
};

extern template class Writer<CommandMessage>;
extern template class Writer<StatusMessage>;
extern template class Writer<DispatchMessage>;
extern template class Writer<ExecutionMessage>;
extern template class Writer<PostureMessage>;
extern template class Writer<model::PlannerState>;
extern template class Writer<model::PlannerJournal>;

}  // namespace interlace::dds
