#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

#include "common/model/segment_distance.hpp"
#include "common/model/time.hpp"
#include "tests/model/motions_seen.hpp"

namespace interlace::test {

/// A robot under way: which motion, and for how long already. Standing is having reached its end.
struct UnderWay {
  std::size_t motion = 0;
  model::Duration since{};

  friend bool operator<(const UnderWay& a, const UnderWay& b) { return std::tie(a.motion, a.since) < std::tie(b.motion, b.since); }
};

/// Clearances of robots from the motions they really carry out, with nothing of the planner's: its own paths, postures and distances.
class Judge {
 public:
  /// Between looks: with the arms below 1 m/s nothing gets nearer unseen than a centimetre.
  static constexpr model::Duration kLook = std::chrono::milliseconds{10};

  explicit Judge(const MotionsSeen& motions) : motions_(motions) {}

  /// Least clearance [m] of two robots that go on from `a` and `b` for `time`, both ends included.
  double least(const UnderWay& a, const UnderWay& b, model::Duration time) {
    const auto [entry, fresh] = known_.try_emplace({a, b, time}, std::numeric_limits<double>::infinity());
    if (!fresh) return entry->second;
    for (model::Duration t{}; t < time; t += kLook) entry->second = std::min(entry->second, clearance(a, b, t));
    return entry->second = std::min(entry->second, clearance(a, b, time));
  }

 private:
  double clearance(const UnderWay& a, const UnderWay& b, model::Duration later) {
    place(a, later, bodies_a_);
    place(b, later, bodies_b_);
    double least = std::numeric_limits<double>::infinity();
    for (const model::Capsule& c : bodies_a_) {
      for (const model::Capsule& d : bodies_b_) least = std::min(least, model::segment_distance(c.a, c.b, d.a, d.b) - c.radius - d.radius);
    }
    return least;
  }
  void place(const UnderWay& w, model::Duration later, std::vector<model::Capsule>& out) const {
    const model::Motion& motion = *motions_[w.motion];
    model::place_capsules(motion.robot().model, motion.robot().X_WB, motion.joints(model::to_seconds(w.since + later)), out);
  }

  const MotionsSeen& motions_;
  std::map<std::tuple<UnderWay, UnderWay, model::Duration>, double> known_;
  std::vector<model::Capsule> bodies_a_, bodies_b_;
};

}  // namespace interlace::test
