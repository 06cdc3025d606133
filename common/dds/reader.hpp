#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "common/dds/participant.hpp"
#include "common/dds/topics.hpp"

namespace eprosima::fastdds::dds {
class DataReader;
class DataReaderQos;
class Entity;
class TopicDataType;
}  // namespace eprosima::fastdds::dds

namespace interlace::dds {

/// What a Reader has seen so far.
struct ReaderCounters {
  std::uint64_t received = 0;          ///< good samples handed over
  std::uint64_t refused = 0;           ///< samples that broke a rule of idl/README.md
  std::string last_refusal;            ///< why, for a log line: the field, its value and the rule
  std::int32_t writers = 0;            ///< matched now
  std::int32_t alive = 0;              ///< of those, heard within their lease
  std::uint64_t deadlines_missed = 0;  ///< periods without a sample (dispatch, posture, planner_state)
  std::uint64_t leases_lost = 0;       ///< times a writer fell silent for longer than its lease (ditto)
};

/// The part of a Reader that does not depend on the message.
class ReaderBase {
 public:
  ReaderBase(const ReaderBase&) = delete;
  ReaderBase& operator=(const ReaderBase&) = delete;

  /// Up to date after each take().
  [[nodiscard]] const ReaderCounters& counters() const { return counters_; }
  [[nodiscard]] const std::string& name() const { return name_; }

 protected:
  ReaderBase(Participant& participant, std::string name) : participant_(participant), name_(std::move(name)) {}
  ~ReaderBase();

  /// Makes the reader of `type` on the topic of this name. Throws std::runtime_error.
  void create(std::unique_ptr<eprosima::fastdds::dds::TopicDataType> type, const eprosima::fastdds::dds::DataReaderQos& qos);
  /// Counts a sample that broke `rule`.
  void refused(const std::string& rule);

  /// Reads the events since the last call into the counters; a Wait would return at once until this is done.
  void refresh();

  Participant& participant_;
  std::string name_;
  eprosima::fastdds::dds::DataReader* reader_ = nullptr;
  ReaderCounters counters_;

 private:
  friend class Wait;
};

/// Receives `Message` on one topic. Every sample is checked; a bad one is refused and counted, and does not disturb the next.
/// Not thread-safe: one thread creates it, takes from it and destroys it, before the Participant.
template <typename Message>
class Reader : public ReaderBase {
 public:
  /// Throws std::runtime_error when Fast DDS refuses the topic.
  Reader(Participant& participant, const Topic<Message>& topic);

  /// Calls `each(Message&&)` for every good sample that has come, oldest first, and returns how many there were. Never blocks.
  template <typename Each>
  std::size_t take(Each&& each) {
    refresh();
    std::size_t taken = 0;
    for (Message message; next(message); ++taken) each(std::move(message));
    return taken;
  }

 private:
  [[nodiscard]] bool next(Message& message);  // false: nothing left

  std::string owner_;
};

extern template class Reader<CommandMessage>;
extern template class Reader<StatusMessage>;
extern template class Reader<DispatchMessage>;
extern template class Reader<ExecutionMessage>;
extern template class Reader<PostureMessage>;
extern template class Reader<model::PlannerState>;
extern template class Reader<model::PlannerJournal>;

}  // namespace interlace::dds
