#include "common/dds/raw_reader.hpp"

#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>

#include "common/dds/convert.hpp"
#include "common/dds/qos.hpp"
#include "common/dds/wire_types.hpp"

namespace interlace::dds {

namespace fast = eprosima::fastdds::dds;

namespace {

constexpr std::int32_t kRawDepth = 256;  // samples per topic and instance between two takes: two seconds of postures

}  // namespace

template <typename Message>
RawReader<Message>::RawReader(Participant& participant, const Topic<Message>& topic)
    : ReaderBase(participant, topic.name), owner_(topic.owner) {
  create(make_recorded_type<WireOf<Message>>(), qos::reader(WireTraits<Message>::stream, kRawDepth));
}

template <typename Message>
bool RawReader<Message>::next(RawSample& sample, Message& message) {
  Recorded<WireOf<Message>> recorded;
  fast::SampleInfo info;
  while (reader_->take_next_sample(&recorded, &info) == ReturnCode_t::RETCODE_OK) {
    if (!info.valid_data) continue;  // a writer left: no message
    Converted<Message> converted = from_wire(recorded, owner_);
    if (converted) {
      ++counters_.received;
      message = std::move(*converted);
      sample.cdr.swap(recorded.cdr);
      sample.published = info.source_timestamp.to_ns();
      return true;
    }
    refused(converted.error());
  }
  return false;
}

template class RawReader<CommandMessage>;
template class RawReader<StatusMessage>;
template class RawReader<DispatchMessage>;
template class RawReader<ExecutionMessage>;
template class RawReader<PostureMessage>;
template class RawReader<model::PlannerState>;
template class RawReader<model::PlannerJournal>;

}  // namespace interlace::dds
