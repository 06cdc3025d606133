#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <utility>

namespace interlace::model {

/// Longest id or robot name that travels on the wire [bytes].
inline constexpr std::size_t kMaxNameLength = 64;

/// True for 1 to 64 letters, digits, '_', '-', '.', ':'. Names become topic names, file names and table cells, so nothing else may enter.
[[nodiscard]] bool is_valid_name(std::string_view text);

/// A name of one kind; names of different kinds do not mix.
template <typename Tag>
class StrongName {
 public:
  StrongName() = default;
  explicit StrongName(std::string text) : text_(std::move(text)) {}

  [[nodiscard]] const std::string& str() const { return text_; }
  [[nodiscard]] bool empty() const { return text_.empty(); }

  friend bool operator==(const StrongName& a, const StrongName& b) { return a.text_ == b.text_; }
  friend bool operator!=(const StrongName& a, const StrongName& b) { return !(a == b); }
  friend bool operator<(const StrongName& a, const StrongName& b) { return a.text_ < b.text_; }

 private:
  std::string text_;
};

using CommandId = StrongName<struct CommandIdTag>;  ///< chosen by the client, unique in a cell; escapes get one from the planner
using RobotName = StrongName<struct RobotNameTag>;
using ToolName = StrongName<struct ToolNameTag>;  ///< of a tool or payload, unique in a cell

/// Place of a robot in its cell: 0 … n-1, in the order of the cell file.
using RobotIndex = std::size_t;

}  // namespace interlace::model

template <typename Tag>
struct std::hash<interlace::model::StrongName<Tag>> {
  std::size_t operator()(const interlace::model::StrongName<Tag>& name) const noexcept { return std::hash<std::string>{}(name.str()); }
};
