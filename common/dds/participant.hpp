#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace eprosima::fastdds::dds {
class DomainParticipant;
class Publisher;
class Subscriber;
class Topic;
class TopicDataType;
}  // namespace eprosima::fastdds::dds

namespace interlace::dds {

inline constexpr std::uint32_t kMaxDomain = 232;  ///< a higher one has no UDP ports left (RTPS 9.6.1)

struct ParticipantOptions {
  std::uint32_t domain = 0;    ///< 0 … 232
  std::string name;            ///< what other tools call this process
  bool shared_memory = false;  ///< adds the shared memory transport; off because a restarted peer can stay deaf on it
};

/// This process on its DDS domain. One per process (the monitor has another one on the domain of ROS 2); readers and writers are made from
/// it, in the thread that made it, and destroyed before it. No XML profile of Fast DDS changes it, so that every process runs with the same
/// settings; what Fast DDS itself has to say goes to standard error.
class Participant {
 public:
  /// Throws std::invalid_argument for a domain above kMaxDomain, std::runtime_error when Fast DDS cannot join (no ports, no network).
  explicit Participant(const ParticipantOptions& options);
  ~Participant();
  Participant(const Participant&) = delete;
  Participant& operator=(const Participant&) = delete;

  // For Reader and Writer.
  [[nodiscard]] eprosima::fastdds::dds::Publisher& publisher() { return *publisher_; }
  [[nodiscard]] eprosima::fastdds::dds::Subscriber& subscriber() { return *subscriber_; }
  /// The topic called `name` of that type, made when first asked for. Takes `type` over. Throws std::runtime_error.
  [[nodiscard]] eprosima::fastdds::dds::Topic& topic(const std::string& name, std::unique_ptr<eprosima::fastdds::dds::TopicDataType> type);

 private:
  eprosima::fastdds::dds::DomainParticipant* participant_ = nullptr;
  eprosima::fastdds::dds::Publisher* publisher_ = nullptr;
  eprosima::fastdds::dds::Subscriber* subscriber_ = nullptr;
  std::map<std::string, eprosima::fastdds::dds::Topic*> topics_;
};

}  // namespace interlace::dds
