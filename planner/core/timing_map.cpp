#include "planner/core/timing_map.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "planner/core/shift_cover.hpp"

namespace interlace::core {

namespace {

/// Rounding of poses and of FCL's distance, kept on the safe side [m].
constexpr double kRounding = 1e-7;

/// Room made at once for what a map collects: most maps never need more.
constexpr std::size_t kRoom = 1024;

/// Width of the buckets in which forbidden shifts are counted [s]: a small part of the resolution.
constexpr double kBucket = 0.001;

/// A part of the plane that two motions, or standing robots, make up; a standing robot's single piece stands for the times given.
struct Panel {
  SampledMotion* own;
  SampledMotion* other;
  double tau0, tau1, t0, t1;
};

class Subdivision {
 public:
  Subdivision(TimingMap& map, double margin) : map_(map), margin_(margin + kRounding) {}

  /// Examines all of both motions' pieces.
  void examine(const Panel& panel) {
    panel_ = panel;
    panels_.push_back(panel);
    const std::size_t own_bodies = panel.own->robot().model.capsules.size();
    const std::size_t other_bodies = panel.other->robot().model.capsules.size();
    open_.clear();  // each cell on the way down adds each pair at most once
    open_.reserve(own_bodies * other_bodies * static_cast<std::size_t>(panel.own->finest() + panel.other->finest() + 2));
    for (std::size_t i = own_bodies; i-- > 0;) {  // hands first: they meet first
      for (std::size_t j = other_bodies; j-- > 0;) open_.push_back({static_cast<std::uint16_t>(i), static_cast<std::uint16_t>(j)});
    }
    cell({0, 0, 0, 0}, 0, open_.size());
  }

  /// Looks more closely at the cells that `examine` has put off, where that could make a start window longer.
  void finish() {
    if (put_off_.empty()) return;
    closer_ = true;
    ShiftCover forbidden{-map_.commanded_duration, map_.moving_duration, kBucket};
    const auto shifts = [](const BlockedCell& c) { return std::make_pair(c.t0 - c.tau1, c.t1 - c.tau0); };
    for (const BlockedCell& c : map_.blocked) forbidden.add(shifts(c).first, shifts(c).second);
    forbidden.settle();
    for (const PutOff& p : put_off_) {
      if (forbidden.holds(shifts(p.found).first, shifts(p.found).second)) {
        map_.blocked.push_back(p.found);
        continue;
      }
      panel_ = panels_[p.panel];
      open_.assign(put_off_pairs_.begin() + static_cast<std::ptrdiff_t>(p.first_pair),
                   put_off_pairs_.begin() + static_cast<std::ptrdiff_t>(p.last_pair));
      cell(p.place, 0, open_.size());
    }
  }

 private:
  /// Bodies of both robots that are not proven apart yet.
  struct Pair {
    std::uint16_t own, other;
  };
  /// Which pieces a cell is made of.
  struct Place {
    int own_level;
    std::size_t own_index;
    int other_level;
    std::size_t other_index;
  };
  /// A cell of the resolution whose centre seems clear.
  struct PutOff {
    std::size_t panel;  // of `panels_`
    Place place;
    BlockedCell found;
    std::size_t first_pair, last_pair;  // of `put_off_pairs_`
  };

  /// Examines one cell for the pairs [first, last) of `open_`: those its parent could not prove apart, the parent's worst one first. Pairs
  /// that this cell cannot prove apart either are passed on behind them.
  void cell(const Place& at, std::size_t first, std::size_t last) {
    model::CapsuleSet own = 0;
    model::CapsuleSet other = 0;
    for (std::size_t k = first; k < last; ++k) {
      own |= model::only_capsule(open_[k].own);
      other |= model::only_capsule(open_[k].other);
    }
    const SampledMotion::Piece& a = panel_.own->piece(at.own_level, at.own_index, own);
    const SampledMotion::Piece& b = panel_.other->piece(at.other_level, at.other_index, other);
    const bool at_resolution = at.own_level >= panel_.own->depth() && at.other_level >= panel_.other->depth();
    bool blocked = false;                       // dividing it gains nothing
    double least = kNever;                      // of clearance minus bound over the pairs that are not proven apart
    std::size_t worst = last, reached = first;  // the pair of `least`; the last one looked at
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
      blocked = d < margin_ - reach || (at_resolution && d <= margin_);
      if (d - bound < least || blocked) {
        least = d - bound;
        worst = open_.size();
        found.own_body = pair.own;
        found.other_body = pair.other;
        found.clearance = d;
        found.bound = bound;
      }
      open_.push_back(pair);
      reached = k;
      if (blocked || (at_resolution && !closer_)) break;
    }
    if (open_.size() == last) return;
    set_times(found, a, b);
    if (blocked) {
      block(found);
    } else if (at_resolution && !closer_) {
      put_off(at, found, reached, last);
    } else {
      std::swap(open_[last], open_[worst]);
      const bool own_is_farther = a.reach[found.own_body] >= b.reach[found.other_body];
      if (!divide(at, at_resolution, own_is_farther, last)) block(found);
    }
    open_.resize(last);
  }

