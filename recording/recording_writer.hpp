#pragma once

#include <cstdint>
#include <fstream>
#include <map>
#include <memory>
#include <string>

#include "common/dds/codec.hpp"
#include "common/dds/topics.hpp"
#include "common/mcap/writer.hpp"
#include "common/model/result.hpp"

namespace interlace::recording {

/// Schema name, message encoding and schema encoding of every channel: docs/recording.md.
inline constexpr const char* kSchemaPrefix = "interlace/msg/";
inline constexpr const char* kMessageEncoding = "cdr";
inline constexpr const char* kSchemaEncoding = "ros2msg";
/// Name of the metadata, and of the attachment with the cell file.
inline constexpr const char* kMetadata = "interlace";
inline constexpr const char* kCellFile = "cell.yaml";

/// Writes the messages of a cell to an MCAP file. Not thread-safe.
class RecordingWriter {
 public:
  /// Makes the file at `path`. Refuses one that is there unless `overwrite`. The error is a sentence.
  [[nodiscard]] static model::Result<std::unique_ptr<RecordingWriter>, std::string> create(const std::string& path, bool overwrite);

  /// What the file says of itself: `values` are added to the version of this program and of the wire contract.
  void describe(mcap::Text values);
  /// The cell file's text.
  void attach_cell(const std::string& text, std::uint64_t log_time);

  /// A message as it was sent. Times in nanoseconds since 1970 (of virtual time: since its begin).
  template <typename Message>
  void write(const dds::Topic<Message>& topic, std::uint64_t log_time, std::uint64_t publish_time, const mcap::Bytes& cdr) {
    write(channel(topic.name, dds::type_name<Message>()), log_time, publish_time, cdr);
  }

  /// Makes all so far readable, whatever happens to this process. False: the disk is full or gone, see error().
  [[nodiscard]] bool flush();
  /// Ends the file. False as above.
  [[nodiscard]] bool close();

  [[nodiscard]] const std::string& error() const { return error_; }
  [[nodiscard]] std::uint64_t messages() const { return writer_.messages(); }
  [[nodiscard]] std::uint64_t size() const { return writer_.size(); }

 private:
  RecordingWriter(std::string path, std::ofstream file);
  void write(std::uint16_t channel, std::uint64_t log_time, std::uint64_t publish_time, const mcap::Bytes& cdr);
  [[nodiscard]] std::uint16_t channel(const std::string& topic, const std::string& type);
  bool check();

  std::string path_, error_;
  std::ofstream file_;
  mcap::Writer writer_;
  std::map<std::string, std::uint16_t> schemas_, channels_;
};

}  // namespace interlace::recording
