#pragma once

#include <cstdint>
#include <string>

#include "common/dds/participant.hpp"
#include "common/ros2/messages.hpp"

namespace eprosima::fastdds::dds {
class DataWriter;
}  // namespace eprosima::fastdds::dds

namespace interlace::dds {

/// A topic of ROS 2.
struct Ros2Topic {
  std::string name;      ///< as ROS 2 has it: "/exp_6_2/joint_states"
  bool latched = false;  ///< the last message counts for who comes later, too (transient local)
  int depth = 10;        ///< messages kept for a reader that is behind
};

/// Sends messages that ROS 2 nodes understand, without being one: ROS 2's names of topic and type, its serialisation, reliable, with the
/// type's hash in the user data. Not thread-safe: one thread creates it, writes and destroys it, before the Participant.
template <typename Message>
class Ros2Writer {
 public:
  /// Throws std::runtime_error when Fast DDS refuses the topic.
  Ros2Writer(Participant& participant, const Ros2Topic& topic);
  ~Ros2Writer();
  Ros2Writer(const Ros2Writer&) = delete;
  Ros2Writer& operator=(const Ros2Writer&) = delete;

  /// False when DDS did not take it. Readers that are behind lose the oldest; they never block this for more than 100 ms.
  bool write(const Message& message);
  /// Readers that are matched now.
  [[nodiscard]] std::int32_t matched() const;

 private:
  Participant& participant_;
  eprosima::fastdds::dds::DataWriter* writer_ = nullptr;
};

extern template class Ros2Writer<ros2::String>;
extern template class Ros2Writer<ros2::JointState>;
extern template class Ros2Writer<ros2::TFMessage>;
extern template class Ros2Writer<ros2::MarkerArray>;
extern template class Ros2Writer<ros2::DiagnosticArray>;

}  // namespace interlace::dds
