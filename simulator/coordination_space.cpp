#include "simulator/coordination_space.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <unordered_map>

namespace interlace::sim {

namespace {

/// A robot's progress on the lattice.
struct Lattice {
  Lattice(const Track& track, double step) : points(stop_points(track, step)), times(track.stops) {
    at_stop.assign(points.back() + 1, false);
    for (const std::size_t p : points) at_stop[p] = true;
  }

  /// Where the progress `t` [s] lies; stops lie on their points exactly.
  [[nodiscard]] double place(double t) const {
    const auto next = std::upper_bound(times.begin(), times.end(), t);
    if (next == times.begin()) return 0;
    if (next == times.end()) return static_cast<double>(points.back());
    const auto i = static_cast<std::size_t>(next - times.begin()) - 1;
    const double share = (t - times[i]) / (times[i + 1] - times[i]);
    return static_cast<double>(points[i]) + share * static_cast<double>(points[i + 1] - points[i]);
  }

  std::vector<std::size_t> points;
  std::vector<double> times;
  std::vector<bool> at_stop;
};

constexpr double kTouch = 1e-6;  // parts of a step that two spans may overlap by rounding alone

/// Steps [first, last) that overlap `span`.
std::pair<std::size_t, std::size_t> steps_in(const Lattice& lattice, const Span& span) {
  const double from = lattice.place(span.from) + kTouch;
  const double until = lattice.place(span.until) - kTouch;
  if (until <= from) return {0, 0};
  return {static_cast<std::size_t>(from), std::min(static_cast<std::size_t>(std::ceil(until)), lattice.points.back())};
}

/// Progress of three robots.
using Place = std::array<std::size_t, 3>;

class TripleSearch {
 public:
  TripleSearch(const std::vector<Track>& tracks, const std::vector<PairSpace>& pairs, double step) : pairs_(pairs) {
    for (const Track& t : tracks) lattices_.emplace_back(t, step);
  }

  /// A*: states in which some robot can choose between going and waiting, with the pairs' own optimum as the bound.
  TripleResult run(std::size_t most_states) {
    push({0, 0, 0}, 0);
    while (!open_.empty()) {
      const auto lowest = open_.begin();
      if (lowest->second.empty()) {
        open_.erase(lowest);
        continue;
      }
      const std::uint32_t bound = lowest->first;
      const auto [place, steps] = lowest->second.back();
      lowest->second.pop_back();
      if (best_.at(key(place)) < steps) continue;
      if (at_end(place)) return {steps, true};
      if (best_.size() > most_states) return {bound, false};
      expand(place, steps);
    }
    return {std::nullopt, true};
  }

 private:
  static constexpr unsigned kAll = 7;

  [[nodiscard]] std::uint64_t key(const Place& p) const {
    return (p[0] * lattices_[1].at_stop.size() + p[1]) * lattices_[2].at_stop.size() + p[2];
  }
  [[nodiscard]] bool done(const Place& p, std::size_t i) const { return p[i] == lattices_[i].points.back(); }
  [[nodiscard]] bool at_end(const Place& p) const { return done(p, 0) && done(p, 1) && done(p, 2); }
  [[nodiscard]] bool chooses(const Place& p, std::size_t i) const { return lattices_[i].at_stop[p[i]] && !done(p, i); }

  [[nodiscard]] std::uint32_t to_go(const Place& p) const {
    return std::max({pairs_[0].to_go(p[0], p[1]), pairs_[1].to_go(p[0], p[2]), pairs_[2].to_go(p[1], p[2])});
  }

  [[nodiscard]] static bool pair_may(const PairSpace& pair, std::size_t u, std::size_t v, bool a, bool b) {
    return a && b ? pair.both_may_move(u, v) : a ? pair.a_may_move(u, v) : b ? pair.b_may_move(u, v) : true;
  }
  [[nodiscard]] bool may(const Place& p, unsigned moving) const {
    const bool a = (moving & 1U) != 0, b = (moving & 2U) != 0, c = (moving & 4U) != 0;
    return pair_may(pairs_[0], p[0], p[1], a, b) && pair_may(pairs_[1], p[0], p[2], a, c) && pair_may(pairs_[2], p[1], p[2], b, c);
  }

