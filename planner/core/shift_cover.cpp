#include "planner/core/shift_cover.hpp"

#include <algorithm>
#include <cmath>

namespace interlace::core {

ShiftCover::ShiftCover(double first, double last, double width)
    : first_(first), per_second_(1 / width), count_(static_cast<std::size_t>(std::ceil((last - first) * per_second_)) + 2) {}

double ShiftCover::bucket(double shift) const {
  return std::clamp((shift - first_) * per_second_, 0.0, static_cast<double>(count_.size() - 1));
}

void ShiftCover::add(double from, double until) {
  const auto begin = static_cast<std::size_t>(std::ceil(bucket(from)));
  const auto end = static_cast<std::size_t>(bucket(until));
  if (begin >= end) return;
  ++count_[begin];
  --count_[end];
}

void ShiftCover::settle() {
  int filling = 0;
  int filled = 0;
  for (int& count : count_) {
    filling += count;
    count = filled;
    filled += filling > 0 ? 1 : 0;
  }
}

bool ShiftCover::holds(double from, double until) const {
  const auto begin = static_cast<std::size_t>(bucket(from));
  const auto end = static_cast<std::size_t>(std::ceil(bucket(until)));
  return count_[end] - count_[begin] == static_cast<int>(end - begin);
}

}  // namespace interlace::core
