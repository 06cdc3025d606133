#pragma once

#include <cstdint>
#include <fastdds/dds/topic/TopicDataType.hpp>
#include <memory>
#include <vector>

#include "common/dds/envelope.hpp"
#include "common/dds/qos.hpp"
#include "common/model/journal.hpp"
#include "interlace.h"

/// Which IDL type and which stream carries each message. Internal to common/dds.
namespace interlace::dds {

template <typename Message>
struct WireTraits;

template <>
struct WireTraits<CommandMessage> {
  using Wire = ::interlace::Command;
  static constexpr qos::Stream stream = qos::Stream::command;
};
template <>
struct WireTraits<StatusMessage> {
  using Wire = ::interlace::CommandStatus;
  static constexpr qos::Stream stream = qos::Stream::command_status;
};
template <>
struct WireTraits<DispatchMessage> {
  using Wire = ::interlace::Dispatch;
  static constexpr qos::Stream stream = qos::Stream::dispatch;
};
template <>
struct WireTraits<ExecutionMessage> {
  using Wire = ::interlace::Execution;
  static constexpr qos::Stream stream = qos::Stream::execution;
};
template <>
struct WireTraits<PostureMessage> {
  using Wire = ::interlace::Posture;
  static constexpr qos::Stream stream = qos::Stream::posture;
};
template <>
struct WireTraits<model::PlannerState> {
  using Wire = ::interlace::PlannerState;
  static constexpr qos::Stream stream = qos::Stream::planner_state;
};

template <>
struct WireTraits<model::PlannerJournal> {
  using Wire = ::interlace::PlannerJournal;
  static constexpr qos::Stream stream = qos::Stream::planner_journal;
};

template <typename Message>
using WireOf = typename WireTraits<Message>::Wire;

/// Serialisation of `Wire` that survives any bytes: what cannot be read becomes a sample of version 0, which a Reader refuses and counts.
template <typename Wire>
[[nodiscard]] std::unique_ptr<eprosima::fastdds::dds::TopicDataType> make_type();

/// A sample together with the bytes it came in.
template <typename Wire>
struct Recorded : Wire {
  std::vector<std::uint8_t> cdr;
};

/// The same for a participant that records: its samples are Recorded<Wire>.
template <typename Wire>
[[nodiscard]] std::unique_ptr<eprosima::fastdds::dds::TopicDataType> make_recorded_type();

}  // namespace interlace::dds
