#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace interlace::core {

/// How long two robots need at least for all they have before them, if nobody else is there: of two that want the same room one after the
/// other that is more than either needs alone. Both go on in the order of their queues, each start as early as the last one of the other
/// leaves it clear, and none before a start that came earlier. Found backwards, once for all places and delays. An estimate: delays are
/// rounded to a step, and who is blocked for good is taken to be let by after a while. Immutable; thread-safe. Source: pattern databases
/// (Culberson and Schaeffer 1998), with pairs of robots as the patterns.
class PairRest {
 public:
  /// Starts of one's motion that one of the other's forbids, after the start of the latter, in order and disjoint [s].
  using Forbidden = std::vector<std::pair<double, double>>;

  /// One of the two: its last motion first, then those that wait.
  struct Side {
    std::vector<double> takes;                      ///< from a start until it can start again [s]
    std::vector<std::vector<Forbidden>> forbidden;  ///< of each waiting motion but the last motion, by each of the other's motions
  };

  PairRest(const Side& a, const Side& b);

  /// Until both are free at the end [s], from when the first of them is free, with `done_a` and `done_b` motions done and b free `later`
  /// than a.
  [[nodiscard]] double operator()(std::size_t done_a, std::size_t done_b, double later) const;

  /// Steps that it took.
  [[nodiscard]] std::size_t steps() const { return rest_.size(); }

 private:
  [[nodiscard]] double after_next(const Side& mover, const Side& other, std::size_t done, std::size_t done_other, double later,
                                  bool swapped) const;
  [[nodiscard]] std::size_t index(std::size_t done_a, std::size_t done_b) const { return (done_a * n_b_ + done_b) * n_; }

  std::size_t n_b_ = 0, n_ = 0;
  double most_ = 0;          // of a delay
  std::vector<float> rest_;  // by places and delay
};

}  // namespace interlace::core
