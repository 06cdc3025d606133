#include "common/dds/validate.hpp"

#include <cmath>

#include "common/dds/limits.hpp"
#include "common/model/ids.hpp"

namespace interlace::dds {
namespace {

std::string quoted(std::string_view field, const std::string& text, const char* rule) {
  // The value may be anything and ends up in a log line.
  return std::string{field} + ": '" + tidy(text, 80) + "' " + rule;
}

std::string numeric(std::string_view field, double value, const std::string& rule) {
  return std::string{field} + ": " + std::to_string(value) + " " + rule;
}

/// Length of the well-formed UTF-8 character at `at` [bytes], 0 when there is none. Source: Unicode 15, table 3-7.
std::size_t character_length(std::string_view text, std::size_t at) {
  const auto byte = [&](std::size_t i) -> unsigned { return at + i < text.size() ? static_cast<unsigned char>(text[at + i]) : 0u; };
  const auto continues = [&](std::size_t i, unsigned low = 0x80, unsigned high = 0xBF) { return byte(i) >= low && byte(i) <= high; };
  const unsigned first = byte(0);
  if (first < 0x80) return 1;
  if (first >= 0xC2 && first <= 0xDF) return continues(1) ? 2 : 0;
  if (first >= 0xE0 && first <= 0xEF) {
    const unsigned low = first == 0xE0 ? 0xA0 : 0x80;
    const unsigned high = first == 0xED ? 0x9F : 0xBF;
    return continues(1, low, high) && continues(2) ? 3 : 0;
  }
  if (first >= 0xF0 && first <= 0xF4) {
    const unsigned low = first == 0xF0 ? 0x90 : 0x80;
    const unsigned high = first == 0xF4 ? 0x8F : 0xBF;
    return continues(1, low, high) && continues(2) && continues(3) ? 4 : 0;
  }
  return 0;
}

bool is_control(char c) {
  return static_cast<unsigned char>(c) < 0x20 || c == 0x7F;
}

bool is_plain_text(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = character_length(text, i);
    if (length == 0 || is_control(text[i])) return false;
    i += length;
  }
  return true;
}

}  // namespace

double Validator::number(std::string_view field, double value, double limit) {
  const bool fine = std::isfinite(value) && std::abs(value) <= limit;
  require(fine, [&] { return numeric(field, value, "is not a finite number within ±" + std::to_string(limit)); });
  return fine ? value : 0;
}

double Validator::non_negative(std::string_view field, double value, double limit) {
  const bool fine = std::isfinite(value) && value >= 0 && value <= limit;
  require(fine, [&] { return numeric(field, value, "is not a finite number from 0 to " + std::to_string(limit)); });
  return fine ? value : 0;
}

std::string Validator::name(std::string_view field, std::string text) {
  require(model::is_valid_name(text),
          [&] { return quoted(field, text, "is not a name of 1 to 64 letters, digits, '_', '-', '.' or ':'"); });
  return text;
}

std::string Validator::name_or_empty(std::string_view field, std::string text) {
  return text.empty() ? text : name(field, std::move(text));
}

std::string Validator::text(std::string_view field, std::string text, std::size_t limit) {
  require(text.size() <= limit, [&] { return quoted(field, text, "is too long"); });
  require(is_plain_text(text), [&] { return quoted(field, text, "holds control characters or is not UTF-8"); });
  return text;
}

model::Instant Validator::stamp(std::string_view field, std::int64_t ns) {
  const bool fine = ns >= -kMaxStamp && ns <= kMaxStamp;
  require(fine, [&] { return std::string{field} + ": " + std::to_string(ns) + " ns is out of range"; });
  return fine ? model::Instant{model::Duration{ns}} : model::Instant{};
}

model::Instant Validator::bound(std::string_view field, std::int64_t ns) {
  const model::Instant instant{model::Duration{ns}};
  return instant == model::kForever || instant == model::kEarliest ? instant : stamp(field, ns);
}

model::Quaternion Validator::unit_quaternion(std::string_view field, double w, double x, double y, double z) {
  const double norm = std::sqrt(w * w + x * x + y * y + z * z);
  const bool fine = std::isfinite(norm) && std::abs(norm - 1) <= kUnitTolerance;
  require(fine, [&] { return numeric(field, norm, "is the norm, a unit quaternion has 1 within " + std::to_string(kUnitTolerance)); });
  return fine ? model::Quaternion{w / norm, x / norm, y / norm, z / norm} : model::Quaternion::Identity();
}

std::string tidy(std::string_view text, std::size_t limit) {
  std::string tidied;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = character_length(text, i);
    const bool keep = length > 0 && !is_control(text[i]);
    const std::string_view piece = keep ? text.substr(i, length) : std::string_view{"?"};
    if (tidied.size() + piece.size() > limit) break;
    tidied += piece;
    i += length > 0 ? length : 1;
  }
  return tidied;
}

}  // namespace interlace::dds
