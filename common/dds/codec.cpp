#include "common/dds/codec.hpp"

#include <algorithm>

#include "common/dds/convert.hpp"
#include "common/dds/wire_types.hpp"

namespace interlace::dds {

using eprosima::fastrtps::rtps::SerializedPayload_t;

template <typename Message>
std::vector<std::uint8_t> encode(const Message& message) {
  WireOf<Message> wire = to_wire(message);
  static const auto type = make_type<WireOf<Message>>();
  SerializedPayload_t payload{type->getSerializedSizeProvider(&wire)()};
  std::fill_n(payload.data, payload.max_size, std::uint8_t{0});  // the gaps between members are not written
  if (!type->serialize(&wire, &payload)) return {};              // it measured the room itself
  return {payload.data, payload.data + payload.length};
}

template <typename Message>
model::Result<Message, std::string> decode(const std::vector<std::uint8_t>& bytes, const std::string& owner) {
  WireOf<Message> wire;
  static const auto type = make_type<WireOf<Message>>();
  SerializedPayload_t payload{static_cast<std::uint32_t>(bytes.size())};
  payload.length = static_cast<std::uint32_t>(bytes.size());
  std::copy(bytes.begin(), bytes.end(), payload.data);
  (void)type->deserialize(&payload, &wire);  // what cannot be read is of version 0
  return from_wire(wire, owner);
}

template <>
const char* type_name<CommandMessage>() {
  return "Command";
}
template <>
const char* type_name<StatusMessage>() {
  return "CommandStatus";
}
template <>
const char* type_name<DispatchMessage>() {
  return "Dispatch";
}
template <>
const char* type_name<ExecutionMessage>() {
  return "Execution";
}
template <>
const char* type_name<PostureMessage>() {
  return "Posture";
}
template <>
const char* type_name<model::PlannerState>() {
  return "PlannerState";
}
template <>
const char* type_name<model::PlannerJournal>() {
  return "PlannerJournal";
}

template std::vector<std::uint8_t> encode(const CommandMessage&);
template std::vector<std::uint8_t> encode(const StatusMessage&);
template std::vector<std::uint8_t> encode(const DispatchMessage&);
template std::vector<std::uint8_t> encode(const ExecutionMessage&);
template std::vector<std::uint8_t> encode(const PostureMessage&);
template std::vector<std::uint8_t> encode(const model::PlannerState&);
template std::vector<std::uint8_t> encode(const model::PlannerJournal&);
template model::Result<CommandMessage, std::string> decode(const std::vector<std::uint8_t>&, const std::string&);
template model::Result<StatusMessage, std::string> decode(const std::vector<std::uint8_t>&, const std::string&);
template model::Result<DispatchMessage, std::string> decode(const std::vector<std::uint8_t>&, const std::string&);
template model::Result<ExecutionMessage, std::string> decode(const std::vector<std::uint8_t>&, const std::string&);
template model::Result<PostureMessage, std::string> decode(const std::vector<std::uint8_t>&, const std::string&);
template model::Result<model::PlannerState, std::string> decode(const std::vector<std::uint8_t>&, const std::string&);
template model::Result<model::PlannerJournal, std::string> decode(const std::vector<std::uint8_t>&, const std::string&);

}  // namespace interlace::dds
