#include "common/dds/ros2_writer.hpp"

#include <fastcdr/Cdr.h>
#include <fastcdr/FastBuffer.h>

#include <cstring>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/topic/Topic.hpp>
#include <fastdds/dds/topic/TopicDataType.hpp>
#include <memory>
#include <stdexcept>
#include <type_traits>
#include <vector>

#include "common/dds/qos.hpp"
#include "common/ros2/names.hpp"
#include "common/ros2/type_description.hpp"

namespace interlace::dds {

namespace fast = eprosima::fastdds::dds;

namespace {

using Bytes = std::vector<char>;

/// Writes members in their order, as plain CDR.
struct MemberWriter {
  eprosima::fastcdr::Cdr& cdr;

  template <typename T>
  void operator()(const char* /*name*/, const T& value) const {
    if constexpr (std::is_same_v<T, std::byte>) {
      cdr << std::to_integer<std::uint8_t>(value);
    } else if constexpr (std::is_arithmetic_v<T> || std::is_same_v<T, std::string>) {
      cdr << value;
    } else {
      T::members(value, *this);
    }
  }
  template <typename T>
  void operator()(const char* name, const std::vector<T>& values) const {
    cdr << static_cast<std::uint32_t>(values.size());
    for (const T& value : values) (*this)(name, value);
  }
};

template <typename Message>
Bytes serialised(const Message& message) {
  eprosima::fastcdr::FastBuffer buffer;
  eprosima::fastcdr::Cdr cdr{buffer, eprosima::fastcdr::Cdr::LITTLE_ENDIANNESS, eprosima::fastcdr::Cdr::DDS_CDR};
  cdr.serialize_encapsulation();
  Message::members(message, MemberWriter{cdr});
  return {buffer.getBuffer(), buffer.getBuffer() + cdr.getSerializedDataLength()};
}

/// A type of which samples come as bytes that are serialised already. For writers only.
class SerialisedType : public fast::TopicDataType {
 public:
  explicit SerialisedType(const std::string& name) {
    setName(name.c_str());
    m_typeSize = 256;  // to begin with: memory follows the samples
    auto_fill_type_object(false);
    auto_fill_type_information(false);
  }
  bool serialize(void* data, eprosima::fastrtps::rtps::SerializedPayload_t* payload) override {
    const Bytes& bytes = *static_cast<const Bytes*>(data);
    if (payload->max_size < bytes.size()) return false;
    std::memcpy(payload->data, bytes.data(), bytes.size());
    payload->length = static_cast<std::uint32_t>(bytes.size());
    payload->encapsulation = CDR_LE;
    return true;
  }
  bool deserialize(eprosima::fastrtps::rtps::SerializedPayload_t* /*payload*/, void* /*data*/) override { return false; }
  std::function<std::uint32_t()> getSerializedSizeProvider(void* data) override {
    return [data] { return static_cast<std::uint32_t>(static_cast<const Bytes*>(data)->size()); };
  }
  void* createData() override { return new Bytes; }
  void deleteData(void* data) override { delete static_cast<Bytes*>(data); }
  bool getKey(void* /*data*/, eprosima::fastrtps::rtps::InstanceHandle_t* /*handle*/, bool /*force_md5*/) override { return false; }
};

}  // namespace

template <typename Message>
Ros2Writer<Message>::Ros2Writer(Participant& participant, const Ros2Topic& topic) : participant_(participant) {
  const std::string name = ros2::dds_topic(topic.name);
  fast::Topic& made = participant.topic(name, std::make_unique<SerialisedType>(ros2::dds_type(Message::kType)));
  const std::string user_data = "typehash=" + ros2::type_hash(ros2::describe<Message>()) + ";";
  writer_ = participant.publisher().create_datawriter(&made, qos::ros2_writer(topic, user_data));
  if (writer_ == nullptr) throw std::runtime_error{"cannot create a DDS writer of " + name};
}

template <typename Message>
Ros2Writer<Message>::~Ros2Writer() {
  participant_.publisher().delete_datawriter(writer_);
}

template <typename Message>
bool Ros2Writer<Message>::write(const Message& message) {
  Bytes bytes = serialised(message);
  return writer_->write(&bytes);
}

template <typename Message>
std::int32_t Ros2Writer<Message>::matched() const {
  fast::PublicationMatchedStatus status;
  return writer_->get_publication_matched_status(status) == ReturnCode_t::RETCODE_OK ? status.current_count : 0;
}

template class Ros2Writer<ros2::String>;
template class Ros2Writer<ros2::JointState>;
template class Ros2Writer<ros2::TFMessage>;
template class Ros2Writer<ros2::MarkerArray>;
template class Ros2Writer<ros2::DiagnosticArray>;

}  // namespace interlace::dds
