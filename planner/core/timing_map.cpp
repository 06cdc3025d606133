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
    cell(0, 0, 0, 0);
  }

 private:
  void cell(int own_level, std::size_t own_index, int other_level, std::size_t other_index) {
    const auto& a = own_->piece(own_level, own_index);
    const auto& b = other_->piece(other_level, other_index);
    bool undecided = false;
    bool collides = false;  // for certain, at the centre
    double least = kNever;  // of clearance minus bound over the pairs that are not proven free
    BlockedCell found;
    for (std::size_t i = 0; i < a.bodies.size(); ++i) {
      for (std::size_t j = 0; j < b.bodies.size(); ++j) {
        const double bound = a.reach[i] + b.reach[j] + margin_;
        if (clearance_lower_bound(a.bodies[i], b.bodies[j]) > bound) continue;
        const double d = clearance(a.bodies[i], b.bodies[j]);
        ++map_.evaluations;
        if (d > bound) continue;
        const bool throughout = d < margin_ - (a.reach[i] + b.reach[j]);
        undecided = true;
        collides = collides || d <= margin_;
        if (d - bound < least || throughout) {
          least = d - bound;
          found.own_body = static_cast<std::uint16_t>(i);
          found.other_body = static_cast<std::uint16_t>(j);
          found.clearance = d;
          found.bound = bound;
        }
        if (throughout) return block(a, b, found);
      }
    }
    if (!undecided) return;
    // A cell with a collision inside stays blocked at the resolution; one without may still turn out free when looked at more closely.
    const bool own_splits = own_level < (collides ? own_->depth() : own_->finest());
    const bool other_splits = other_level < (collides ? other_->depth() : other_->finest());
    if (!own_splits && !other_splits) return block(a, b, found);
    if (own_splits && (!other_splits || a.largest_reach >= b.largest_reach)) {
      cell(own_level + 1, 2 * own_index, other_level, other_index);
      cell(own_level + 1, 2 * own_index + 1, other_level, other_index);
    } else {
      cell(own_level, own_index, other_level + 1, 2 * other_index);
      cell(own_level, own_index, other_level + 1, 2 * other_index + 1);
    }
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
