#include <gtest/gtest.h>

#include <cstdio>
#include <vector>

#include "planner/core/start_windows.hpp"
#include "tests/support/seed.hpp"

/// The dissertation's appendix B joins two ranges of blocked times that do not touch: the time between them counts as blocked for nothing.
namespace interlace::test {
namespace {

using core::Duration;
using core::Instant;
using core::StartInterval;

struct Range {
  int min = 0, max = 0;
};

/// Appendix B as published: six patterns tried in order, the first two without the condition that the ranges meet.
std::vector<Range> published_union(const Range& a, const Range& b) {
  if (a.min <= b.min && a.max <= b.max) return {{a.min, b.max}};
  if (a.min >= b.min && a.max >= b.max) return {{b.min, a.max}};
  if (a.min >= b.min && a.max <= b.max) return {b};
  if (a.min <= b.min && a.max >= b.max) return {a};
  if (a.max < b.min) return {a, b};
  return {b, a};
}

StartInterval interval(const Range& r) {
  return {Instant{Duration{r.min}}, Instant{Duration{r.max}}};
}

TEST(RangeUnion, AppendixBMergesRangesThatDoNotTouch) {
  const Range early{1, 2};
  const Range late{8, 9};
  EXPECT_EQ(published_union(early, late).size(), 1U) << "pattern 1 hides pattern 5";
  EXPECT_EQ(published_union(late, early).size(), 1U) << "pattern 2 hides pattern 6";
  for (const auto& ranges : {std::vector<StartInterval>{interval(early), interval(late)}, {interval(late), interval(early)}}) {
    const auto ours = core::united(ranges);
    ASSERT_EQ(ours.size(), 2U);
    EXPECT_EQ(ours[0].from, interval(early).from);
    EXPECT_EQ(ours[0].until, interval(early).until);
    EXPECT_EQ(ours[1].from, interval(late).from);
    EXPECT_EQ(ours[1].until, interval(late).until);
    EXPECT_EQ(core::complement(ours, interval(early).until)[0].until, interval(late).from) << "the gap between them can be used";
  }
}

TEST(RangeUnion, AppendixBNeverFindsTwoRanges) {
  Seed seed{72};
  int apart = 0;
  for (int i = 0; i < 100000; ++i) {
    const auto random = [&] {
      const int min = static_cast<int>(seed.below(100));
      return Range{min, min + static_cast<int>(seed.below(20))};
    };
    const Range a = random();
    const Range b = random();
    EXPECT_EQ(published_union(a, b).size(), 1U);
    const bool meet = a.min <= b.max && b.min <= a.max;
    EXPECT_EQ(core::united({interval(a), interval(b)}).size(), meet ? 1U : 2U);
    apart += meet ? 0 : 1;
  }
  std::printf("%d of 100000 pairs of ranges lie apart; appendix B joins every one of them\n", apart);
  EXPECT_GT(apart, 0);
}

}  // namespace
}  // namespace interlace::test
