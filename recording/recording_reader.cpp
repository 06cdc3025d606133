#include "recording/recording_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "common/dds/codec.hpp"
#include "recording/recording_writer.hpp"

namespace interlace::recording {
namespace {

/// Whom messages on `topic` are about: the robot of `<cell>/<robot>/<kind>`, the cell of `<cell>/<kind>`.
std::string owner_of(const std::string& topic) {
  const auto first = topic.find('/');
  const auto second = first == std::string::npos ? first : topic.find('/', first + 1);
  return second == std::string::npos ? topic.substr(0, first) : topic.substr(first + 1, second - first - 1);
}

template <typename Message>
model::Result<std::optional<RecordedMessage>, std::string> decode_as(const mcap::Bytes& data, const std::string& owner) {
  auto decoded = dds::decode<Message>(data, owner);
  if (!decoded) return model::unexpected{decoded.error()};
  return RecordedMessage{std::move(*decoded)};
}

using Decoder = model::Result<std::optional<RecordedMessage>, std::string> (*)(const mcap::Bytes&, const std::string&);

template <typename Message>
std::pair<const std::string, Decoder> decoder() {
  return {std::string{kSchemaPrefix} + dds::type_name<Message>(), &decode_as<Message>};
}

const std::map<std::string, Decoder>& decoders() {
  static const std::map<std::string, Decoder> all{
      decoder<dds::CommandMessage>(), decoder<dds::StatusMessage>(),  decoder<dds::DispatchMessage>(), decoder<dds::ExecutionMessage>(),
      decoder<dds::PostureMessage>(), decoder<model::PlannerState>(), decoder<model::PlannerJournal>()};
  return all;
}

}  // namespace

model::Result<std::unique_ptr<RecordingReader>, std::string> RecordingReader::open(const std::string& path) {
  errno = 0;
  std::ifstream file{path, std::ios::binary};
  if (!file) return model::unexpected{fmt::format("{}: cannot be read: {}", path, std::strerror(errno))};
  return std::unique_ptr<RecordingReader>{new RecordingReader{path, std::move(file)}};
}

model::Result<std::optional<RecordedMessage>, std::string> RecordingReader::decode(const mcap::Message& m) const {
  const mcap::Channel& channel = reader_.channels().at(m.channel);
  if (channel.schema == 0 || channel.encoding != kMessageEncoding) return std::optional<RecordedMessage>{};
  const std::string& schema = reader_.schemas().at(channel.schema).name;
  const auto found = decoders().find(schema);
  if (found == decoders().end() || (!journal_ && schema == decoder<model::PlannerJournal>().first)) return std::optional<RecordedMessage>{};
  return found->second(m.data, owner_of(channel.topic));
}

model::Result<std::optional<RecordedSample>, std::string> RecordingReader::next() {
  for (;;) {
    auto message = reader_.next();
    if (!message) return model::unexpected{path_ + ": " + message.error()};
    if (!*message) return std::optional<RecordedSample>{};
    const std::string& topic = reader_.channels().at((*message)->channel).topic;
    auto decoded = decode(**message);
    if (!decoded) {
      return model::unexpected{fmt::format("{}: message {} of {}: {}", path_, (*message)->sequence, topic, decoded.error())};
    }
    if (*decoded) return RecordedSample{topic, (*message)->log_time, (*message)->publish_time, std::move(**decoded)};
  }
}

model::Result<Extent, std::string> RecordingReader::skim() {
  Extent extent;
  for (;;) {
    const auto message = reader_.next();
    if (!message) return model::unexpected{path_ + ": " + message.error()};
    if (!*message) return extent;
    const std::uint64_t t = (*message)->log_time;
    extent.from = extent.messages == 0 ? t : std::min(extent.from, t);
    extent.until = std::max(extent.until, t);
    ++extent.messages;
  }
}

std::optional<std::string> RecordingReader::cell_file() const {
  for (const mcap::Attachment& a : reader_.attachments()) {
    if (a.name == kCellFile) return a.data;
  }
  return std::nullopt;
}

std::string RecordingReader::value(const std::string& key) const {
  for (const mcap::Metadata& m : reader_.metadata()) {
    if (m.name != kMetadata) continue;
    if (const auto found = m.values.find(key); found != m.values.end()) return found->second;
  }
  return {};
}

}  // namespace interlace::recording
