#include "common/dds/reader.hpp"

#include <fastdds/dds/core/condition/StatusCondition.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/Topic.hpp>
#include <stdexcept>

#include "common/dds/convert.hpp"
#include "common/dds/qos.hpp"
#include "common/dds/wire_types.hpp"

namespace interlace::dds {

namespace fast = eprosima::fastdds::dds;

ReaderBase::~ReaderBase() {
  if (reader_ != nullptr) participant_.subscriber().delete_datareader(reader_);
}

void ReaderBase::refresh() {
  fast::SubscriptionMatchedStatus matched;
  if (reader_->get_subscription_matched_status(matched) == ReturnCode_t::RETCODE_OK) counters_.writers = matched.current_count;
  fast::LivelinessChangedStatus liveliness;
  if (reader_->get_liveliness_changed_status(liveliness) == ReturnCode_t::RETCODE_OK) {
    counters_.alive = liveliness.alive_count;
    if (liveliness.not_alive_count_change > 0) counters_.leases_lost += static_cast<std::uint64_t>(liveliness.not_alive_count_change);
  }
  fast::RequestedDeadlineMissedStatus deadline;
  if (reader_->get_requested_deadline_missed_status(deadline) == ReturnCode_t::RETCODE_OK) {
    counters_.deadlines_missed = deadline.total_count;
  }
}

void ReaderBase::create(std::unique_ptr<fast::TopicDataType> type, const fast::DataReaderQos& qos) {
  fast::Topic& made = participant_.topic(name_, std::move(type));
  reader_ = participant_.subscriber().create_datareader(&made, qos);
  if (reader_ == nullptr) throw std::runtime_error{"cannot create a DDS reader of " + name_};
  fast::StatusMask events = fast::StatusMask::none();
  events << fast::StatusMask::data_available() << fast::StatusMask::subscription_matched() << fast::StatusMask::liveliness_changed()
         << fast::StatusMask::requested_deadline_missed();
  reader_->get_statuscondition().set_enabled_statuses(events);
}

void ReaderBase::refused(const std::string& rule) {
  ++counters_.refused;
  counters_.last_refusal = name_ + ": " + rule;
}

template <typename Message>
Reader<Message>::Reader(Participant& participant, const Topic<Message>& topic) : ReaderBase(participant, topic.name), owner_(topic.owner) {
  create(make_type<WireOf<Message>>(), qos::reader(WireTraits<Message>::stream));
}

template <typename Message>
bool Reader<Message>::next(Message& message) {
  WireOf<Message> wire;
  fast::SampleInfo info;
  while (reader_->take_next_sample(&wire, &info) == ReturnCode_t::RETCODE_OK) {
    if (!info.valid_data) continue;  // a writer left: no message
    Converted<Message> converted = from_wire(wire, owner_);
    if (converted) {
      ++counters_.received;
      message = std::move(*converted);
      return true;
    }
    refused(converted.error());
  }
  return false;
}

template class Reader<CommandMessage>;
template class Reader<StatusMessage>;
template class Reader<DispatchMessage>;
template class Reader<ExecutionMessage>;
template class Reader<PostureMessage>;
template class Reader<model::PlannerState>;
template class Reader<model::PlannerJournal>;

}  // namespace interlace::dds
