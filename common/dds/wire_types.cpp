#include "common/dds/wire_types.hpp"

#include <fastcdr/Cdr.h>
#include <fastcdr/FastBuffer.h>

#include <exception>
#include <string>

#include "common/dds/limits.hpp"
#include "interlacePubSubTypes.h"

namespace interlace::dds {
namespace {

using eprosima::fastcdr::Cdr;
using eprosima::fastrtps::rtps::SerializedPayload_t;

template <typename T>
void skip(Cdr& cdr) {
  T ignored{};
  cdr >> ignored;
}

template <typename... T>
void skip_all(Cdr& cdr) {
  (skip<T>(cdr), ...);
}

bool length_within(Cdr& cdr, std::size_t limit, std::uint32_t& length) {
  cdr >> length;
  return length <= limit;
}

/// Reads over conflicts and refusals.
bool evidence_is_bounded(Cdr& cdr) {
  std::uint32_t conflicts = 0;
  if (!length_within(cdr, kMaxConflicts, conflicts)) return false;
  for (std::uint32_t c = 0; c < conflicts; ++c) {
    skip_all<std::string, std::string, std::string, std::int64_t, std::int64_t, double, double, double, double>(cdr);
  }
  std::uint32_t refusals = 0;
  if (!length_within(cdr, kMaxRefusals, refusals)) return false;
  for (std::uint32_t r = 0; r < refusals; ++r) skip_all<std::string, std::uint32_t, std::string>(cdr);
  return true;
}

/// Reads over the names of tools.
bool tools_are_bounded(Cdr& cdr) {
  std::uint32_t tools = 0;
  if (!length_within(cdr, kMaxTools, tools)) return false;
  for (std::uint32_t t = 0; t < tools; ++t) skip<std::string>(cdr);
  return true;
}

/// `count` numbers.
void skip_numbers(Cdr& cdr, int count) {
  for (int i = 0; i < count; ++i) skip<double>(cdr);
}

void skip_goal(Cdr& cdr) {
  skip_numbers(cdr, 3 + 4 + 6);
  skip_all<bool, double, bool, double, std::string, std::string, std::uint32_t>(cdr);
}

// The generated reader makes room for as many elements as the bytes claim, before it looks for them: four forged bytes would take all
// memory. So the claims are checked first, in the layout of the IDL. Messages without sequences have nothing to check.
template <typename Wire>
bool lengths_are_bounded(Cdr& /*cdr*/) {
  return true;
}

template <>
bool lengths_are_bounded<::interlace::Command>(Cdr& cdr) {
  skip_all<std::uint32_t, std::uint32_t, std::string, std::string, std::string>(cdr);
  skip_goal(cdr);
  skip_all<std::int32_t, bool, double>(cdr);
  std::uint32_t entries = 0;
  if (!length_within(cdr, kMaxReplacement, entries)) return false;
  for (std::uint32_t e = 0; e < entries; ++e) {
    skip_all<std::string, std::uint32_t>(cdr);
    skip_goal(cdr);
    skip_all<std::int32_t, bool, double>(cdr);
  }
  return true;
}

template <>
bool lengths_are_bounded<::interlace::CommandStatus>(Cdr& cdr) {
  skip_all<std::uint32_t, std::uint64_t, std::string, std::string, bool, std::string, std::uint32_t, std::uint32_t, std::string,
           std::int64_t, bool, std::int64_t, bool, std::int64_t, double>(cdr);
  return evidence_is_bounded(cdr);
}

template <>
bool lengths_are_bounded<::interlace::PlannerState>(Cdr& cdr) {
  skip_all<std::uint32_t, std::string, std::uint64_t, std::uint64_t, std::int64_t, std::string>(cdr);
  std::uint32_t robots = 0;
  if (!length_within(cdr, kMaxRobots, robots)) return false;
  for (std::uint32_t r = 0; r < robots; ++r) {
    skip_all<std::string, std::uint32_t, std::uint32_t, std::string, std::string, std::uint32_t, std::string>(cdr);
    if (!evidence_is_bounded(cdr) || !tools_are_bounded(cdr)) return false;
    skip<bool>(cdr);
  }
  return true;
}

template <>
bool lengths_are_bounded<::interlace::Dispatch>(Cdr& cdr) {
  skip_all<std::uint32_t, std::uint64_t, std::uint64_t, std::uint32_t, std::string, std::string, std::uint32_t, std::uint32_t>(cdr);
  skip_goal(cdr);
  skip_numbers(cdr, 6);
  return tools_are_bounded(cdr);
}

template <>
bool lengths_are_bounded<::interlace::Execution>(Cdr& cdr) {
  skip_all<std::uint32_t, std::uint64_t, std::uint64_t, std::string, std::string, std::uint32_t, std::uint32_t, std::int64_t, double>(cdr);
  skip_numbers(cdr, 6);
  skip<std::string>(cdr);
  return tools_are_bounded(cdr);
}

template <>
bool lengths_are_bounded<::interlace::Posture>(Cdr& cdr) {
  skip_all<std::uint32_t, std::string, std::uint64_t, std::uint64_t, std::uint64_t, std::int64_t, std::int64_t, double>(cdr);
  skip_numbers(cdr, 6 + 3 + 4);
  skip_all<bool, bool, std::string>(cdr);
  return tools_are_bounded(cdr);
}

/// None or one `Wire`, read over.
template <typename Wire>
bool at_most_one_is_bounded(Cdr& cdr, std::uint32_t& count) {
  return length_within(cdr, 1, count) && (count == 0 || lengths_are_bounded<Wire>(cdr));
}

template <>
bool lengths_are_bounded<::interlace::PlannerJournal>(Cdr& cdr) {
  skip_all<std::uint32_t, std::string, std::uint64_t, std::uint64_t>(cdr);
  skip_all<std::string, bool, std::int64_t, std::int64_t, std::int64_t, bool, std::int64_t, std::int64_t, std::int64_t, std::uint64_t,
           std::string, std::uint64_t>(cdr);
  skip<std::uint64_t>(cdr);
  std::uint32_t calls = 0;
  if (!length_within(cdr, kMaxCalls, calls)) return false;
  for (std::uint32_t c = 0; c < calls; ++c) {
    skip_all<std::uint32_t, std::int64_t>(cdr);
    std::uint32_t count = 0;
    if (!at_most_one_is_bounded<::interlace::Command>(cdr, count)) return false;
    if (!at_most_one_is_bounded<::interlace::Posture>(cdr, count)) return false;
    if (count == 1) skip<bool>(cdr);  // what a posture has behind its last sequence
    if (!at_most_one_is_bounded<::interlace::Execution>(cdr, count)) return false;
    if (!length_within(cdr, kMaxReplacement, count)) return false;
    skip_numbers(cdr, 9 * static_cast<int>(count));
    skip_all<std::uint32_t, std::uint32_t, std::uint32_t, std::uint64_t>(cdr);
  }
  return true;
}

/// The generated type with its doors closed: no exception leaves it, because it also runs in threads that are not ours.
template <typename Generated>
class GuardedType : public Generated {
 public:
  using Wire = typename Generated::type;

