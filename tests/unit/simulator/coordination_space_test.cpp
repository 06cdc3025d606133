#include "simulator/coordination_space.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "tests/support/seed.hpp"

/// The least time of two and three robots on a lattice: cases with known answers, and all schedules of small ones tried out.
namespace interlace::test {
namespace {

using sim::Crossing;
using sim::PairSpace;
using sim::Track;

TEST(CoordinationSpace, NobodyInTheWayNobodyWaits) {
  const PairSpace space{Track{{0, 2, 5}}, Track{{0, 4}}, {}, 0.5};
  EXPECT_EQ(space.to_go(0, 0), 10);
}

TEST(CoordinationSpace, WhoMayNotMoveTogetherGoesOneAfterTheOther) {
  Crossing crossing;
  crossing.moving.push_back({0, 0, {-0.5, 2}});
  EXPECT_EQ(PairSpace(Track{{0, 2}}, Track{{0, 1}}, crossing, 0.25).to_go(0, 0), 10) << "b goes half a second ahead";
  crossing.a_stands.push_back({0, {0.25, 0.5}});
  EXPECT_EQ(PairSpace(Track{{0, 2}}, Track{{0, 1}}, crossing, 0.25).to_go(0, 0), 12) << "b cannot pass before a has left";
  crossing.a_stands.push_back({1, {0.5, 0.75}});
  EXPECT_EQ(PairSpace(Track{{0, 2}}, Track{{0, 1}}, crossing, 0.25).to_go(0, 0), PairSpace::kNever) << "nor after it";
}

TEST(CoordinationSpace, TwoGoalsThatMeetLeaveNoWay) {
  Crossing crossing;
  crossing.a_stands.push_back({1, {1, 1}});
  EXPECT_EQ(PairSpace(Track{{0, 1}}, Track{{0, 1}}, crossing, 0.1).to_go(0, 0), PairSpace::kNever);
}

/// A small random case, whole numbers as times, and every way to wait.
struct Tiny {
  Tiny(Seed& seed, std::size_t robots, std::size_t motions) : tracks(robots) {
    for (Track& t : tracks) {
      for (std::size_t k = 0; k < motions; ++k) t.stops.push_back(t.stops.back() + std::floor(seed.uniform(1, 4)));
    }
    for (std::size_t i = 0; i < robots; ++i) {
      for (std::size_t j = i + 1; j < robots; ++j) crossings.push_back(random_crossing(seed, tracks[i], tracks[j]));
    }
  }

  static Crossing random_crossing(Seed& seed, const Track& a, const Track& b) {
    Crossing c;
    for (std::size_t i = 0; i + 1 < a.stops.size(); ++i) {
      for (std::size_t j = 0; j + 1 < b.stops.size(); ++j) {
        const double from = std::floor(seed.uniform(-4, 4)) - 0.5;
        if (seed.chance(0.5)) c.moving.push_back({i, j, {from, from + std::floor(seed.uniform(1, 4))}});
      }
    }
    const auto stand = [&](const Track& standing, const Track& moving, std::vector<Crossing::Standing>& out) {
      for (std::size_t s = 0; s < standing.stops.size(); ++s) {
        const double from = std::floor(seed.uniform(0, moving.stops.back()));
        if (seed.chance(0.3)) out.push_back({s, {from, from + 1}});
        const double stop = moving.stops[1 + static_cast<std::size_t>(seed.uniform(0, static_cast<double>(moving.stops.size() - 1)))];
        if (seed.chance(0.1)) out.push_back({s, {stop, stop}});
      }
    };
    stand(a, b, c.a_stands);
    stand(b, a, c.b_stands);
    return c;
  }

  /// Everybody's progress step by step for given waits before each motion.
  [[nodiscard]] std::vector<double> progress(std::size_t robot, const std::vector<int>& waits) const {
    std::vector<double> p{0};
    for (std::size_t k = 0; k + 1 < tracks[robot].stops.size(); ++k) {
      p.insert(p.end(), static_cast<std::size_t>(waits[k]), p.back());
      for (double x = tracks[robot].stops[k] + 1; x <= tracks[robot].stops[k + 1]; ++x) p.push_back(x);
    }
    return p;
  }

  static bool meet(const Crossing& c, const Track& a, const Track& b, const std::vector<double>& pa, const std::vector<double>& pb) {
    const auto at = [](const std::vector<double>& p, std::size_t t) { return p[std::min(t, p.size() - 1)]; };
    const auto stop_at = [](const Track& track, std::size_t stop, double p) { return track.stops[stop] == p; };
    for (std::size_t t = 0; t < std::max(pa.size(), pb.size()); ++t) {
      const double a0 = at(pa, t), a1 = at(pa, t + 1), b0 = at(pb, t), b1 = at(pb, t + 1);
      for (const auto& m : c.moving) {
        if (a0 == a1 || b0 == b1 || a0 < a.stops[m.a] || a1 > a.stops[m.a + 1] || b0 < b.stops[m.b] || b1 > b.stops[m.b + 1]) continue;
        const double shift = (a0 - a.stops[m.a]) - (b0 - b.stops[m.b]);
        if (shift > m.shift.from && shift < m.shift.until) return true;
      }
      const auto touches = [](const sim::Span& s, double x0, double x1) {
        return s.from == s.until ? x0 == s.from : x0 < s.until && x1 > s.from && x0 != x1;
      };
      for (const auto& s : c.a_stands) {
        const bool point = s.other.from == s.other.until;
        if (stop_at(a, s.stop, a0) && (point || a0 == a1) && touches(s.other, b0, b1)) return true;
      }
      for (const auto& s : c.b_stands) {
        const bool point = s.other.from == s.other.until;
        if (stop_at(b, s.stop, b0) && (point || b0 == b1) && touches(s.other, a0, a1)) return true;
      }
    }
    return false;
  }

