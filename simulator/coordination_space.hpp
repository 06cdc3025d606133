#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace interlace::sim {

/// Times [s]; ends included where something is only touched at one instant.
struct Span {
  double from = 0, until = 0;
};

/// When a robot that never waits comes to its stops: 0 first, then the end of each of its motions [s]. Its progress is the time it has
/// moved.
struct Track {
  std::vector<double> stops{0.0};
};

/// Where two robots a and b would meet.
struct Crossing {
  /// While both move: the time into a's motion less the time into b's, open intervals.
  struct Moving {
    std::size_t a = 0, b = 0;  ///< motions
    Span shift;
  };
  /// While one stands at its stop `stop`: the other's progress. A span of no length: also while it stands there.
  struct Standing {
    std::size_t stop = 0;
    Span other;
  };
  /// A start that must not be: of motion `motion` while the other's progress, in its motion `other`, is in `progress`. A span of no length:
  /// while the other stands there.
  struct Leaving {
    std::size_t motion = 0, other = 0;
    Span progress;
    double until = 0;  ///< of one that stands: so long after the start the place is passed
  };
  std::vector<Moving> moving;
  std::vector<Standing> a_stands, b_stands;
  std::vector<Leaving> a_leaves, b_leaves;
  /// Starts of motion `motion` so long before the other's motion `other` that it would meet the other where that ends: `progress` is the
  /// time between the two starts.
  std::vector<Leaving> a_before, b_before;
};

/// Coordination space of two robots on a lattice of progress: what both may do from each point, and how soon they can be done from there.
/// A robot may wait only at its stops. Source: O'Donnell and Lozano-Pérez 1989, with time laws fixed.
class PairSpace {
 public:
  static constexpr std::uint16_t kNever = UINT16_MAX;

  /// `step` [s] of the lattice; stops lie on it to half a step, however many there are.
  /// `promise` [s]: a start may rely on one of the other robot that is decided already and follows within so long.
  PairSpace(const Track& a, const Track& b, const Crossing& crossing, double step, double promise = 0);

  /// Steps that are needed from (u, v) to the end of both; kNever where there is no way.
  [[nodiscard]] std::uint16_t to_go(std::size_t u, std::size_t v) const { return to_go_[u * columns_ + v]; }

  [[nodiscard]] bool both_may_move(std::size_t u, std::size_t v) const { return (may_[u * columns_ + v] & kBoth) != 0; }
  [[nodiscard]] bool a_may_move(std::size_t u, std::size_t v) const { return (may_[u * columns_ + v] & kOnlyA) != 0; }
  [[nodiscard]] bool b_may_move(std::size_t u, std::size_t v) const { return (may_[u * columns_ + v] & kOnlyB) != 0; }

 private:
  static constexpr std::uint8_t kBoth = 1, kOnlyA = 2, kOnlyB = 4;  // a step from a point; the other stands at a stop

  void forbid(std::size_t u, std::size_t v, unsigned what) {
    may_[u * columns_ + v] = static_cast<std::uint8_t>(may_[u * columns_ + v] & ~what);
  }
  void forbid_leaving(const Track& a, const Track& b, const Crossing& crossing, double step, double promise);

  std::size_t rows_, columns_;
  std::vector<std::uint8_t> may_;
  std::vector<std::uint16_t> to_go_;
};

/// Least number of steps in which three robots get everything done, pairs in the order ab, ac, bc.
struct TripleResult {
  std::optional<std::uint32_t> steps;  ///< empty: there is no way
  bool complete = true;                ///< false: given up after `most_states`, and `steps` is only a lower bound
};
[[nodiscard]] TripleResult least_steps(const std::vector<Track>& tracks, const std::vector<PairSpace>& pairs, double step,
                                       std::size_t most_states);

/// Lattice points of the stops of `track`.
[[nodiscard]] std::vector<std::size_t> stop_points(const Track& track, double step);

}  // namespace interlace::sim
