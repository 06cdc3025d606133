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

  /// After the last `add` and before the first `holds`.
  void settle();

  /// Whether all of [from, until] is forbidden.
  [[nodiscard]] bool holds(double from, double until) const;

 private:
  [[nodiscard]] double bucket(double shift) const;

  double first_, per_second_;
  std::vector<int> count_;  // first the changes of how many intervals fill a bucket; settled: how many buckets before this one are filled
};

}  // namespace interlace::core
