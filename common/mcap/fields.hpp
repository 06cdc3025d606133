#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "common/mcap/types.hpp"

/// The fields of MCAP records: little-endian numbers, texts and tables with their length before them. Internal to common/mcap.
namespace interlace::mcap {

/// Appends fields to bytes.
class FieldWriter {
 public:
  template <typename Unsigned>
  FieldWriter& number(Unsigned value) {
    for (std::size_t i = 0; i < sizeof value; ++i) bytes_.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
    return *this;
  }
  FieldWriter& raw(const Bytes& bytes) {
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
    return *this;
  }
  FieldWriter& raw(std::string_view text) {
    bytes_.insert(bytes_.end(), text.begin(), text.end());
    return *this;
  }
  FieldWriter& text(std::string_view text) { return number(static_cast<std::uint32_t>(text.size())).raw(text); }
  FieldWriter& table(const Text& values) {
    FieldWriter content;
    for (const auto& [key, value] : values) content.text(key).text(value);
    return number(static_cast<std::uint32_t>(content.bytes_.size())).raw(content.bytes_);
  }

  [[nodiscard]] const Bytes& bytes() const { return bytes_; }

 private:
  Bytes bytes_;
};

/// Reads fields from bytes. What is not there reads as nothing and makes ok() false, so that a record is read straight through.
class FieldReader {
 public:
  FieldReader(const std::uint8_t* data, std::size_t size) : at_(data), left_(size) {}

  template <typename Unsigned>
  Unsigned number() {
    Unsigned value = 0;
    if (!take(sizeof value)) return value;
    for (std::size_t i = 0; i < sizeof value; ++i) value = static_cast<Unsigned>(value | (static_cast<Unsigned>(at_[i]) << (8 * i)));
    skip(sizeof value);
    return value;
  }
  std::string bytes(std::uint64_t size) {
    if (!take(size)) return {};
    std::string text(at_, at_ + size);
    skip(static_cast<std::size_t>(size));
    return text;
  }
  std::string text() { return bytes(number<std::uint32_t>()); }
  Text table() {
    const std::string content = bytes(number<std::uint32_t>());
    FieldReader fields{reinterpret_cast<const std::uint8_t*>(content.data()), content.size()};
    Text values;
    while (fields.ok() && fields.left() > 0) {
      std::string key = fields.text();
      values[std::move(key)] = fields.text();
    }
    ok_ = ok_ && fields.ok();
    return values;
  }
  Bytes rest() {
    Bytes all(at_, at_ + left_);
    skip(left_);
    return all;
  }

  [[nodiscard]] bool ok() const { return ok_; }
  [[nodiscard]] std::size_t left() const { return left_; }

 private:
  bool take(std::uint64_t size) { return ok_ = ok_ && size <= left_; }
  void skip(std::size_t size) {
    at_ += size;
    left_ -= size;
  }

  const std::uint8_t* at_;
  std::size_t left_;
  bool ok_ = true;
};

}  // namespace interlace::mcap