  void expand(const Place& place, std::uint32_t steps) {
    unsigned under_way = 0, choosing = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      if (chooses(place, i)) {
        choosing |= 1U << i;
      } else if (!done(place, i)) {
        under_way |= 1U << i;
      }
    }
    for (unsigned moving = 1; moving <= kAll; ++moving) {
      if ((moving & under_way) != under_way || (moving & ~(under_way | choosing)) != 0) continue;
      follow(place, moving, steps);
    }
  }

  /// Goes on until somebody has a choice again.
  void follow(Place p, unsigned moving, std::uint32_t steps) {
    for (;;) {
      if (!may(p, moving)) return;
      unsigned next = 0;
      bool choice = false;
      for (std::size_t i = 0; i < 3; ++i) {
        if ((moving >> i & 1U) != 0) ++p[i];
        if (chooses(p, i)) {
          choice = true;
        } else if (!done(p, i)) {
          next |= 1U << i;
        }
      }
      ++steps;
      if (choice || next == 0) return push(p, steps);
      moving = next;
    }
  }

  void push(const Place& p, std::uint32_t steps) {
    const std::uint32_t rest = to_go(p);
    if (rest == PairSpace::kNever) return;
    const auto [entry, fresh] = best_.try_emplace(key(p), steps);
    if (!fresh && entry->second <= steps) return;
    entry->second = steps;
    open_[steps + rest].emplace_back(p, steps);
  }

  const std::vector<PairSpace>& pairs_;
  std::vector<Lattice> lattices_;
  std::unordered_map<std::uint64_t, std::uint32_t> best_;
  std::map<std::uint32_t, std::vector<std::pair<Place, std::uint32_t>>> open_;  // by bound, the newest last
};

}  // namespace

namespace {

/// Why a robot may not leave one of its stops: by the other's progress.
constexpr unsigned kOtherMoves = 1, kOtherStands = 2;
using Leaving = std::map<std::size_t, std::vector<unsigned>>;  // by lattice point of the stop

Leaving leaving(const std::vector<Crossing::Leaving>& forbidden, const Lattice& own, const Lattice& other) {
  Leaving result;
  for (const Crossing::Leaving& l : forbidden) {
    auto& row = result[own.points[l.motion]];
    row.resize(other.points.back() + 1);
    if (l.progress.from == l.progress.until) {
      row[static_cast<std::size_t>(std::lround(other.place(l.progress.from)))] |= kOtherStands;
      continue;
    }
    const auto first = static_cast<std::size_t>(std::ceil(other.place(l.progress.from) + kTouch));
    const auto last = static_cast<std::size_t>(std::max(0.0, other.place(l.progress.until) - kTouch));
    for (std::size_t v = first; v <= last && v < other.points[l.other + 1]; ++v) row[v] |= kOtherMoves;
    if (l.progress.from <= other.times[l.other]) row[other.points[l.other]] |= kOtherMoves;  // both leave, the other a moment before
  }
  return result;
}

unsigned why(const Leaving& leaving, std::size_t own, std::size_t other) {
  const auto row = leaving.find(own);
  return row == leaving.end() ? 0U : row->second[other];
}

/// By the stop that a robot leaves and the one where the other stands in its way: steps after which it has passed.
std::map<std::pair<std::size_t, std::size_t>, std::size_t> passed_by(const std::vector<Crossing::Leaving>& stands, const Lattice& own,
                                                                     const Lattice& other, double step) {
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> passed;
  for (const Crossing::Leaving& l : stands) {
    if (l.progress.from != l.progress.until) continue;
    const std::size_t u = own.points[l.motion], whole = own.points[l.motion + 1] - u;
    const std::size_t until = l.until < static_cast<double>(whole) * step ? static_cast<std::size_t>(l.until / step) + 1 : whole;
    auto& most = passed[{u, static_cast<std::size_t>(std::lround(other.place(l.progress.from)))}];
    most = std::max(most, std::min(until, whole));
  }
  return passed;
}

}  // namespace

