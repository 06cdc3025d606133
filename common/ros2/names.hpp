#pragma once

#include <string>
#include <string_view>

/// What ROS 2 calls things, and what it makes of those names on DDS.
namespace interlace::ros2 {

/// `name` as one part of a topic's name: letters, digits and '_', not beginning with a digit; everything else becomes '_'.
[[nodiscard]] std::string topic_part(std::string_view name);

/// "rt/exp_6_2/joint_states" of "/exp_6_2/joint_states".
[[nodiscard]] std::string dds_topic(std::string_view topic);

/// "sensor_msgs::msg::dds_::JointState_" of "sensor_msgs/msg/JointState".
[[nodiscard]] std::string dds_type(std::string_view type);

}  // namespace interlace::ros2
