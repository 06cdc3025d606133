#pragma once

#include <cstddef>
#include <vector>

namespace interlace::core {

/// Which shifts (start of the commanded robot after the moving one's, [s]) are forbidden already, to the width of a bucket: never more than
/// was added. Shifts beyond the ends count as the ends.
class ShiftCover {
 public:
  /// Shifts from `first` to `last` in steps of about `width` [s].
  ShiftCover(double first, double last, double width);

  /// Forbids [from, until]; buckets that it does not fill stay as they are.
  void add(double from, double until);

  /// Whether all of [from, until] is forbidden.
  [[nodiscard]] bool holds(double from, double until);

 private:
  [[nodiscard]] double bucket(double shift) const;
  [[nodiscard]] std::size_t first_open(std::size_t from);

  double first_, per_second_;
  std::vector<std::size_t> next_;  // of each bucket one not before it that may be open, itself if it is; the last one always is
};

}  // namespace interlace::core
