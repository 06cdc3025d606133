#include "planner/core/pair_rest.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace interlace::core {

namespace {

constexpr double kStep = 0.2;  // [s] of delays
constexpr double kLetBy = 5;   // [s] it takes until somebody makes room
constexpr double kUnreachable = std::numeric_limits<double>::infinity();

double alone(const PairRest::Side& side, std::size_t done) {
  return std::accumulate(side.takes.begin() + static_cast<std::ptrdiff_t>(done) + 1, side.takes.end(), 0.0);
}

}  // namespace

PairRest::PairRest(const Side& a, const Side& b) : n_b_(b.takes.size()) {
  for (const Side* side : {&a, &b}) most_ = std::max(most_, *std::max_element(side->takes.begin(), side->takes.end()));
  const auto half = static_cast<std::size_t>(std::ceil(most_ / kStep)) + 1;
  most_ = static_cast<double>(half) * kStep;
  n_ = 2 * half + 1;
  rest_.resize(a.takes.size() * n_b_ * n_);
  for (std::size_t done_a = a.takes.size(); done_a-- > 0;) {
    for (std::size_t done_b = n_b_; done_b-- > 0;) {
      const bool all_a = done_a + 1 == a.takes.size(), all_b = done_b + 1 == n_b_;
      for (std::size_t k = 0; k < n_; ++k) {
        const double later = static_cast<double>(k) * kStep - most_;
        double rest = std::abs(later);
        if (!all_a || !all_b) {
          const double a_next = all_a ? kUnreachable : after_next(a, b, done_a, done_b, later, false);
          const double b_next = all_b ? kUnreachable : after_next(b, a, done_b, done_a, -later, true);
          rest = std::min(a_next, b_next);
        }
        if (rest == kUnreachable)
          rest = std::max(alone(a, done_a) + std::max(0.0, -later), alone(b, done_b) + std::max(0.0, later)) + kLetBy;
        rest_[index(done_a, done_b) + k] = static_cast<float>(rest);
      }
    }
  }
}

/// What is left when `mover` makes its next motion first, with the other free `later` than it.
double PairRest::after_next(const Side& mover, const Side& other, std::size_t done, std::size_t done_other, double later,
                            bool swapped) const {
  const double free = std::max(0.0, -later), other_free = std::max(0.0, later);
  const double other_start = other_free - other.takes[done_other];
  double start = std::max(free, other_start);
  for (const auto& [from, until] : mover.forbidden[done][done_other]) {
    if (other_start + from > start) break;
    if (other_start + until <= start) continue;
    start = other_start + until;
  }
  if (!std::isfinite(start)) return start;
  const double free_then = start + mover.takes[done + 1], other_then = std::max(other_free, start);
  const double later_then = other_then - free_then;
  const double rest = swapped ? (*this)(done_other, done + 1, -later_then) : (*this)(done + 1, done_other, later_then);
  return std::min(free_then, other_then) + rest;
}

double PairRest::operator()(std::size_t done_a, std::size_t done_b, double later) const {
  const double within = std::clamp(later, -most_, most_);
  const double at = (within + most_) / kStep;
  const auto k = std::min(static_cast<std::size_t>(at), n_ - 2);
  const double part = at - static_cast<double>(k);
  const float* rest = &rest_[index(done_a, done_b) + k];
  return (1 - part) * static_cast<double>(rest[0]) + part * static_cast<double>(rest[1]) + std::abs(later - within);
}

}  // namespace interlace::core
