#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

/// What a ROS 2 message type is made of, and the hash by which nodes tell whether they mean the same by its name (REP-2011, REP-2016).
namespace interlace::ros2 {

/// How REP-2016 numbers the types of members.
enum class FieldKind : std::uint8_t {
  nested = 1,
  uint8 = 3,
  int32 = 6,
  uint32 = 7,
  float32 = 10,
  float64 = 11,
  boolean = 15,
  byte = 16,
  string = 17
};
inline constexpr int kUnboundedSequence = 144;  ///< is added for a sequence of that kind

struct Field {
  std::string name;
  FieldKind kind = FieldKind::nested;
  bool sequence = false;
  std::string nested;  ///< name of the type, when `kind` is nested

  friend bool operator==(const Field& x, const Field& y) {
    return x.name == y.name && x.kind == y.kind && x.sequence == y.sequence && x.nested == y.nested;
  }
};

/// A type and all that its members need, each by its ROS 2 name, such as std_msgs/msg/Header.
struct TypeDescription {
  std::string name;
  std::vector<Field> fields;
  std::map<std::string, std::vector<Field>> referenced;
};

/// The text that is hashed: JSON in the form REP-2016 prescribes.
[[nodiscard]] std::string canonical_json(const TypeDescription& type);

/// "RIHS01_" and 64 hexadecimal digits.
[[nodiscard]] std::string type_hash(const TypeDescription& type);

namespace detail {

template <typename T>
struct KindOf {
  static constexpr FieldKind kind = FieldKind::nested;
};
template <>
struct KindOf<std::uint8_t> {
  static constexpr FieldKind kind = FieldKind::uint8;
};
template <>
struct KindOf<std::int32_t> {
  static constexpr FieldKind kind = FieldKind::int32;
};
template <>
struct KindOf<std::uint32_t> {
  static constexpr FieldKind kind = FieldKind::uint32;
};
template <>
struct KindOf<float> {
  static constexpr FieldKind kind = FieldKind::float32;
};
template <>
struct KindOf<double> {
  static constexpr FieldKind kind = FieldKind::float64;
};
template <>
struct KindOf<bool> {
  static constexpr FieldKind kind = FieldKind::boolean;
};
template <>
struct KindOf<std::byte> {
  static constexpr FieldKind kind = FieldKind::byte;
};
template <>
struct KindOf<std::string> {
  static constexpr FieldKind kind = FieldKind::string;
};

template <typename T>
struct Element {
  using Type = T;
  static constexpr bool sequence = false;
};
template <typename T>
struct Element<std::vector<T>> {
  using Type = T;
  static constexpr bool sequence = true;
};

template <typename Message>
std::vector<Field> fields_of(std::map<std::string, std::vector<Field>>& referenced) {
  std::vector<Field> fields;
  const Message message;
  Message::members(message, [&](const char* name, const auto& member) {
    using Member = std::decay_t<decltype(member)>;
    using Type = typename Element<Member>::Type;
    Field field{name, KindOf<Type>::kind, Element<Member>::sequence, ""};
    if constexpr (KindOf<Type>::kind == FieldKind::nested) {
      field.nested = Type::kType;
      if (referenced.count(Type::kType) == 0) {
        auto nested = fields_of<Type>(referenced);
        referenced.emplace(Type::kType, std::move(nested));
      }
    }
    fields.push_back(std::move(field));
  });
  return fields;
}

}  // namespace detail

/// Of a message of common/ros2/messages.hpp.
template <typename Message>
[[nodiscard]] TypeDescription describe() {
  TypeDescription type;
  type.name = Message::kType;
  type.fields = detail::fields_of<Message>(type.referenced);
  return type;
}

}  // namespace interlace::ros2
