#pragma once

#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/mcap/types.hpp"
#include "common/model/result.hpp"

namespace interlace::mcap {

/// Reads an MCAP file from its begin to its end, whatever is left of it: of a file whose writer was killed all that is whole. Chunks must
/// be uncompressed. No bytes make it do more than refuse them, and it never holds more than one record. Not thread-safe.
class Reader {
 public:
  /// `in` must outlive it.
  explicit Reader(std::istream& in) : in_(in) {}
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  /// The next message, in the order they were written; empty at the end. An error names the place in the file and the rule, and ends the
  /// reading: the same comes again.
  [[nodiscard]] model::Result<std::optional<Message>, std::string> next();

  // All there was so far. The channel of a message is always known, and so is its schema.
  [[nodiscard]] const std::map<std::uint16_t, Schema>& schemas() const { return schemas_; }
  [[nodiscard]] const std::map<std::uint16_t, Channel>& channels() const { return channels_; }
  [[nodiscard]] const std::vector<Attachment>& attachments() const { return attachments_; }
  [[nodiscard]] const std::vector<Metadata>& metadata() const { return metadata_; }

  /// At the end: the file was not ended properly, there may have been more.
  [[nodiscard]] bool cut_off() const { return cut_off_; }
  /// How much of the file was whole [bytes].
  [[nodiscard]] std::uint64_t whole() const { return read_; }

 private:
  struct Record {
    std::uint8_t opcode = 0;
    Bytes content;
  };
  void read_magic();
  [[nodiscard]] std::optional<Record> read_record();
  [[nodiscard]] std::optional<Record> next_in_chunk();
  [[nodiscard]] std::optional<Message> take(const Record& record, bool in_chunk);
  void open_chunk(const Bytes& content);
  void refuse(const std::string& rule);

  std::istream& in_;
  std::uint64_t offset_ = 0;  // of the record that is being read
  std::uint64_t read_ = 0;
  bool begun_ = false, ended_ = false, cut_off_ = false;
  std::optional<std::string> error_;
  Bytes chunk_;
  std::size_t chunk_at_ = 0;
  std::map<std::uint16_t, Schema> schemas_;
  std::map<std::uint16_t, Channel> channels_;
  std::vector<Attachment> attachments_;
  std::vector<Metadata> metadata_;
};

}  // namespace interlace::mcap
