#include "common/mcap/reader.hpp"

#include <algorithm>
#include <array>
#include <istream>

#include "common/mcap/checksum.hpp"
#include "common/mcap/fields.hpp"
#include "common/mcap/format.hpp"

namespace interlace::mcap {
namespace {

constexpr std::uint64_t kLargestRecord = 1U << 28;  // [bytes]; far above what is written
constexpr std::size_t kStep = 1U << 16;             // room is made as bytes come, not as a length claims
constexpr std::size_t kMostThings = 10'000;         // attachments, tables

}  // namespace

void Reader::refuse(const std::string& rule) {
  if (!error_) error_ = "byte " + std::to_string(offset_) + ": " + rule;
}

void Reader::read_magic() {
  begun_ = true;
  std::array<char, kMagic.size()> found{};
  in_.read(found.data(), found.size());
  read_ = static_cast<std::uint64_t>(in_.gcount());
  if (read_ < found.size() || found != kMagic) refuse("not an MCAP file");
}

/// Empty when the file ends before the record does.
std::optional<Reader::Record> Reader::read_record() {
  offset_ = read_;
  std::array<std::uint8_t, 9> head{};
  in_.read(reinterpret_cast<char*>(head.data()), head.size());
  if (in_.gcount() < static_cast<std::streamsize>(head.size())) return std::nullopt;
  FieldReader fields{head.data(), head.size()};
  Record record;
  record.opcode = fields.number<std::uint8_t>();
  const auto length = fields.number<std::uint64_t>();
  if (length > kLargestRecord) {
    refuse("a record of " + std::to_string(length) + " bytes, at most " + std::to_string(kLargestRecord) + " are read");
    return std::nullopt;
  }
  while (record.content.size() < length) {
    const std::size_t had = record.content.size();
    const std::size_t step = std::min<std::size_t>(kStep, static_cast<std::size_t>(length) - had);
    record.content.resize(had + step);
    in_.read(reinterpret_cast<char*>(record.content.data() + had), static_cast<std::streamsize>(step));
    if (in_.gcount() < static_cast<std::streamsize>(step)) return std::nullopt;
  }
  read_ += head.size() + length;
  return record;
}

std::optional<Reader::Record> Reader::next_in_chunk() {
  FieldReader fields{chunk_.data() + chunk_at_, chunk_.size() - chunk_at_};
  Record record;
  record.opcode = fields.number<std::uint8_t>();
  const auto length = fields.number<std::uint64_t>();
  if (!fields.ok() || length > fields.left()) {
    refuse("a chunk ends in the middle of a record");
    return std::nullopt;
  }
  const auto begin = chunk_.begin() + static_cast<std::ptrdiff_t>(chunk_.size() - fields.left());
  record.content.assign(begin, begin + static_cast<std::ptrdiff_t>(length));
  chunk_at_ = chunk_.size() - fields.left() + static_cast<std::size_t>(length);
  return record;
}

void Reader::open_chunk(const Bytes& content) {
  FieldReader f{content.data(), content.size()};
  (void)f.number<std::uint64_t>();  // first and last time
  (void)f.number<std::uint64_t>();
  const auto size = f.number<std::uint64_t>();
  const auto crc = f.number<std::uint32_t>();
  const std::string compression = f.text();
  const auto stored = f.number<std::uint64_t>();
  if (!compression.empty()) return refuse("a chunk is compressed with \"" + compression.substr(0, 32) + "\", only plain ones are read");
  if (!f.ok() || stored != size || stored != f.left()) return refuse("a chunk's sizes do not agree");
  chunk_ = f.rest();
  chunk_at_ = 0;
  if (crc != kNoCrc && crc != checksum(chunk_)) refuse("a chunk's checksum does not agree: bytes of it were changed");
}

/// The message, when it is one; else remembers what the record says.
std::optional<Message> Reader::take(const Record& record, bool in_chunk) {
  FieldReader f{record.content.data(), record.content.size()};
  switch (static_cast<Opcode>(record.opcode)) {
    case Opcode::schema: {
      Schema s;
      s.id = f.number<std::uint16_t>();
      s.name = f.text();
      s.encoding = f.text();
      s.text = f.text();
      if (!f.ok() || s.id == 0) refuse("a schema is malformed");
      schemas_[s.id] = std::move(s);
      break;
    }
    case Opcode::channel: {
      Channel c;
      c.id = f.number<std::uint16_t>();
      c.schema = f.number<std::uint16_t>();
      c.topic = f.text();
      c.encoding = f.text();
      if (!f.ok() || (c.schema != 0 && schemas_.count(c.schema) == 0)) refuse("a channel is malformed or has an unknown schema");
      channels_[c.id] = std::move(c);
      break;
    }
    case Opcode::message: {
      Message m;
      m.channel = f.number<std::uint16_t>();
      m.sequence = f.number<std::uint32_t>();
      m.log_time = f.number<std::uint64_t>();
      m.publish_time = f.number<std::uint64_t>();
      if (!f.ok() || channels_.count(m.channel) == 0) {
        refuse("a message is malformed or of an unknown channel");
        break;
      }
      m.data = f.rest();
      return m;
    }
    case Opcode::chunk:
      if (in_chunk) {
        refuse("a chunk within a chunk");
      } else {
        open_chunk(record.content);
      }
      break;
    case Opcode::attachment: {
      Attachment a;
      a.log_time = f.number<std::uint64_t>();
      (void)f.number<std::uint64_t>();  // when it was made
      a.name = f.text();
      a.media_type = f.text();
      a.data = f.bytes(f.number<std::uint64_t>());
      const std::size_t summed = record.content.size() - f.left();
      if (const auto crc = f.number<std::uint32_t>(); f.ok() && crc != kNoCrc && crc != checksum(record.content.data(), summed))
        refuse("an attachment's checksum does not agree: bytes of it were changed");
      if (!f.ok() || attachments_.size() >= kMostThings) refuse("an attachment is malformed, or there are too many");
      attachments_.push_back(std::move(a));
      break;
    }
    case Opcode::metadata: {
      Metadata m;
      m.name = f.text();
      m.values = f.table();
      if (!f.ok() || metadata_.size() >= kMostThings) refuse("metadata are malformed, or there are too many");
      metadata_.push_back(std::move(m));
      break;
    }
    case Opcode::data_end: ended_ = true; break;  // what follows repeats what was read
    default: break;                               // indexes, statistics, and what later versions may add
  }
  return std::nullopt;
}

model::Result<std::optional<Message>, std::string> Reader::next() {
  if (!begun_) read_magic();
  while (!error_ && !ended_) {
    const bool in_chunk = chunk_at_ < chunk_.size();
    const std::optional<Record> record = in_chunk ? next_in_chunk() : read_record();
    if (!record) {
      if (!error_) ended_ = cut_off_ = true;
      break;
    }
    std::optional<Message> message = take(*record, in_chunk);
    if (message && !error_) return message;
  }
  if (error_) return model::unexpected<std::string>{*error_};
  return std::optional<Message>{};
}

}  // namespace interlace::mcap
