#pragma once

#include <fastdds/dds/domain/qos/DomainParticipantQos.hpp>
#include <fastdds/dds/publisher/qos/DataWriterQos.hpp>
#include <fastdds/dds/subscriber/qos/DataReaderQos.hpp>
#include <string>

#include "common/dds/participant.hpp"
#include "common/dds/ros2_writer.hpp"

/// Every quality of service of the project, and why. Internal to common/dds.
namespace interlace::dds::qos {

/// What a stream is for decides its QoS.
enum class Stream { command, command_status, dispatch, execution, posture, planner_state, planner_journal };

[[nodiscard]] eprosima::fastdds::dds::DomainParticipantQos participant(const ParticipantOptions& options);
[[nodiscard]] eprosima::fastdds::dds::DataWriterQos writer(Stream stream);
/// `depth`: samples it keeps until they are taken, per instance; 0: as many as its writers.
[[nodiscard]] eprosima::fastdds::dds::DataReaderQos reader(Stream stream, std::int32_t depth = 0);
/// As the nodes that listen to such a topic ask for by default.
[[nodiscard]] eprosima::fastdds::dds::DataWriterQos ros2_writer(const Ros2Topic& topic, const std::string& user_data);

}  // namespace interlace::dds::qos
