#include "common/mcap/writer.hpp"

#include <algorithm>
#include <ostream>

#include "common/mcap/checksum.hpp"
#include "common/mcap/fields.hpp"
#include "common/mcap/format.hpp"

namespace interlace::mcap {
namespace {

constexpr std::size_t kLargeChunk = 1U << 18;  // [bytes]

std::uint8_t code(Opcode opcode) {
  return static_cast<std::uint8_t>(opcode);
}

/// What stands before the content of each record.
Bytes head_of(std::uint8_t opcode, std::size_t length) {
  return FieldWriter{}.number(opcode).number(std::uint64_t{length}).bytes();
}

}  // namespace

Writer::Writer(std::ostream& out, const std::string& library) : out_(out) {
  put(Bytes(kMagic.begin(), kMagic.end()));
  record(code(Opcode::header), FieldWriter{}.text("").text(library).bytes());
}

bool Writer::ok() const {
  return static_cast<bool>(out_);
}

void Writer::put(const Bytes& bytes) {
  out_.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  offset_ += bytes.size();
}

/// Where the record begins.
std::uint64_t Writer::record(std::uint8_t opcode, const Bytes& content) {
  const std::uint64_t begin = offset_;
  put(head_of(opcode, content.size()));
  put(content);
  return begin;
}

void Writer::into_chunk(std::uint8_t opcode, const Bytes& content) {
  const Bytes head = head_of(opcode, content.size());
  chunk_.insert(chunk_.end(), head.begin(), head.end());
  chunk_.insert(chunk_.end(), content.begin(), content.end());
}

std::uint16_t Writer::add_schema(const std::string& name, const std::string& encoding, const std::string& text) {
  const auto id = static_cast<std::uint16_t>(schemas_.size() + 1);
  schemas_.push_back(FieldWriter{}.number(id).text(name).text(encoding).text(text).bytes());
  into_chunk(code(Opcode::schema), schemas_.back());
  return id;
}

std::uint16_t Writer::add_channel(std::uint16_t schema, const std::string& topic, const std::string& encoding) {
  const auto id = static_cast<std::uint16_t>(channels_.size() + 1);
  channels_.push_back(FieldWriter{}.number(id).number(schema).text(topic).text(encoding).table({}).bytes());
  into_chunk(code(Opcode::channel), channels_.back());
  counts_[id] = 0;
  return id;
}

void Writer::add(const Attachment& a) {
  FieldWriter content;
  content.number(a.log_time).number(a.log_time).text(a.name).text(a.media_type);
  content.number(std::uint64_t{a.data.size()}).raw(a.data);
  content.number(checksum(content.bytes()));
  const std::uint64_t begin = record(code(Opcode::attachment), content.bytes());
  FieldWriter index;
  index.number(begin).number(offset_ - begin).number(a.log_time).number(a.log_time).number(std::uint64_t{a.data.size()});
  placed_.push_back({code(Opcode::attachment_index), index.text(a.name).text(a.media_type).bytes()});
  ++attachments_;
}

void Writer::add(const Metadata& m) {
  const std::uint64_t begin = record(code(Opcode::metadata), FieldWriter{}.text(m.name).table(m.values).bytes());
  placed_.push_back({code(Opcode::metadata_index), FieldWriter{}.number(begin).number(offset_ - begin).text(m.name).bytes()});
  ++metadata_;
}

void Writer::note_time(std::uint64_t t) {
  const bool first_of_chunk = chunk_messages_.empty();
  chunk_begin_ = first_of_chunk ? t : std::min(chunk_begin_, t);
  chunk_end_ = first_of_chunk ? t : std::max(chunk_end_, t);
  begin_ = messages_ == 0 ? t : std::min(begin_, t);
  end_ = std::max(end_, t);
}

void Writer::write(std::uint16_t channel, std::uint64_t log_time, std::uint64_t publish_time, const Bytes& data) {
  note_time(log_time);
  chunk_messages_[channel].push_back({log_time, chunk_.size()});
  const auto sequence = static_cast<std::uint32_t>(counts_[channel]++);
  into_chunk(code(Opcode::message), FieldWriter{}.number(channel).number(sequence).number(log_time).number(publish_time).raw(data).bytes());
  ++messages_;
  if (chunk_.size() >= kLargeChunk) flush();
}

void Writer::flush() {
  if (!chunk_.empty()) {
    const std::uint64_t begin = offset_;
    FieldWriter content;
    content.number(chunk_begin_).number(chunk_end_).number(std::uint64_t{chunk_.size()}).number(checksum(chunk_)).text("");
    record(code(Opcode::chunk), content.number(std::uint64_t{chunk_.size()}).raw(chunk_).bytes());
    const std::uint64_t length = offset_ - begin;
    const std::uint64_t indexes_begin = offset_;
    FieldWriter where;  // the index of each channel is
    for (auto& [channel, entries] : chunk_messages_) {
      // Readers take the entries as they stand, so they must be in order of time.
      std::stable_sort(entries.begin(), entries.end(), [](const IndexEntry& a, const IndexEntry& b) { return a.time < b.time; });
      FieldWriter list;
      for (const IndexEntry& e : entries) list.number(e.time).number(e.offset);
      FieldWriter all;
      all.number(channel).number(static_cast<std::uint32_t>(list.bytes().size())).raw(list.bytes());
      where.number(channel).number(record(code(Opcode::message_index), all.bytes()));
    }
    FieldWriter index;
    index.number(chunk_begin_).number(chunk_end_).number(begin).number(length);
    index.number(static_cast<std::uint32_t>(where.bytes().size())).raw(where.bytes()).number(offset_ - indexes_begin);
    index.text("").number(std::uint64_t{chunk_.size()}).number(std::uint64_t{chunk_.size()});
    chunk_indexes_.add(head_of(code(Opcode::chunk_index), index.bytes().size()));
    chunk_indexes_.add(index.bytes());
    ++chunks_;
    chunk_.clear();
    chunk_messages_.clear();
    chunk_begin_ = chunk_end_ = 0;
  }
  out_.flush();
}

Bytes Writer::statistics() const {
  FieldWriter s;
  s.number(messages_).number(static_cast<std::uint16_t>(schemas_.size())).number(static_cast<std::uint32_t>(channels_.size()));
  s.number(attachments_).number(metadata_).number(chunks_).number(begin_).number(end_);
  FieldWriter counts;
  for (const auto& [channel, count] : counts_) counts.number(channel).number(count);
  return s.number(static_cast<std::uint32_t>(counts.bytes().size())).raw(counts.bytes()).bytes();
}

void Writer::close() {
  flush();
  record(code(Opcode::data_end), FieldWriter{}.number(kNoCrc).bytes());
  const std::uint64_t summary = offset_;
  for (const Bytes& s : schemas_) record(code(Opcode::schema), s);
  for (const Bytes& c : channels_) record(code(Opcode::channel), c);
  record(code(Opcode::statistics), statistics());
  if (!chunk_indexes_.drain([&](const Bytes& piece) { put(piece); })) out_.setstate(std::ios::badbit);
  for (const Placed& p : placed_) record(p.opcode, p.index);
  record(code(Opcode::footer), FieldWriter{}.number(summary).number(std::uint64_t{0}).number(kNoCrc).bytes());
  put(Bytes(kMagic.begin(), kMagic.end()));
  out_.flush();
}

}  // namespace interlace::mcap