  /// Examines the halves of a cell for the pairs from `first` on. False when it cannot be divided.
  bool divide(const Place& at, bool at_resolution, bool own_is_farther, std::size_t first) {
    const std::size_t last = open_.size();
    const bool own_splits = at.own_level < (at_resolution ? panel_.own->finest() : panel_.own->depth());
    const bool other_splits = at.other_level < (at_resolution ? panel_.other->finest() : panel_.other->depth());
    if (own_splits && (own_is_farther || !other_splits)) {
      cell({at.own_level + 1, 2 * at.own_index, at.other_level, at.other_index}, first, last);
      cell({at.own_level + 1, 2 * at.own_index + 1, at.other_level, at.other_index}, first, last);
      return true;
    }
    if (!other_splits) return false;
    cell({at.own_level, at.own_index, at.other_level + 1, 2 * at.other_index}, first, last);
    cell({at.own_level, at.own_index, at.other_level + 1, 2 * at.other_index + 1}, first, last);
    return true;
  }

  void block(const BlockedCell& found) {
    if (map_.blocked.capacity() == 0) map_.blocked.reserve(kRoom);
    map_.blocked.push_back(found);
  }

  void put_off(const Place& at, const BlockedCell& found, std::size_t first, std::size_t last) {
    if (put_off_.capacity() == 0) {
      put_off_.reserve(kRoom);
      put_off_pairs_.reserve(2 * kRoom);
    }
    const std::size_t begin = put_off_pairs_.size();
    put_off_pairs_.insert(put_off_pairs_.end(), open_.begin() + static_cast<std::ptrdiff_t>(first),
                          open_.begin() + static_cast<std::ptrdiff_t>(last));
    put_off_.push_back({panels_.size() - 1, at, found, begin, put_off_pairs_.size()});
  }

  void set_times(BlockedCell& c, const SampledMotion::Piece& a, const SampledMotion::Piece& b) const {
    const bool own_stands = panel_.own->depth() == 0;
    const bool other_stands = panel_.other->depth() == 0;
    c.tau0 = own_stands ? panel_.tau0 : a.t0;
    c.tau1 = own_stands ? panel_.tau1 : a.t1;
    c.t0 = other_stands ? panel_.t0 : b.t0;
    c.t1 = other_stands ? panel_.t1 : b.t1;
  }

  TimingMap& map_;
  double margin_;
  Panel panel_{};
  std::vector<Panel> panels_;  // examined so far
  bool closer_ = false;        // look at pieces smaller than the resolution too
  std::vector<Pair> open_;     // lists of the cells from the first one down to the one examined, one behind the other
  std::vector<PutOff> put_off_;
  std::vector<Pair> put_off_pairs_;
};

}  // namespace

TimingMap build_timing_map(SampledMotion& commanded, SampledMotion& moving, double margin) {
  TimingMap map;
  map.commanded_duration = commanded.motion().duration();
  map.moving_duration = moving.motion().duration();
  Subdivision subdivision{map, margin + commanded.robot().controller.path_error + moving.robot().controller.path_error};
  const double end = map.commanded_duration;
  const double other_end = map.moving_duration;
  SampledMotion& ended = commanded.at_end();
  if (moving.depth() == 0) {  // stands for good
    if (commanded.depth() > 0) subdivision.examine({&commanded, &moving, 0, end, -kNever, kNever});
    subdivision.examine({&ended, &moving, end, kNever, -kNever, kNever});
  } else {
    if (commanded.depth() > 0) {
      subdivision.examine({&commanded, &moving.at_start(), 0, end, -kNever, 0});
      subdivision.examine({&commanded, &moving, 0, end, 0, other_end});
      subdivision.examine({&commanded, &moving.at_end(), 0, end, other_end, kNever});
    }
    subdivision.examine({&ended, &moving.at_start(), end, kNever, -kNever, 0});
    subdivision.examine({&ended, &moving, end, kNever, 0, other_end});
    subdivision.examine({&ended, &moving.at_end(), end, kNever, other_end, kNever});
  }
  subdivision.finish();
  return map;
}

}  // namespace interlace::core
