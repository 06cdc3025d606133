#include "planner/core/timing_map.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>
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

/// Stands for all of the time before a motion, or after it, where times are counted [s].
constexpr double kBeyond = 2 * kBucket;

/// A part of the plane that two motions, or standing robots, make up; a standing robot's single piece stands for the times given.
struct Panel {
  SampledMotion* own;
  SampledMotion* other;
  double tau0, tau1, t0, t1;
};

/// What a map is asked for: a cell that can say nothing new about it is left out.
enum class Wanted : std::uint8_t {
  cells,   // all of them
  shifts,  // of starts, where both robots move
  times,   // of the moving robot
};

class Subdivision {
 public:
  Subdivision(TimingMap& map, SampledMotion& commanded, SampledMotion& moving, double margin, Wanted wanted, int coarser)
      : map_(map),
        wanted_(wanted),
        coarser_(coarser),
        commanded_stretch_(commanded.robot().controller.speed_error),
        moving_stretch_(moving.robot().controller.speed_error),
        margin_(margin + commanded.robot().controller.path_error + moving.robot().controller.path_error + kRounding) {
    if (wanted == Wanted::times) known_.emplace(-kBeyond, map.moving_duration + kBeyond, kBucket);
    if (wanted == Wanted::shifts && commanded.depth() > 0 && moving.depth() > 0) {
      known_.emplace(-map.commanded_duration * (1 + commanded_stretch_), map.moving_duration * (1 + moving_stretch_), kBucket);
    }
  }

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
    std::optional<ShiftCover> forbidden;
    if (!known_) {
      forbidden.emplace(-map_.commanded_duration, map_.moving_duration, kBucket);
      for (const BlockedCell& c : map_.blocked) {
        const ForbiddenShift shift = forbidden_shift(c, 0, 0);
        forbidden->add(shift.first, shift.last);
      }
    }
    for (const PutOff& p : put_off_) {
      const ForbiddenShift shift = forbidden_shift(p.found, 0, 0);
      if (wanted_ == Wanted::times || (forbidden && forbidden->holds(shift.first, shift.last))) {
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
    if (is_known(at)) return;
    model::CapsuleSet own = 0;
    model::CapsuleSet other = 0;
    for (std::size_t k = first; k < last; ++k) {
      own |= model::only_capsule(open_[k].own);
      other |= model::only_capsule(open_[k].other);
    }
    const SampledMotion::Piece& a = panel_.own->piece(at.own_level, at.own_index, own);
    const SampledMotion::Piece& b = panel_.other->piece(at.other_level, at.other_index, other);
    const bool at_resolution = at.own_level >= deepest(*panel_.own) && at.other_level >= deepest(*panel_.other);
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
    const bool own_splits = at.own_level < (at_resolution ? panel_.own->finest() : deepest(*panel_.own));
    const bool other_splits = at.other_level < (at_resolution ? panel_.other->finest() : deepest(*panel_.other));
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
    if (!leaves_out()) return;
    const auto [first, last] = says(found);
    known_->add(first, last);
  }

  /// Whether cells may be left out where `panel_` is.
  [[nodiscard]] bool leaves_out() const { return known_ && (wanted_ == Wanted::times || both_move()); }

  [[nodiscard]] int deepest(const SampledMotion& m) const { return std::max(m.depth() - coarser_, 0); }

  [[nodiscard]] bool both_move() const { return panel_.own->depth() > 0 && panel_.other->depth() > 0; }

  /// What a blocked cell says about what is wanted.
  [[nodiscard]] std::pair<double, double> says(const BlockedCell& c) const {
    if (wanted_ == Wanted::times) return {std::max(c.t0, -kBeyond), std::min(c.t1, map_.moving_duration + kBeyond)};
    const ForbiddenShift shift = forbidden_shift(c, commanded_stretch_, moving_stretch_);
    return {shift.first, shift.last};
  }

  /// Whether nothing that is found in a cell could say anything new.
  [[nodiscard]] bool is_known(const Place& at) {
    if (!leaves_out()) return false;
    const auto piece = [](double duration, int level, std::size_t index) {
      const double length = std::ldexp(duration, -level);
      return std::make_pair(length * static_cast<double>(index), length * static_cast<double>(index + 1));
    };
    BlockedCell all;
    std::tie(all.tau0, all.tau1) = piece(map_.commanded_duration, at.own_level, at.own_index);
    std::tie(all.t0, all.t1) =
        panel_.other->depth() == 0 ? std::make_pair(panel_.t0, panel_.t1) : piece(map_.moving_duration, at.other_level, at.other_index);
    const auto [first, last] = says(all);
    return known_->holds(first, last);
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
  Wanted wanted_;
  int coarser_;  // halvings fewer than down to the resolution
  double commanded_stretch_, moving_stretch_;
  double margin_;
  std::optional<ShiftCover> known_;  // what blocked cells have said so far; empty: all of them are wanted
  Panel panel_{};
  std::vector<Panel> panels_;  // examined so far
  bool closer_ = false;        // look at pieces smaller than the resolution too
  std::vector<Pair> open_;     // lists of the cells from the first one down to the one examined, one behind the other
  std::vector<PutOff> put_off_;
  std::vector<Pair> put_off_pairs_;
};

TimingMap build(SampledMotion& commanded, SampledMotion& moving, double margin, Wanted wanted, int coarser = 0) {
  TimingMap map;
  map.commanded_duration = commanded.motion().duration();
  map.moving_duration = moving.motion().duration();
  Subdivision subdivision{map, commanded, moving, margin, wanted, coarser};
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

}  // namespace

TimingMap build_timing_map(SampledMotion& commanded, SampledMotion& moving, double margin) {
  return build(commanded, moving, margin, Wanted::cells);
}

TimingMap build_shift_map(SampledMotion& commanded, SampledMotion& moving, double margin) {
  return build(commanded, moving, margin, Wanted::shifts);
}

TimesInTheWay times_in_the_way(SampledMotion& commanded, SampledMotion& moving, double margin, int coarser) {
  const TimingMap map = build(commanded, moving, margin, Wanted::times, coarser);
  TimesInTheWay result;
  result.evaluations = map.evaluations;
  for (const BlockedCell& c : map.blocked) result.times.emplace_back(c.t0, c.t1);
  std::sort(result.times.begin(), result.times.end());
  return result;
}

std::optional<double> TimesInTheWay::first_clear(double duration) const {
  constexpr double kMeet = 1e-9;  // [s]: the end of a piece and the beginning of the next one differ by their rounding
  double clear = 0;
  for (const auto& [from, until] : times) {
    if (from > clear + kMeet) break;
    clear = std::max(clear, until);
  }
  return clear > duration ? std::nullopt : std::optional{clear};
}

}  // namespace interlace::core