  /// Least steps over all waits of up to `longest` steps; empty: none of them works.
  [[nodiscard]] std::optional<std::size_t> brute_force(int longest) const {
    std::vector<std::vector<std::vector<double>>> ways(tracks.size());
    for (std::size_t r = 0; r < tracks.size(); ++r) {
      std::vector<int> waits(tracks[r].stops.size() - 1, 0);
      std::function<void(std::size_t)> choose = [&](std::size_t k) {
        if (k == waits.size()) return ways[r].push_back(progress(r, waits));
        for (waits[k] = 0; waits[k] <= longest; ++waits[k]) choose(k + 1);
      };
      choose(0);
    }
    std::optional<std::size_t> least;
    std::vector<const std::vector<double>*> chosen;
    std::function<void()> extend = [&] {
      const std::size_t r = chosen.size();
      if (r == tracks.size()) {
        std::size_t steps = 0;
        for (const auto* p : chosen) steps = std::max(steps, p->size() - 1);
        least = std::min(least.value_or(steps), steps);
        return;
      }
      for (const auto& way : ways[r]) {
        if (least && way.size() - 1 >= *least) continue;
        bool clear = true;
        for (std::size_t other = 0; other < r && clear; ++other) {
          clear = !meet(crossings[pair(other, r)], tracks[other], tracks[r], *chosen[other], way);
        }
        if (!clear) continue;
        chosen.push_back(&way);
        extend();
        chosen.pop_back();
      }
    };
    extend();
    return least;
  }

  [[nodiscard]] std::size_t pair(std::size_t i, std::size_t j) const { return i == 0 ? j - 1 : tracks.size() - 2 + j - i; }

  std::vector<Track> tracks;
  std::vector<Crossing> crossings;  // 01, 02, 12
};

TEST(CoordinationSpace, TwoRobotsAsAllTheirSchedulesTried) {
  Seed seed;
  int without = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const Tiny tiny{seed, 2, 2};
    const PairSpace space{tiny.tracks[0], tiny.tracks[1], tiny.crossings[0], 1};
    const auto least = tiny.brute_force(8);
    without += least ? 0 : 1;
    ASSERT_EQ(space.to_go(0, 0), least ? *least : PairSpace::kNever) << "trial " << trial;
  }
  EXPECT_GT(without, 10);
  EXPECT_LT(without, 250);
}

TEST(CoordinationSpace, ThreeRobotsAsAllTheirSchedulesTried) {
  Seed seed;
  int more_than_pairs = 0;
  for (int trial = 0; trial < 150; ++trial) {
    const Tiny tiny{seed, 3, 2};
    std::vector<PairSpace> pairs;
    pairs.emplace_back(tiny.tracks[0], tiny.tracks[1], tiny.crossings[0], 1);
    pairs.emplace_back(tiny.tracks[0], tiny.tracks[2], tiny.crossings[1], 1);
    pairs.emplace_back(tiny.tracks[1], tiny.tracks[2], tiny.crossings[2], 1);
    const auto found = sim::least_steps(tiny.tracks, pairs, 1, 1'000'000);
    ASSERT_TRUE(found.complete);
    const auto least = tiny.brute_force(6);
    // Longer waits than were tried may still find a way.
    if (!least) continue;
    ASSERT_TRUE(found.steps) << "trial " << trial;
    ASSERT_LE(*found.steps, *least) << "trial " << trial;
    if (*least <= 12) {
      ASSERT_EQ(*found.steps, *least) << "trial " << trial;
    }
    const auto of_pairs = std::max({pairs[0].to_go(0, 0), pairs[1].to_go(0, 0), pairs[2].to_go(0, 0)});
    more_than_pairs += *found.steps > of_pairs ? 1 : 0;
  }
  EXPECT_GT(more_than_pairs, 5) << "some cases must be more than their pairs";
}

TEST(CoordinationSpace, WhoGivesUpSaysNoMoreThanABound) {
  Seed seed;
  for (;;) {
    const Tiny tiny{seed, 3, 2};
    std::vector<PairSpace> pairs;
    pairs.emplace_back(tiny.tracks[0], tiny.tracks[1], tiny.crossings[0], 1);
    pairs.emplace_back(tiny.tracks[0], tiny.tracks[2], tiny.crossings[1], 1);
    pairs.emplace_back(tiny.tracks[1], tiny.tracks[2], tiny.crossings[2], 1);
    const auto whole = sim::least_steps(tiny.tracks, pairs, 1, 1'000'000);
    const auto bound = sim::least_steps(tiny.tracks, pairs, 1, 2);
    if (!whole.steps || bound.complete) continue;
    EXPECT_LE(*bound.steps, *whole.steps);
    break;
  }
}

}  // namespace
}  // namespace interlace::test