std::vector<std::size_t> stop_points(const Track& track, double step) {
  std::vector<std::size_t> points;
  for (const double t : track.stops) points.push_back(static_cast<std::size_t>(std::lround(t / step)));
  return points;
}

PairSpace::PairSpace(const Track& track_a, const Track& track_b, const Crossing& crossing, double step, double promise)
    : rows_(0), columns_(0) {
  const Lattice a{track_a, step}, b{track_b, step};
  rows_ = a.points.back() + 1;
  columns_ = b.points.back() + 1;
  may_.assign(rows_ * columns_, kBoth);
  const auto allow = [&](std::size_t u, std::size_t v, std::uint8_t what) {
    may_[u * columns_ + v] = static_cast<std::uint8_t>(may_[u * columns_ + v] | what);
  };
  for (const std::size_t u : a.points) {
    for (std::size_t v = 0; v < columns_; ++v) allow(u, v, kOnlyB);
  }
  for (const std::size_t v : b.points) {
    for (std::size_t u = 0; u < rows_; ++u) allow(u, v, kOnlyA);
  }
  for (const Crossing::Moving& m : crossing.moving) {
    const std::size_t u0 = a.points[m.a], u1 = a.points[m.a + 1], v0 = b.points[m.b], v1 = b.points[m.b + 1];
    const long first = std::lround(std::floor(m.shift.from / step + kTouch)) + 1;
    const long last = std::lround(std::ceil(m.shift.until / step - kTouch)) - 1;
    for (std::size_t u = u0; u < u1; ++u) {
      const long own = static_cast<long>(u - u0);
      const long lowest = std::max(own - last, 0L), highest = std::min(own - first, static_cast<long>(v1 - v0) - 1);
      for (long v = lowest; v <= highest; ++v) forbid(u, v0 + static_cast<std::size_t>(v), kBoth);
    }
  }
  const auto stand_still = [&](std::size_t u, std::size_t v) {  // nobody may come here
    forbid(u, v, kBoth | kOnlyA | kOnlyB);
    if (u > 0 && v > 0) forbid(u - 1, v - 1, kBoth);
    if (u > 0) forbid(u - 1, v, kOnlyA);
    if (v > 0) forbid(u, v - 1, kOnlyB);
  };
  for (const Crossing::Standing& s : crossing.a_stands) {
    const std::size_t u = a.points[s.stop];
    const auto [first, last] = steps_in(b, s.other);
    for (std::size_t v = first; v < last; ++v) forbid(u, v, kOnlyB);
    if (s.other.from == s.other.until) stand_still(u, static_cast<std::size_t>(std::lround(b.place(s.other.from))));
  }
  for (const Crossing::Standing& s : crossing.b_stands) {
    const std::size_t v = b.points[s.stop];
    const auto [first, last] = steps_in(a, s.other);
    for (std::size_t u = first; u < last; ++u) forbid(u, v, kOnlyA);
    if (s.other.from == s.other.until) stand_still(static_cast<std::size_t>(std::lround(a.place(s.other.from))), v);
  }
  forbid_leaving(track_a, track_b, crossing, step, promise);
  to_go_.assign(rows_ * columns_, kNever);
  for (std::size_t u = rows_; u-- > 0;) {
    for (std::size_t v = columns_; v-- > 0;) {
      if (u + 1 == rows_ && v + 1 == columns_) {
        to_go_[u * columns_ + v] = 0;
        continue;
      }
      std::uint16_t least = kNever;
      const std::uint8_t may = may_[u * columns_ + v];
      if ((may & kBoth) != 0 && u + 1 < rows_ && v + 1 < columns_) least = std::min(least, to_go(u + 1, v + 1));
      if ((may & kOnlyA) != 0 && u + 1 < rows_) least = std::min(least, to_go(u + 1, v));
      if ((may & kOnlyB) != 0 && v + 1 < columns_) least = std::min(least, to_go(u, v + 1));
      if (least != kNever) to_go_[u * columns_ + v] = static_cast<std::uint16_t>(least + 1);
    }
  }
}

