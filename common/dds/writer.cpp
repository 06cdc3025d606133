#include "common/dds/writer.hpp"

#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/topic/Topic.hpp>
#include <stdexcept>

#include "common/dds/convert.hpp"
#include "common/dds/qos.hpp"
#include "common/dds/wire_types.hpp"

namespace interlace::dds {

namespace fast = eprosima::fastdds::dds;

template <typename Message>
Writer<Message>::Writer(Participant& participant, const Topic<Message>& topic)
    : participant_(participant), name_(topic.name), owner_(topic.owner) {
  fast::Topic& made = participant.topic(topic.name, make_type<WireOf<Message>>());
  writer_ = participant.publisher().create_datawriter(&made, qos::writer(WireTraits<Message>::stream));
  if (writer_ == nullptr) throw std::runtime_error{"cannot create a DDS writer of " + topic.name};
}

template <typename Message>
Writer<Message>::~Writer() {
  participant_.publisher().delete_datawriter(writer_);
}

template <typename Message>
bool Writer<Message>::write(const Message& message) {
  WireOf<Message> wire = to_wire(message);
  // The readers' own rules, applied here: what goes wrong shows in the process that does it.
  if (const Converted<Message> accepted = from_wire(wire, owner_); !accepted) {
    last_refusal_ = name_ + ": " + accepted.error();
    return false;
  }
  last_refusal_.clear();
  return writer_->write(&wire);
}

template <typename Message>
std::int32_t Writer<Message>::matched() const {
  fast::PublicationMatchedStatus status;
  return writer_->get_publication_matched_status(status) == ReturnCode_t::RETCODE_OK ? status.current_count : 0;
}

template class Writer<CommandMessage>;
template class Writer<StatusMessage>;
template class Writer<DispatchMessage>;
template class Writer<ExecutionMessage>;
template class Writer<PostureMessage>;
template class Writer<model::PlannerState>;
template class Writer<model::PlannerJournal>;

}  // namespace interlace::dds
