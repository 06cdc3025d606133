#pragma once

#include <cstring>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/topic/Topic.hpp>
#include <fastdds/dds/topic/TopicDataType.hpp>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "common/dds/participant.hpp"
#include "common/dds/qos.hpp"
#include "common/dds/wire_types.hpp"

namespace interlace::test {

/// Sends samples of an IDL type without any check, as a foreign program might.
template <typename Wire>
class RawWriter {
 public:
  RawWriter(dds::Participant& participant, const std::string& topic, dds::qos::Stream stream)
      : writer_(participant.publisher().create_datawriter(&participant.topic(topic, dds::make_type<Wire>()), dds::qos::writer(stream))) {
    if (writer_ == nullptr) throw std::runtime_error{"no raw writer of " + topic};
  }

  [[nodiscard]] bool write(Wire sample) { return writer_->write(&sample); }

 private:
  eprosima::fastdds::dds::DataWriter* writer_;  // goes with its participant
};

using Bytes = std::vector<unsigned char>;

/// A type whose samples are serialised already: for what no IDL compiler would produce.
class BytesType : public eprosima::fastdds::dds::TopicDataType {
 public:
  BytesType(const std::string& type_name, bool keyed) {
    setName(type_name.c_str());
    m_typeSize = 65000;
    m_isGetKeyDefined = keyed;
  }
  bool serialize(void* data, eprosima::fastrtps::rtps::SerializedPayload_t* payload) override {
    const Bytes& bytes = *static_cast<Bytes*>(data);
    std::memcpy(payload->data, bytes.data(), bytes.size());
    payload->length = static_cast<std::uint32_t>(bytes.size());
    return true;
  }
  bool deserialize(eprosima::fastrtps::rtps::SerializedPayload_t* /*payload*/, void* /*data*/) override { return false; }
  std::function<std::uint32_t()> getSerializedSizeProvider(void* data) override {
    return [data] { return static_cast<std::uint32_t>(static_cast<Bytes*>(data)->size()); };
  }
  void* createData() override { return new Bytes; }
  void deleteData(void* data) override { delete static_cast<Bytes*>(data); }
  bool getKey(void* /*data*/, eprosima::fastrtps::rtps::InstanceHandle_t* handle, bool /*force_md5*/) override {
    handle->value[0] = 1;
    return m_isGetKeyDefined;
  }
};

/// Sends bytes as if they were a sample of the type called `type_name`.
class BytesWriter {
 public:
  BytesWriter(dds::Participant& participant, const std::string& topic, const std::string& type_name, dds::qos::Stream stream, bool keyed)
      : writer_(participant.publisher().create_datawriter(&participant.topic(topic, std::make_unique<BytesType>(type_name, keyed)),
                                                          dds::qos::writer(stream))) {
    if (writer_ == nullptr) throw std::runtime_error{"no raw writer of " + topic};
  }

  [[nodiscard]] bool write(Bytes bytes) { return writer_->write(&bytes); }

 private:
  eprosima::fastdds::dds::DataWriter* writer_;
};

/// `sample` as it would travel, encapsulation included.
template <typename Wire>
Bytes serialised(Wire sample) {
  const auto type = dds::make_type<Wire>();
  eprosima::fastrtps::rtps::SerializedPayload_t payload{type->getSerializedSizeProvider(&sample)()};
  if (!type->serialize(&sample, &payload)) throw std::runtime_error{"cannot serialise"};
  return Bytes(payload.data, payload.data + payload.length);
}

}  // namespace interlace::test
