#include "planner/core/timing_map.hpp"

#include <algorithm>

namespace interlace::core {

namespace {

/// Rounding of poses and of FCL's distance, kept on the safe side [m].
constexpr double kRounding = 1e-7;

class Subdivision {
 public:
  Subdivision(TimingMap& map, double margin) : map_(map), margin_(margin + kRounding) {}

  /// Examines all of both motions' pieces; a standing robot's single piece stands for `own` or `other` times given.
  void examine(SampledMotion& own, SampledMotion& other, double tau0, double tau1, double t0, double t1) {
    own_ = &own;
    other_ = &other;
    own_stands_ = own.depth() == 0;
    other_stands_ = other.depth() == 0;
    tau0_ = tau0;
    tau1_ = tau1;
    t0_ = t0;
    t1_ = t1;
    open_.clear();
    const std::size_t own_bodies = own.robot().model.capsules.size();
    const std::size_t other_bodies = other.robot().model.capsules.size();
    const std::size_t pairs = own_bodies * other_bodies;
    open_.reserve(pairs *
                  static_cast<std::size_t>(own.finest() + other.finest() + 2));  // each cell on the way down adds to it at most once
    for (std::size_t i = own_bodies; i-- > 0;) {                                 // hands first: they meet first
      for (std::size_t j = other_bodies; j-- > 0;) open_.push_back({static_cast<std::uint16_t>(i), static_cast<std::uint16_t>(j)});
    }
    cell(0, 0, 0, 0, 0, pairs);
  }

 private:
  /// Bodies of both robots that are not proven apart yet.
  struct Pair {
    std::uint16_t own, other;
  };

  /// Examines one cell for the pairs [first, last) of `open_`: those its parent could not prove apart, the parent's worst one first. Pairs
  /// that this cell cannot prove apart either are passed on behind them.
  void cell(int own_level, std::size_t own_index, int other_level, std::size_t other_index, std::size_t first, std::size_t last) {
    const SampledMotion::Piece& a = own_->piece(own_level, own_index);
    const SampledMotion::Piece& b = other_->piece(other_level, other_index);
    const bool at_resolution = own_level >= own_->depth() && other_level >= other_->depth();
    bool decided = false;   // dividing it gains nothing
    double least = kNever;  // of clearance minus bound over the pairs that are not proven apart
    std::size_t worst = last;
    BlockedCell found;
    for (std::size_t k = first; k < last; ++k) {
      const Pair pair = open_[k];
      const Body& x = a.bodies[pair.own];
      const Body& y = b.bodies[pair.other];
      const double reach = a.reach[pair.own] + b.reach[pair.other];
      const double bound = reach + margin_;
      if (surely_farther(x, y, bound)) continue;
      const double d = clearance(x, y);
      ++map_.evaluations;
      if (d > bound) continue;
      decided = d < margin_ - reach || (at_resolution && d <= margin_);
      if (d - bound < least || decided) {
        least = d - bound;
        worst = open_.size();
        found.own_body = pair.own;
        found.other_body = pair.other;
        found.clearance = d;
        found.bound = bound;
      }
      open_.push_back(pair);
      if (decided) break;
    }
    if (open_.size() == last) return;
    // Down to the resolution both motions are halved to it; beyond, either.
    const bool own_splits = own_level < (at_resolution ? own_->finest() : own_->depth());
    const bool other_splits = other_level < (at_resolution ? other_->finest() : other_->depth());
    if (decided || (!own_splits && !other_splits)) {
      block(a, b, found);
    } else {
      std::swap(open_[last], open_[worst]);
      const std::size_t end = open_.size();
      if (own_splits && (!other_splits || a.reach[found.own_body] >= b.reach[found.other_body])) {
        cell(own_level + 1, 2 * own_index, other_level, other_index, last, end);
        cell(own_level + 1, 2 * own_index + 1, other_level, other_index, last, end);
      } else {
        cell(own_level, own_index, other_level + 1, 2 * other_index, last, end);
        cell(own_level, own_index, other_level + 1, 2 * other_index + 1, last, end);
      }
    }
    open_.resize(last);
  }

  void block(const SampledMotion::Piece& a, const SampledMotion::Piece& b, BlockedCell& found) {
    found.tau0 = own_stands_ ? tau0_ : a.t0;
    found.tau1 = own_stands_ ? tau1_ : a.t1;
    found.t0 = other_stands_ ? t0_ : b.t0;
    found.t1 = other_stands_ ? t1_ : b.t1;
    map_.blocked.push_back(found);
  }

  TimingMap& map_;
  double margin_;
  std::vector<Pair> open_;  // lists of the cells from the first one down to the one examined, one behind the other
  SampledMotion* own_ = nullptr;
  SampledMotion* other_ = nullptr;
  bool own_stands_ = false, other_stands_ = false;
  double tau0_ = 0, tau1_ = 0, t0_ = 0, t1_ = 0;
};

}  // namespace

TimingMap build_timing_map(SampledMotion& commanded, SampledMotion& moving, double margin) {
  TimingMap map;
  map.commanded_duration = commanded.motion().duration();
  map.moving_duration = moving.motion().duration();
  Subdivision subdivision{map, margin};
  const double end = map.commanded_duration;
  const double other_end = map.moving_duration;
  if (moving.depth() == 0) {  // stands for good
    if (commanded.depth() > 0) subdivision.examine(commanded, moving, 0, end, -kNever, kNever);
    subdivision.examine(commanded.at_end(), moving, end, kNever, -kNever, kNever);
    return map;
  }
  if (commanded.depth() > 0) {
    subdivision.examine(commanded, moving.at_start(), 0, end, -kNever, 0);
    subdivision.examine(commanded, moving, 0, end, 0, other_end);
    subdivision.examine(commanded, moving.at_end(), 0, end, other_end, kNever);
  }
  subdivision.examine(commanded.at_end(), moving.at_start(), end, kNever, -kNever, 0);
  subdivision.examine(commanded.at_end(), moving, end, kNever, 0, other_end);
  subdivision.examine(commanded.at_end(), moving.at_end(), end, kNever, other_end, kNever);
  return map;
}

}  // namespace interlace::core
