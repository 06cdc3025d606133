#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

/// What an MCAP file holds, as plain values.
namespace interlace::mcap {

using Bytes = std::vector<std::uint8_t>;
using Text = std::map<std::string, std::string>;

/// How the messages of some channels are laid out.
struct Schema {
  std::uint16_t id = 0;  ///< 0 means "none" in a channel, so a schema never has it
  std::string name;
  std::string encoding;  ///< of `text`
  std::string text;
};

/// One topic.
struct Channel {
  std::uint16_t id = 0;
  std::uint16_t schema = 0;
  std::string topic;
  std::string encoding;  ///< of its messages
};

struct Message {
  std::uint16_t channel = 0;
  std::uint32_t sequence = 0;      ///< counts a channel's messages
  std::uint64_t log_time = 0;      ///< when it was received [ns]
  std::uint64_t publish_time = 0;  ///< when it was sent [ns]
  Bytes data;
};

/// A file within the file.
struct Attachment {
  std::uint64_t log_time = 0;  ///< [ns]
  std::string name;
  std::string media_type;
  std::string data;
};

/// A table of names and values.
struct Metadata {
  std::string name;
  Text values;
};

}  // namespace interlace::mcap
