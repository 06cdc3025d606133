#include <gtest/gtest.h>

#include "planner/core/journal.hpp"
#include "tests/unit/core/desk.hpp"

// The planner's calls, numbered and put into messages; and the decisions that come of them when they are made again.
namespace interlace::test {
namespace {

model::PlannerJournal head() {
  model::PlannerJournal h;
  h.cell = "cell";
  h.incarnation = 7;
  return h;
}

TEST(JournalKeeper, NumbersCallsAndLeavesNoneOut) {
  core::JournalKeeper keeper{head()};
  EXPECT_TRUE(keeper.empty());
  EXPECT_FALSE(keeper.take());
  constexpr std::size_t kCalls = 1000;
  for (std::size_t i = 0; i < kCalls; ++i) keeper.note(model::at_seconds(static_cast<double>(i)), model::TimePassed{}, {});
  EXPECT_TRUE(keeper.full());
  std::uint64_t next = 0;
  while (const auto message = keeper.take()) {
    EXPECT_EQ(message->first, next);
    EXPECT_EQ(message->incarnation, 7);
    EXPECT_LE(message->calls.size(), core::JournalKeeper::kMostCalls);
    for (const auto& call : message->calls) EXPECT_EQ(call.now, model::at_seconds(static_cast<double>(next++)));
  }
  EXPECT_EQ(next, kCalls);
  keeper.note({}, model::TimePassed{}, {});
  EXPECT_FALSE(keeper.full());
  EXPECT_EQ(keeper.take()->first, kCalls);
}

TEST(JournalKeeper, GivesLargeRequestsAMessageOfTheirOwn) {
  core::JournalKeeper keeper{head()};
  model::QueueReplaced replaced;
  replaced.commands.resize(100);
  for (int i = 0; i < 3; ++i) keeper.note({}, model::ClientRequest{replaced}, {});
  for (int i = 0; i < 3; ++i) EXPECT_EQ(keeper.take()->calls.size(), 1);
  EXPECT_TRUE(keeper.empty());
}

TEST(DecisionDigest, IsAnotherWhenAnythingIsDecidedOtherwise) {
  core::Decisions d;
  d.dispatches.resize(1);
  d.statuses.resize(1);
  const auto before = core::digest_of(d);
  EXPECT_EQ(core::digest_of(d), before);
  const auto differs = [&](const auto& change) {
    core::Decisions other = d;
    change(other);
    return core::digest_of(other) != before;
  };
  EXPECT_TRUE(differs([](auto& o) { o.dispatches[0].earliest += 1ns; }));
  EXPECT_TRUE(differs([](auto& o) { o.dispatches[0].duration = std::nextafter(0.0, 1.0); }));
  EXPECT_TRUE(differs([](auto& o) { o.dispatches[0].duration = -0.0; }));
  EXPECT_TRUE(differs([](auto& o) { o.dispatches[0].motion.velocity = 0.1; }));
  EXPECT_TRUE(differs([](auto& o) { o.dispatches[0].holds.emplace_back("long"); }));
  EXPECT_TRUE(differs([](auto& o) { o.statuses[0].text = "x"; }));
  EXPECT_TRUE(differs([](auto& o) { o.statuses[0].conflicts.resize(1); }));
  EXPECT_TRUE(differs([](auto& o) { o.statuses[0].deadline = Instant{}; }));
  EXPECT_TRUE(differs([](auto& o) { o.statuses[0].verdict = model::DeadlineVerdict::late; }));
  EXPECT_TRUE(differs([](auto& o) { o.withdrawals.resize(1); }));
}

}  // namespace
}  // namespace interlace::test
