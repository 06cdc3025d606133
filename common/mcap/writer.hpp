#pragma once

#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "common/mcap/spill.hpp"
#include "common/mcap/types.hpp"

namespace interlace::mcap {

/// Writes an MCAP file: chunks without compression, each with the indexes that let a reader seek, and a summary at the end. What is in
/// chunks that were flushed can be read even when nothing more is ever written. Memory does not grow with the file. Not thread-safe.
class Writer {
 public:
  /// `out` must outlive it and stand at its begin. `library` names the program that writes.
  Writer(std::ostream& out, const std::string& library);
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  /// The id of the new schema, of the new channel.
  std::uint16_t add_schema(const std::string& name, const std::string& encoding, const std::string& text);
  std::uint16_t add_channel(std::uint16_t schema, const std::string& topic, const std::string& encoding);

  void add(const Attachment& attachment);
  void add(const Metadata& metadata);

  /// Adds a message to a channel; its number within the channel is counted here. Log times need not be in order.
  void write(std::uint16_t channel, std::uint64_t log_time, std::uint64_t publish_time, const Bytes& data);

  /// Ends the chunk, so that all written so far can be read. A chunk that has grown large is ended without being asked.
  void flush();

  /// Ends the file properly: the last chunk, the summary, the footer. Nothing may be written after it.
  void close();

  /// False once the stream has failed: the disk is full, or gone.
  [[nodiscard]] bool ok() const;
  [[nodiscard]] std::uint64_t messages() const { return messages_; }
  /// Of the file so far [bytes], without the chunk that is being filled.
  [[nodiscard]] std::uint64_t size() const { return offset_; }

 private:
  struct IndexEntry {
    std::uint64_t time, offset;
  };
  struct Placed {  // an attachment or metadata, by the record that will index it
    std::uint8_t opcode;
    Bytes index;
  };

  void put(const Bytes& bytes);
  std::uint64_t record(std::uint8_t opcode, const Bytes& content);
  void into_chunk(std::uint8_t opcode, const Bytes& content);
  void note_time(std::uint64_t t);
  [[nodiscard]] Bytes statistics() const;

  std::ostream& out_;
  std::uint64_t offset_ = 0;
  Bytes chunk_;
  std::map<std::uint16_t, std::vector<IndexEntry>> chunk_messages_;
  std::uint64_t chunk_begin_ = 0, chunk_end_ = 0;
  std::vector<Bytes> schemas_, channels_;  // their records' contents
  std::map<std::uint16_t, std::uint64_t> counts_;
  Spill chunk_indexes_;  // their records
  std::vector<Placed> placed_;
  std::uint64_t messages_ = 0, begin_ = 0, end_ = 0;
  std::uint32_t attachments_ = 0, metadata_ = 0, chunks_ = 0;
};

}  // namespace interlace::mcap
