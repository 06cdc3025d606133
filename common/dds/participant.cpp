#include "common/dds/participant.hpp"

#include <fastrtps/xmlparser/XMLProfileManager.h>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/log/Log.hpp>
#include <fastdds/dds/log/StdoutErrConsumer.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/Topic.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>
#include <stdexcept>

#include "common/dds/qos.hpp"

namespace interlace::dds {

namespace fast = eprosima::fastdds::dds;

namespace {

/// Two participants in one process (only tests do that) talk over the wire like any others, instead of through a short cut.
void talk_over_the_wire() {
  eprosima::fastrtps::LibrarySettingsAttributes settings;
  settings.intraprocess_delivery = eprosima::fastrtps::INTRAPROCESS_OFF;
  eprosima::fastrtps::xmlparser::XMLProfileManager::library_settings(settings);
}

/// Standard output belongs to the programs: reports and JSON go there.
void log_to_standard_error() {
  fast::Log::ClearConsumers();
  fast::Log::RegisterConsumer(std::make_unique<fast::StdoutErrConsumer>());
}

}  // namespace

Participant::Participant(const ParticipantOptions& options) {
  if (options.domain > kMaxDomain) {
    throw std::invalid_argument{"DDS domain " + std::to_string(options.domain) + ": must be 0 to " + std::to_string(kMaxDomain)};
  }
  talk_over_the_wire();
  log_to_standard_error();
  fast::DomainParticipantFactory& factory = *fast::DomainParticipantFactory::get_instance();
  participant_ = factory.create_participant(options.domain, qos::participant(options));
  if (participant_ == nullptr) throw std::runtime_error{"cannot join DDS domain " + std::to_string(options.domain)};
  publisher_ = participant_->create_publisher(fast::PublisherQos{});
  subscriber_ = participant_->create_subscriber(fast::SubscriberQos{});
  if (publisher_ == nullptr || subscriber_ == nullptr) {
    participant_->delete_contained_entities();
    factory.delete_participant(participant_);
    throw std::runtime_error{"cannot create a DDS publisher or subscriber"};
  }
}

Participant::~Participant() {
  participant_->delete_contained_entities();
  fast::DomainParticipantFactory::get_instance()->delete_participant(participant_);
}

fast::Topic& Participant::topic(const std::string& name, std::unique_ptr<fast::TopicDataType> type) {
  if (const auto known = topics_.find(name); known != topics_.end()) return *known->second;
  const std::string type_name = type->getName();
  if (participant_->find_type(type_name).empty()) {
    participant_->register_type(fast::TypeSupport{type.release()});
  }
  fast::Topic* made = participant_->create_topic(name, type_name, fast::TopicQos{});
  if (made == nullptr) throw std::runtime_error{"cannot create DDS topic " + name + " of type " + type_name};
  topics_.emplace(name, made);
  return *made;
}

}  // namespace interlace::dds