/// When both leave at the same time, either may have been first. Who sets out towards a place that the other one stands at, or comes to and
/// leaves again, has that one leave it within the promise, and that departure must not rely on him in turn.
void PairSpace::forbid_leaving(const Track& track_a, const Track& track_b, const Crossing& crossing, double step, double promise) {
  const Lattice a{track_a, step}, b{track_b, step};
  const Leaving of_a = leaving(crossing.a_leaves, a, b), of_b = leaving(crossing.b_leaves, b, a);
  const auto promised = static_cast<std::size_t>(std::lround(promise / step));
  const auto forbid_all = [&](const Leaving& own_leaves, const Leaving& others_leave, const Lattice& own, const Lattice& other,
                              const std::vector<Crossing::Leaving>& stands, const std::vector<Crossing::Leaving>& before, bool own_is_a) {
    const std::uint8_t only_own = own_is_a ? kOnlyA : kOnlyB;
    const auto forbid_at = [&](std::size_t at_own, std::size_t at_other, unsigned what) {
      own_is_a ? forbid(at_own, at_other, what) : forbid(at_other, at_own, what);
    };
    const auto passed = passed_by(stands, own, other, step);
    for (const auto& [u, row] : own_leaves) {
      for (std::size_t v = 0; v < row.size(); ++v) {
        if ((row[v] & kOtherMoves) != 0 && !other.at_stop[v] && promised == 0) forbid_at(u, v, kBoth);
        if ((row[v] & kOtherStands) == 0) continue;
        const std::size_t end = u + passed.at({u, v});
        forbid_at(u, v, promised == 0 ? only_own : 0U);
        for (std::size_t k = std::max<std::size_t>(promised, 1); u + k < end; ++k) forbid_at(u + k, v, only_own);
        for (std::size_t k = promised + 1; u + k < end; ++k) forbid_at(u + k, v, kBoth);
        const bool in_turn = (why(others_leave, v, u) & kOtherStands) != 0;
        for (std::size_t k = 1; in_turn && k <= promised && u + k < end; ++k) forbid_at(u + k, v, kBoth);
      }
    }
    for (const Crossing::Leaving& l : before) {
      const std::size_t u = own.points[l.motion], v = other.points[l.other], end = own.points[l.motion + 1];
      if ((why(own_leaves, u, v) & kOtherStands) == 0) continue;
      const auto last = static_cast<std::size_t>(std::max(0.0, l.progress.until / step - kTouch));
      for (std::size_t k = 1; k <= last && k <= promised && u + k < end; ++k) forbid_at(u + k, v, kBoth);
    }
  };
  forbid_all(of_a, of_b, a, b, crossing.a_leaves, crossing.a_before, true);
  forbid_all(of_b, of_a, b, a, crossing.b_leaves, crossing.b_before, false);
  for (const std::size_t u : a.points) {
    for (const std::size_t v : b.points) {
      const unsigned why_a = why(of_a, u, v), why_b = why(of_b, v, u);
      const bool a_first = (why_a & kOtherStands) == 0 && (why_b & kOtherMoves) == 0;
      const bool b_first = (why_b & kOtherStands) == 0 && (why_a & kOtherMoves) == 0;
      if (!a_first && !b_first) forbid(u, v, kBoth);
    }
  }
}

TripleResult least_steps(const std::vector<Track>& tracks, const std::vector<PairSpace>& pairs, double step, std::size_t most_states) {
  return TripleSearch{tracks, pairs, step}.run(most_states);
}

}  // namespace interlace::sim