  bool deserialize(SerializedPayload_t* payload, void* data) override {
    if (!read(payload, data)) *static_cast<Wire*>(data) = Wire{};
    return true;
  }

 private:
  bool read(SerializedPayload_t* payload, void* data) {
    try {
      eprosima::fastcdr::FastBuffer bytes{reinterpret_cast<char*>(payload->data), payload->length};
      Cdr cdr{bytes, Cdr::DEFAULT_ENDIAN, Cdr::DDS_CDR};
      cdr.read_encapsulation();
      return lengths_are_bounded<Wire>(cdr) && Generated::deserialize(payload, data);
    } catch (const std::exception&) {
      return false;
    }
  }
};

/// The same, and the bytes are kept beside what they mean.
template <typename Generated>
class RecordedType : public GuardedType<Generated> {
 public:
  using Sample = Recorded<typename Generated::type>;

  bool deserialize(SerializedPayload_t* payload, void* data) override {
    auto* sample = static_cast<Sample*>(data);
    sample->cdr.assign(payload->data, payload->data + payload->length);
    return GuardedType<Generated>::deserialize(payload, static_cast<typename Generated::type*>(sample));
  }
  void* createData() override { return new Sample; }
  void deleteData(void* data) override { delete static_cast<Sample*>(data); }
};

template <typename Wire>
struct GeneratedOf;
template <>
struct GeneratedOf<::interlace::Command> {
  using Type = ::interlace::CommandPubSubType;
};
template <>
struct GeneratedOf<::interlace::CommandStatus> {
  using Type = ::interlace::CommandStatusPubSubType;
};
template <>
struct GeneratedOf<::interlace::Dispatch> {
  using Type = ::interlace::DispatchPubSubType;
};
template <>
struct GeneratedOf<::interlace::Execution> {
  using Type = ::interlace::ExecutionPubSubType;
};
template <>
struct GeneratedOf<::interlace::Posture> {
  using Type = ::interlace::PosturePubSubType;
};
template <>
struct GeneratedOf<::interlace::PlannerState> {
  using Type = ::interlace::PlannerStatePubSubType;
};
template <>
struct GeneratedOf<::interlace::PlannerJournal> {
  using Type = ::interlace::PlannerJournalPubSubType;
};

}  // namespace

template <typename Wire>
std::unique_ptr<eprosima::fastdds::dds::TopicDataType> make_type() {
  return std::make_unique<GuardedType<typename GeneratedOf<Wire>::Type>>();
}

template <typename Wire>
std::unique_ptr<eprosima::fastdds::dds::TopicDataType> make_recorded_type() {
  return std::make_unique<RecordedType<typename GeneratedOf<Wire>::Type>>();
}

template std::unique_ptr<eprosima::fastdds::dds::TopicDataType> make_type<::interlace::Command>();
template std::unique_ptr<eprosima::fastdds::dds::TopicDataType> make_type<::interlace::CommandStatus>();
template std::unique_ptr<eprosima::fastdds::dds::TopicDataType> make_type<::interlace::Dispatch>();
template std::unique_ptr<eprosima::fastdds::dds::TopicDataType> make_type<::interlace::Execution>();
template std::unique_ptr<eprosima::fastdds::dds::TopicDataType> make_type<::interlace::Posture>();
template std::unique_ptr<eprosima::fastdds::dds::TopicDataType> make_type<::interlace::PlannerState>();
template std::unique_ptr<eprosima::fastdds::dds::TopicDataType> make_type<::interlace::PlannerJournal>();
template std::unique_ptr<eprosima::fastdds::dds::TopicDataType> make_recorded_type<::interlace::Command>();
template std::unique_ptr<eprosima::fastdds::dds::TopicDataType> make_recorded_type<::interlace::CommandStatus>();
template std::unique_ptr<eprosima::fastdds::dds::TopicDataType> make_recorded_type<::interlace::Dispatch>();
template std::unique_ptr<eprosima::fastdds::dds::TopicDataType> make_recorded_type<::interlace::Execution>();
template std::unique_ptr<eprosima::fastdds::dds::TopicDataType> make_recorded_type<::interlace::Posture>();
template std::unique_ptr<eprosima::fastdds::dds::TopicDataType> make_recorded_type<::interlace::PlannerState>();
template std::unique_ptr<eprosima::fastdds::dds::TopicDataType> make_recorded_type<::interlace::PlannerJournal>();

}  // namespace interlace::dds
