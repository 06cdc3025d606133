#include "recording/recording_writer.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "common/app/command_line.hpp"
#include "common/idl/ros2msg.hpp"

namespace interlace::recording {

model::Result<std::unique_ptr<RecordingWriter>, std::string> RecordingWriter::create(const std::string& path, bool overwrite) {
  std::error_code ignored;
  if (!overwrite && std::filesystem::exists(path, ignored))
    return model::unexpected{fmt::format("{}: is there already; --overwrite writes over it", path)};
  errno = 0;
  std::ofstream file{path, std::ios::binary | std::ios::trunc};
  if (!file) return model::unexpected{fmt::format("{}: cannot be written: {}", path, std::strerror(errno))};
  return std::unique_ptr<RecordingWriter>{new RecordingWriter{path, std::move(file)}};
}

RecordingWriter::RecordingWriter(std::string path, std::ofstream file)
    : path_(std::move(path)), file_(std::move(file)), writer_(file_, fmt::format("interlace {}", app::version())) {}

void RecordingWriter::describe(mcap::Text values) {
  values["interlace_version"] = app::version();
  errno = 0;
  writer_.add(mcap::Metadata{kMetadata, std::move(values)});
  (void)check();
}

void RecordingWriter::attach_cell(const std::string& text, std::uint64_t log_time) {
  errno = 0;
  writer_.add(mcap::Attachment{log_time, kCellFile, "application/yaml", text});
  (void)check();
}

std::uint16_t RecordingWriter::channel(const std::string& topic, const std::string& type) {
  if (const auto found = channels_.find(topic); found != channels_.end()) return found->second;
  auto schema = schemas_.find(type);
  if (schema == schemas_.end()) {
    const auto id = writer_.add_schema(kSchemaPrefix + type, kSchemaEncoding, idl::ros2msg(idl::contract(), type));
    schema = schemas_.emplace(type, id).first;
  }
  return channels_[topic] = writer_.add_channel(schema->second, topic, kMessageEncoding);
}

void RecordingWriter::write(std::uint16_t channel, std::uint64_t log_time, std::uint64_t publish_time, const mcap::Bytes& cdr) {
  errno = 0;
  writer_.write(channel, log_time, publish_time, cdr);
  (void)check();
}

/// The first failure is kept, with what the system said then.
bool RecordingWriter::check() {
  if (writer_.ok()) return true;
  if (error_.empty())
    error_ = fmt::format("{}: cannot be written any more: {}", path_, errno != 0 ? std::strerror(errno) : "the disk is full or gone");
  return false;
}

bool RecordingWriter::flush() {
  errno = 0;
  writer_.flush();
  return check();
}

bool RecordingWriter::close() {
  errno = 0;
  writer_.close();
  if (!check()) return false;
  file_.close();
  if (!file_) error_ = fmt::format("{}: cannot be written completely: {}", path_, std::strerror(errno));
  return error_.empty();
}

}  // namespace interlace::recording
