#include "planner/core/start_windows.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/support/seed.hpp"

namespace interlace::test {
namespace {

using core::BlockedCell;
using core::Duration;
using core::Instant;
using core::kNever;
using core::StartInterval;
using core::TimingMap;

constexpr std::size_t kSets = 20000;
constexpr int kTicks =
    200;  // half nanoseconds are free between them, so a bitmap of whole ones and the gaps between tells open from closed

constexpr double kRounding = 3e-9;  // [s] instants are whole nanoseconds

Instant tick(std::int64_t ns) {
  return Instant{Duration{ns}};
}

/// Places 2·i are the instants, 2·i + 1 the open gaps between neighbours.
std::vector<bool> bitmap(const std::vector<StartInterval>& intervals) {
  std::vector<bool> bits(2 * kTicks + 1);
  for (const auto& [from, until] : intervals) {
    const std::int64_t first = from == model::kEarliest ? 0 : std::max<std::int64_t>(0, from.time_since_epoch().count());
    const std::int64_t last = until == model::kForever ? kTicks : std::min<std::int64_t>(kTicks, until.time_since_epoch().count());
    for (std::int64_t i = 2 * first; i <= 2 * last; ++i) bits[static_cast<std::size_t>(i)] = true;
  }
  return bits;
}

std::vector<StartInterval> random_intervals(Seed& seed) {
  std::vector<StartInterval> intervals(seed.below(12));
  for (auto& interval : intervals) {
    const auto from = static_cast<std::int64_t>(seed.below(kTicks - 3));
    const auto length = static_cast<std::int64_t>(2 + seed.below(seed.chance(0.5) ? 4 : 40));  // rounded outward, so never a single instant
    interval = {tick(from), tick(std::min<std::int64_t>(from + length, kTicks - 1))};
    if (seed.chance(0.03)) interval.from = model::kEarliest;
    if (seed.chance(0.03)) interval.until = model::kForever;
  }
  return intervals;
}

TEST(StartWindows, UnionCoversExactlyWhatItsPartsCover) {
  Seed seed{51};
  for (std::size_t k = 0; k < scaled(kSets) && !HasFailure(); ++k) {
    const auto parts = random_intervals(seed);
    const auto whole = core::united(parts);
    EXPECT_EQ(bitmap(parts), bitmap(whole));
    for (std::size_t i = 1; i < whole.size(); ++i) EXPECT_GT(whole[i].from, whole[i - 1].until) << "parts that touch are one";
  }
}

TEST(StartWindows, ComplementIsWhatNoForbiddenIntervalHoldsInside) {
  Seed seed{52};
  for (std::size_t k = 0; k < scaled(kSets) && !HasFailure(); ++k) {
    const auto forbidden = core::united(random_intervals(seed));
    const auto earliest = tick(static_cast<std::int64_t>(seed.below(kTicks)));
    const auto windows = core::complement(forbidden, earliest);
    const auto blocked = bitmap(forbidden);
    const auto free = bitmap(windows);
    const auto begin = static_cast<std::size_t>(2 * earliest.time_since_epoch().count());
    for (std::size_t i = 0; i < free.size(); ++i) {
      if (i < begin) {
        EXPECT_FALSE(free[i]);
      } else if (!blocked[i]) {
        EXPECT_TRUE(free[i]) << "place " << i;
      } else if (free[i]) {
        // Only as the closed end of a window: forbidden intervals are rounded outward, so their very ends are clear.
        EXPECT_TRUE(i % 2 == 0 && ((i > 0 && !blocked[i - 1]) || (i + 1 < blocked.size() && !blocked[i + 1]))) << "place " << i;
      }
    }
    for (std::size_t i = 1; i < windows.size(); ++i) EXPECT_GT(windows[i].from, windows[i - 1].until);
  }
}

TEST(StartWindows, NothingForbiddenLeavesEverythingFromTheEarliest) {
  const auto windows = core::complement({}, tick(5));
  ASSERT_EQ(windows.size(), 1U);
  EXPECT_EQ(windows[0].from, tick(5));
  EXPECT_EQ(windows[0].until, model::kForever);
  EXPECT_TRUE(core::complement({{model::kEarliest, model::kForever}}, tick(5)).empty());
}

/// A random map: cells inside both motions, before and after them.
TimingMap random_map(Seed& seed) {
  TimingMap map;
  map.commanded_duration = seed.uniform(0.5, 5);
  map.moving_duration = seed.uniform(0.5, 5);
  const std::size_t cells = 1 + seed.below(5);
  for (std::size_t i = 0; i < cells; ++i) {
    BlockedCell c;
    c.t0 = seed.uniform(0, map.moving_duration);
    c.t1 = seed.uniform(c.t0, map.moving_duration);
    c.tau0 = seed.uniform(0, map.commanded_duration);
    c.tau1 = seed.uniform(c.tau0, map.commanded_duration);
    if (seed.chance(0.1)) c = {-kNever, 0, c.tau0, c.tau1, 0, 0, 0, 0};
    if (seed.chance(0.1)) c = {map.moving_duration, kNever, c.tau0, c.tau1, 0, 0, 0, 0};
    if (seed.chance(0.1)) c = {c.t0, c.t1, map.commanded_duration, kNever, 0, 0, 0, 0};
    map.blocked.push_back(c);
  }
  return map;
}

/// Does a commanded robot that starts at `own` [s] ever be in a blocked cell while the other one starts at `other`? Both stretched.
bool meets(const TimingMap& map, double own, double own_stretch, double other, double other_stretch) {
  for (const BlockedCell& c : map.blocked) {
    // Absolute times at which each robot is inside the cell's sides.
    const double own0 = own + c.tau0 * own_stretch;
    const double own1 = own + c.tau1 * own_stretch;
    const double other0 = other + c.t0 * other_stretch;
    const double other1 = other + c.t1 * other_stretch;
    if (own0 + kRounding < other1 && other0 + kRounding < own1) return true;
  }
  return false;
}

TEST(StartWindows, ForbidEveryStartThatCouldMeetABlockedCell) {
  Seed seed{53};
  std::size_t tried = 0;
  std::size_t clear = 0;
  for (std::size_t k = 0; k < scaled(kSets) && !HasFailure(); ++k) {
    const TimingMap map = random_map(seed);
    core::StartUncertainty u;
    const double from = seed.uniform(-3, 3);
    const double until = seed.chance(0.5) ? from : from + seed.uniform(0, 0.3);
    u.moving_from = model::at_seconds(from);
    u.moving_until = model::at_seconds(until);
    u.moving_stretch = seed.chance(0.5) ? 0 : seed.uniform(0, 0.05);
    u.commanded_stretch = seed.chance(0.5) ? 0 : seed.uniform(0, 0.05);
    const double tolerance = seed.chance(0.5) ? 0 : seed.uniform(0, 0.2);
    u.commanded_tolerance = model::from_seconds(tolerance);
    std::vector<StartInterval> intervals;
    for (const auto& f : core::forbidden_starts(map, u)) intervals.push_back(f.interval);
    const auto windows = core::complement(core::united(intervals), model::at_seconds(-12));
    // Every start in a window is clear, whatever happens inside the uncertainty …
    for (const StartInterval& w : windows) {
      const double last = w.until == model::kForever ? model::to_seconds(w.from) + 30 : model::to_seconds(w.until);
      for (int i = 0; i < 5; ++i) {
        const double start = i == 0 ? model::to_seconds(w.from) : i == 1 ? last : seed.uniform(model::to_seconds(w.from), last);
        const double real_start = start + (seed.chance(0.3) ? tolerance : seed.uniform(0, 1) * tolerance);
        const double own_stretch = 1 + u.commanded_stretch * (seed.chance(0.5) ? (seed.chance(0.5) ? 1 : -1) : seed.uniform(-1, 1));
        const double other_stretch = 1 + u.moving_stretch * (seed.chance(0.5) ? (seed.chance(0.5) ? 1 : -1) : seed.uniform(-1, 1));
        const double other = seed.chance(0.5) ? (seed.chance(0.5) ? from : until) : seed.uniform(from, until);
        EXPECT_FALSE(meets(map, real_start, own_stretch, other, other_stretch)) << "start " << real_start << " in a window";
        ++tried;
      }
    }
    // … and nothing more than that is forbidden: with no uncertainty, a start outside the windows meets a cell (but for a few nanoseconds).
    if (from == until && u.moving_stretch == 0 && u.commanded_stretch == 0 && tolerance == 0) {
      for (int i = 0; i < 20; ++i) {
        const double start = seed.uniform(-12, 12);
        const bool allowed = std::any_of(windows.begin(), windows.end(), [&](const StartInterval& w) {
          return w.from <= model::at_seconds(start) && model::at_seconds(start) <= w.until;
        });
        const bool near_border =
            meets(map, start - 9e-9, 1, from, 1) || meets(map, start + 9e-9, 1, from, 1) || meets(map, start, 1, from, 1);
        EXPECT_TRUE(allowed || near_border) << "start " << start << " is forbidden for nothing";
        clear += allowed ? 1 : 0;
      }
    }
  }
  std::printf("%zu starts inside windows, %zu of the others' trials were free\n", tried, clear);
}

}  // namespace
}  // namespace interlace::test
