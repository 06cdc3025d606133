#include "common/dds/qos.hpp"

#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastdds/rtps/transport/shared_mem/SharedMemTransportDescriptor.h>
#include <cmath>
#include <memory>
#include <optional>

#include "common/dds/topics.hpp"

namespace interlace::dds::qos {

namespace fast = eprosima::fastdds::dds;
using eprosima::fastrtps::Duration_t;

namespace {

Duration_t to_dds(std::chrono::nanoseconds d) {
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(d);
  return Duration_t{static_cast<std::int32_t>(seconds.count()), static_cast<std::uint32_t>((d - seconds).count())};
}

/// Silence after which a periodic writer counts as late (deadline) and as gone (lease). Both, because neither is always noticed.
/// The deadline leaves room for scheduling hiccups: it is a sign of trouble, not a real-time guarantee.
struct Vigilance {
  std::chrono::milliseconds deadline;
  std::chrono::milliseconds lease;
};

/// One stream, seen from both ends. Writers and readers must agree, so they are made from the same row.
struct Profile {
  bool state;                          // the last value counts, also for who comes later; else a sequence of requests or answers
  std::int32_t depth;                  // samples kept, per instance
  std::optional<Vigilance> vigilance;  // periodic streams only
};

Profile profile(Stream stream) {
  using std::chrono::milliseconds;
  switch (stream) {
    // A client may send a whole program at once, and each command has several states.
    case Stream::command:
    case Stream::command_status: return {false, 256, std::nullopt};
    case Stream::dispatch:
      return {false, 64, Vigilance{5 * kHeartbeatPeriod, milliseconds{1000}}};  // never silent thanks to its heartbeats
    case Stream::execution: return {false, 64, std::nullopt};
    case Stream::posture: return {true, 1, Vigilance{milliseconds{500}, milliseconds{1000}}};
    case Stream::planner_state: return {true, 1, Vigilance{milliseconds{2500}, milliseconds{3000}}};
    // Whoever comes within some seconds of the planner's start still hears it from its first call on.
    case Stream::planner_journal: return {true, 256, std::nullopt};
  }
  return {false, 1, std::nullopt};
}

/// What a writer and a reader of one stream have in common. KEEP_ALL is never used: with it a deaf reader blocks its writer. Instances have
/// an explicit bound because the default drops the eleventh without a word.
template <typename EndpointQos>
void apply(const Profile& p, EndpointQos& q) {
  constexpr std::int32_t kInstances = 128;
  const std::int32_t instances = p.state ? kInstances : 1;
  q.reliability().kind = fast::RELIABLE_RELIABILITY_QOS;
  q.durability().kind = p.state ? fast::TRANSIENT_LOCAL_DURABILITY_QOS : fast::VOLATILE_DURABILITY_QOS;
  q.history().kind = fast::KEEP_LAST_HISTORY_QOS;
  q.history().depth = p.depth;
  q.resource_limits().max_instances = instances;
  q.resource_limits().max_samples_per_instance = p.depth;
  q.resource_limits().max_samples = instances * p.depth;
  q.resource_limits().allocated_samples = 0;
  // Samples are far smaller than the bounds of their types, so memory follows the samples.
  q.endpoint().history_memory_policy = eprosima::fastrtps::rtps::DYNAMIC_REUSABLE_MEMORY_MODE;
  q.data_sharing().off();  // shared memory again, see participant()
  if (p.vigilance) {
    q.deadline().period = to_dds(p.vigilance->deadline);
    // MANUAL_BY_TOPIC, asserted by each write: the other kinds notice a killed process only after some 20 s.
    q.liveliness().kind = fast::MANUAL_BY_TOPIC_LIVELINESS_QOS;
    q.liveliness().lease_duration = to_dds(p.vigilance->lease);
    q.liveliness().announcement_period = to_dds(p.vigilance->lease / 2);
  }
}

fast::DataWriterQos writer_of(const Profile& p) {
  fast::DataWriterQos q;
  apply(p, q);
  // A lost sample is asked for again at the next heartbeat of the reliable protocol; its default of 3 s is longer than a motion.
  q.reliable_writer_qos().times.heartbeatPeriod = to_dds(std::chrono::milliseconds{100});
  q.reliability().max_blocking_time = to_dds(std::chrono::milliseconds{100});
  return q;
}

}  // namespace

fast::DomainParticipantQos participant(const ParticipantOptions& options) {
  using eprosima::fastdds::rtps::SharedMemTransportDescriptor;
  using eprosima::fastdds::rtps::UDPv4TransportDescriptor;
  fast::DomainParticipantQos q;
  q.name(options.name);
  // UDP only: after kill -9 a restarted peer on shared memory is deaf for seconds, at times for good.
  q.transport().use_builtin_transports = false;
  q.transport().user_transports.push_back(std::make_shared<UDPv4TransportDescriptor>());
  if (options.shared_memory) q.transport().user_transports.push_back(std::make_shared<SharedMemTransportDescriptor>());
  // The same lease and announcement in every process: unequal ones fail to rejoin. The first announcements come quickly because every
  // start of a program waits for them; a lost process is forgotten after the lease (its silence is noticed much earlier, see profile()).
  auto& discovery = q.wire_protocol().builtin.discovery_config;
  discovery.leaseDuration = Duration_t{5, 0};
  discovery.leaseDuration_announcementperiod = Duration_t{1, 0};
  discovery.initial_announcements.count = 10;
  discovery.initial_announcements.period = to_dds(std::chrono::milliseconds{100});
  return q;
}

fast::DataWriterQos writer(Stream stream) {
  fast::DataWriterQos q = writer_of(profile(stream));
  // The journal may have gaps, the planner may not wait.
  if (stream == Stream::planner_journal) q.reliability().max_blocking_time = to_dds(std::chrono::milliseconds{1});
  return q;
}

fast::DataReaderQos reader(Stream stream, std::int32_t depth) {
  fast::DataReaderQos q;
  Profile p = profile(stream);
  if (depth > 0) p.depth = depth;
  apply(p, q);
  return q;
}

fast::DataWriterQos ros2_writer(const Ros2Topic& topic, const std::string& user_data) {
  fast::DataWriterQos q = writer_of({topic.latched, topic.depth, std::nullopt});
  q.user_data().setValue({user_data.begin(), user_data.end()});
  return q;
}

}  // namespace interlace::dds::qos
