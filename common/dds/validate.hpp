#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "common/model/pose.hpp"
#include "common/model/time.hpp"

namespace interlace::dds {

/// Reads the fields of one sample and remembers the first that breaks a rule. Each function returns the value, or something harmless when
/// the value is bad, so that a conversion reads straight through and asks ok() once, at its end.
class Validator {
 public:
  [[nodiscard]] bool ok() const { return !refusal_; }
  /// "field: the value and the rule it breaks"; empty when ok().
  [[nodiscard]] std::string refusal() const { return refusal_.value_or(""); }

  /// States the rule yourself; the text is only made when it does not hold.
  template <typename MakeText>
  void require(bool holds, MakeText&& text) {
    if (!holds && !refusal_) refusal_ = text();
  }

  /// Finite and within ±`limit`.
  double number(std::string_view field, double value, double limit);
  /// Finite, 0 to `limit`.
  double non_negative(std::string_view field, double value, double limit);
  /// A valid name (model::is_valid_name).
  std::string name(std::string_view field, std::string text);
  /// A valid name, or nothing.
  std::string name_or_empty(std::string_view field, std::string text);
  /// At most `limit` bytes of UTF-8 without control characters.
  std::string text(std::string_view field, std::string text, std::size_t limit);
  /// A stamp of an event: never one of the two sentinels.
  model::Instant stamp(std::string_view field, std::int64_t ns);
  /// A bound of an interval: a stamp, kEarliest or kForever.
  model::Instant bound(std::string_view field, std::int64_t ns);
  /// An enumerator 0 … `last`.
  template <typename Enum>
  Enum known(std::string_view field, std::uint32_t value, Enum last) {
    const bool fine = value <= static_cast<std::uint32_t>(last);
    require(fine, [&] { return std::string{field} + ": " + std::to_string(value) + " is not one of its enumerators"; });
    return fine ? static_cast<Enum>(value) : Enum{};
  }
  /// Norm within 1e-3 of 1; returned normalised.
  model::Quaternion unit_quaternion(std::string_view field, double w, double x, double y, double z);

 private:
  std::optional<std::string> refusal_;
};

/// `text` made acceptable to Validator::text: invalid bytes and control characters replaced, cut at a character's border.
[[nodiscard]] std::string tidy(std::string_view text, std::size_t limit);

}  // namespace interlace::dds
