#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/dds/envelope.hpp"
#include "common/model/journal.hpp"
#include "common/model/result.hpp"

namespace interlace::dds {

/// The bytes a Writer sends for `message`: plain CDR with its four bytes of head. Instantiated for every message of envelope.hpp.
template <typename Message>
[[nodiscard]] std::vector<std::uint8_t> encode(const Message& message);

/// What a Reader of the topic of `owner` makes of these bytes: the message, or the rule they break. Survives any bytes.
template <typename Message>
[[nodiscard]] model::Result<Message, std::string> decode(const std::vector<std::uint8_t>& bytes, const std::string& owner);

/// Name of the type in the IDL, as "Posture".
template <typename Message>
[[nodiscard]] const char* type_name();

}  // namespace interlace::dds
