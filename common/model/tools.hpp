#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/model/ids.hpp"
#include "common/model/robot_model.hpp"

namespace interlace::model {

/// Most tools a cell may know: one bit for each.
inline constexpr std::size_t kMaxTools = 32;

/// Something a robot may hold, tool or payload. Its capsules are fixed to the flange: link 6, ends in the flange frame (z forward), named
/// like the tool. The TCP stays where the model has it.
struct Tool {
  ToolName name;
  std::vector<LinkCapsule> capsules;
};

/// Which of a cell's tools a robot holds, or may hold: bits in the order of the cell.
class ToolSet {
 public:
  constexpr ToolSet() = default;
  /// The tool number `index`, below kMaxTools.
  [[nodiscard]] static constexpr ToolSet of(std::size_t index) { return ToolSet{std::uint32_t{1} << index}; }
  /// The first `count` tools, at most kMaxTools.
  [[nodiscard]] static constexpr ToolSet first(std::size_t count) {
    return ToolSet{count >= kMaxTools ? ~std::uint32_t{0} : (std::uint32_t{1} << count) - 1};
  }

  [[nodiscard]] constexpr bool empty() const { return bits_ == 0; }
  [[nodiscard]] constexpr bool has(std::size_t index) const { return (bits_ >> index & 1U) != 0; }
  [[nodiscard]] constexpr bool covers(ToolSet other) const { return (other.bits_ & ~bits_) == 0; }
  [[nodiscard]] constexpr ToolSet without(ToolSet other) const { return ToolSet{bits_ & ~other.bits_}; }

  friend constexpr ToolSet operator|(ToolSet a, ToolSet b) { return ToolSet{a.bits_ | b.bits_}; }
  friend constexpr bool operator==(ToolSet a, ToolSet b) { return a.bits_ == b.bits_; }
  friend constexpr bool operator!=(ToolSet a, ToolSet b) { return a.bits_ != b.bits_; }
  friend constexpr bool operator<(ToolSet a, ToolSet b) { return a.bits_ < b.bits_; }

 private:
  explicit constexpr ToolSet(std::uint32_t bits) : bits_(bits) {}
  std::uint32_t bits_ = 0;
};

/// What a robot holds before, during and after a motion. A change on start is over before the first movement, one on completion after the
/// last; while it takes place the robot may hold what it held and what it will hold.
struct ToolSteps {
  ToolSet before, during, after;

  [[nodiscard]] ToolSet at_start() const { return before | during; }
  [[nodiscard]] ToolSet at_end() const { return during | after; }
  [[nodiscard]] ToolSet all() const { return before | during | after; }
};

}  // namespace interlace::model
