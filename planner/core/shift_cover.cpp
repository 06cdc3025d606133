#include "planner/core/shift_cover.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace interlace::core {

ShiftCover::ShiftCover(double first, double last, double width)
    : first_(first), per_second_(1 / width), next_(static_cast<std::size_t>(std::ceil((last - first) * per_second_)) + 2) {
  std::iota(next_.begin(), next_.end(), std::size_t{0});
}

double ShiftCover::bucket(double shift) const {
  return std::clamp((shift - first_) * per_second_, 0.0, static_cast<double>(next_.size() - 1));
}

std::size_t ShiftCover::first_open(std::size_t from) {
  while (next_[from] != from) {
    next_[from] = next_[next_[from]];  // paths halve each time they are gone, so they stay short
    from = next_[from];
  }
  return from;
}

void ShiftCover::add(double from, double until) {
  const auto end = static_cast<std::size_t>(bucket(until));
  for (auto b = first_open(static_cast<std::size_t>(std::ceil(bucket(from)))); b < end; b = first_open(b)) next_[b] = b + 1;
}

bool ShiftCover::holds(double from, double until) {
  return first_open(static_cast<std::size_t>(bucket(from))) >= static_cast<std::size_t>(std::ceil(bucket(until)));
}

}  // namespace interlace::core
