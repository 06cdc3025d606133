#include "app_client/ledger.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <map>
#include <random>

namespace interlace::client {
namespace {

using namespace std::chrono_literals;
using model::CommandId;
using model::CommandState;
using model::Reason;
using model::RobotName;

constexpr std::uint64_t kPlanner = 7;
constexpr std::uint64_t kNextPlanner = 8;
const LocalTime kStart{1h};

model::CommandSubmitted command(const std::string& id, const std::string& robot = "r1") {
  model::CommandSubmitted c;
  c.id = CommandId{id};
  c.robot = RobotName{robot};
  return c;
}

model::CommandStatus status(const std::string& id, CommandState state, const std::string& robot = "r1") {
  model::CommandStatus s;
  s.id = CommandId{id};
  s.robot = RobotName{robot};
  s.state = state;
  return s;
}

std::vector<std::string> ids(const std::vector<Request>& requests) {
  std::vector<std::string> out;
  for (const auto& r : requests) {
    const std::string prefix = std::holds_alternative<model::CommandCancelled>(r) ? "cancel " : "";
    out.push_back(prefix + std::visit([](const auto& x) { return x.id.str(); }, r));
  }
  return out;
}

using Ids = std::vector<std::string>;

/// A ledger that has just heard of a planner.
class LedgerTest : public ::testing::Test {
 protected:
  LedgerTest() { alive(kStart); }
  void alive(LocalTime now) { ledger.on_planner(kPlanner, now); }
  [[nodiscard]] const model::CommandStatus& known(const std::string& id) const { return ledger.find(CommandId{id})->status; }
  [[nodiscard]] Ids due(LocalTime now) { return ids(ledger.due(now)); }
  void told(const std::string& id, CommandState state, LocalTime now) { ledger.on_status(kPlanner, status(id, state), now); }

  Ledger ledger;
};

TEST_F(LedgerTest, NothingIsSentBeforeAPlannerIsHeard) {
  Ledger deaf;
  deaf.submit(command("a"));
  EXPECT_TRUE(deaf.due(kStart).empty());
  EXPECT_EQ(deaf.next_due(), std::nullopt);
  deaf.on_planner(kPlanner, kStart + 1s);
  EXPECT_EQ(ids(deaf.due(kStart + 1s)), Ids{"a"});
}

TEST_F(LedgerTest, OneUnansweredCommandPerRobotSoThatOrderHolds) {
  for (const char* id : {"a", "b", "c"}) ledger.submit(command(id));
  ledger.submit(command("x", "r2"));
  EXPECT_EQ(due(kStart), (Ids{"a", "x"}));
  EXPECT_EQ(due(kStart + 1ms), Ids{});
  told("a", CommandState::queued, kStart + 2ms);
  EXPECT_EQ(due(kStart + 2ms), Ids{"b"});
  EXPECT_EQ(ledger.open(RobotName{"r1"}), 3u);
  EXPECT_EQ(ledger.open(), 4u);
}

TEST_F(LedgerTest, AnUnansweredCommandIsSentAgainUnderItsIdUntilItIsLost) {
  ledger.submit(command("a"));
  ledger.submit(command("b"));
  int sent = 0;
  LocalTime now = kStart;
  for (; ledger.open() > 0 && now < kStart + 20s; now += 100ms) {
    alive(now);
    for (const auto& id : due(now)) {
      EXPECT_EQ(id, "a");
      ++sent;
    }
  }
  EXPECT_EQ(sent, 20);  // every 0.5 s for 10 s
  EXPECT_EQ(known("a").state, CommandState::failed);
  EXPECT_EQ(known("a").text, "the planner did not answer within 10 s; whether it is carried out is not known");
  EXPECT_EQ(known("b").state, CommandState::failed);
  EXPECT_EQ(known("b").text, "not sent: a command before it was lost");
  EXPECT_FALSE(ledger.find(CommandId{"a"})->told);
}

TEST_F(LedgerTest, TheSameIdIsTakenOnce) {
  EXPECT_TRUE(ledger.submit(command("a")));
  EXPECT_FALSE(ledger.submit(command("a")));
  EXPECT_EQ(due(kStart), Ids{"a"});
}

TEST_F(LedgerTest, SilenceAboutTheFirstInLineIsAskedAbout) {
  ledger.submit(command("a"));
  ledger.submit(command("b"));
  (void)due(kStart);
  told("a", CommandState::started, kStart);
  (void)due(kStart);
  told("b", CommandState::queued, kStart);
  alive(kStart + 4900ms);
  EXPECT_EQ(due(kStart + 4900ms), Ids{});
  EXPECT_EQ(ledger.next_due(), kStart + 5s);
  EXPECT_EQ(due(kStart + 5s), Ids{"a"}) << "b has every reason to be silent";
  told("a", CommandState::completed, kStart + 5s);
  EXPECT_EQ(due(kStart + 5s), Ids{"b"}) << "now b is the one that should be heard of";
}

TEST_F(LedgerTest, NothingIsSentAgainToASilentPlanner) {
  ledger.submit(command("a"));
  (void)due(kStart);
  EXPECT_EQ(due(kStart + 3s), Ids{});
  alive(kStart + 3s);
  EXPECT_EQ(due(kStart + 3s), Ids{"a"});
}

TEST_F(LedgerTest, AnotherPlannerLosesEverythingAndNothingIsSubmittedToIt) {
  for (const char* id : {"told", "asked", "unsent"}) ledger.submit(command(id));
  (void)due(kStart);
  told("told", CommandState::started, kStart);
  (void)due(kStart);
  (void)ledger.take_news();
  ASSERT_TRUE(ledger.on_planner(kNextPlanner, kStart + 1s));
  EXPECT_EQ(due(kStart + 10s), Ids{});
  EXPECT_EQ(ledger.open(), 0u);
  const auto news = ledger.take_news();
  ASSERT_EQ(news.size(), 3u);
  for (const Answer& a : news) {
    EXPECT_EQ(a.status.state, CommandState::failed);
    EXPECT_EQ(a.status.reason, Reason::unknown_id);
    EXPECT_FALSE(a.told);
  }
  EXPECT_EQ(known("told").text, "the planner was restarted; whether this was carried out is not known");
  EXPECT_EQ(known("asked").text, known("told").text);
  EXPECT_EQ(known("unsent").text, "not sent: a command before it was lost");
  // News of the planner that is gone are old news; the new one takes new commands.
  told("told", CommandState::completed, kStart + 2s);
  EXPECT_EQ(known("told").state, CommandState::failed);
  ledger.submit(command("new"));
  EXPECT_EQ(ids(ledger.due(kStart + 2s)), Ids{"new"});
}

TEST_F(LedgerTest, AStatusAloneShowsThatThePlannerIsAnother) {
  ledger.submit(command("a"));
  (void)due(kStart);
  ledger.on_status(kNextPlanner, status("other", CommandState::queued), kStart);
  EXPECT_EQ(known("a").state, CommandState::failed);
  EXPECT_FALSE(ledger.on_planner(kPlanner, kStart)) << "replaced planners do not come back";
}

TEST_F(LedgerTest, CancellationsGoOutInTheOrderTheyWereAskedFor) {
  LocalTime now = kStart;
  for (const char* id : {"1", "2", "3"}) {
    ledger.submit(command(id));
    ASSERT_EQ(due(now), Ids{id});
    told(id, CommandState::queued, now);
  }
  for (const char* id : {"3", "1", "2"}) ledger.cancel(RobotName{"r1"}, CommandId{id});
  EXPECT_EQ(due(now), (Ids{"cancel 3", "cancel 1", "cancel 2"}));
}

TEST_F(LedgerTest, OnlyNewsAreNews) {
  ledger.submit(command("a"));
  (void)due(kStart);
  told("a", CommandState::queued, kStart);
  told("a", CommandState::queued, kStart);
  EXPECT_EQ(ledger.take_news().size(), 1u);
  told("a", CommandState::completed, kStart);
  told("a", CommandState::failed, kStart);
  EXPECT_EQ(ledger.take_news().size(), 1u) << "final is final";
  EXPECT_EQ(known("a").state, CommandState::completed);
}

TEST_F(LedgerTest, OthersCommandsArePassedOnAsSuch) {
  told("escape", CommandState::started, kStart);
  const auto news = ledger.take_news();
  ASSERT_EQ(news.size(), 1u);
  EXPECT_FALSE(news[0].own);
  EXPECT_EQ(ledger.find(CommandId{"escape"}), nullptr);
}

TEST_F(LedgerTest, EscapesArePassedOnAndLeaveTheOwnCommandsAlone) {
  ledger.submit(command("a"));
  ASSERT_EQ(due(kStart), Ids{"a"});
  told("a", CommandState::waiting, kStart);
  (void)ledger.take_news();
  auto escape = status("escape-7-1", CommandState::scheduled, "r2");
  escape.escape = true;
  escape.serves = CommandId{"a"};
  for (const auto state : {CommandState::scheduled, CommandState::started, CommandState::completed}) {
    escape.state = state;
    ledger.on_status(kPlanner, escape, kStart + 1ms);
  }
  const auto news = ledger.take_news();
  ASSERT_EQ(news.size(), 3u);
  for (const Answer& answer : news) {
    EXPECT_FALSE(answer.own);
    EXPECT_TRUE(answer.told);
    EXPECT_EQ(answer.status.serves.str(), "a");
  }
  EXPECT_EQ(ledger.open(), 1u);
  EXPECT_EQ(ledger.find(escape.id), nullptr);
}

TEST_F(LedgerTest, CancelOfAnEscapeIsAnsweredByAnyNewsOfIt) {
  ledger.cancel(RobotName{"r2"}, CommandId{"escape-7-1"});
  ASSERT_EQ(due(kStart), Ids{"cancel escape-7-1"});
  auto escape = status("escape-7-1", CommandState::waiting, "r2");
  escape.escape = true;
  ledger.on_status(kPlanner, escape, kStart + 1ms);
  EXPECT_TRUE(known("escape-7-1").escape);
  EXPECT_EQ(due(kStart + 1h), Ids{});
}

TEST_F(LedgerTest, OtherRefusalsOfADeadlockAreNews) {
  ledger.submit(command("a"));
  (void)due(kStart);
  auto deadlock = status("a", CommandState::waiting);
  deadlock.reason = Reason::deadlock;
  deadlock.refusals = {{RobotName{"r2"}, model::EscapeWay::home, "it is at home"}};
  ledger.on_status(kPlanner, deadlock, kStart);
  ledger.on_status(kPlanner, deadlock, kStart);
  EXPECT_EQ(ledger.take_news().size(), 1u);
  deadlock.refusals[0].text = "r3 stands there";
  ledger.on_status(kPlanner, deadlock, kStart);
  EXPECT_EQ(ledger.take_news().size(), 1u);
}

TEST_F(LedgerTest, CancelBeforeItWasSentIsFinalOnTheSpot) {
  ledger.submit(command("a"));
  ledger.submit(command("b"));
  (void)due(kStart);
  ledger.cancel(RobotName{"r1"}, CommandId{"b"});
  EXPECT_EQ(known("b").state, CommandState::cancelled);
  told("a", CommandState::queued, kStart);
  EXPECT_EQ(due(kStart), Ids{});
}

TEST_F(LedgerTest, CancelIsSentAgainUntilTheCommandIsOverOrUnderWay) {
  ledger.submit(command("a"));
  (void)due(kStart);
  told("a", CommandState::queued, kStart);
  ledger.cancel(RobotName{"r1"}, CommandId{"a"});
  EXPECT_EQ(due(kStart), Ids{"cancel a"});
  told("a", CommandState::scheduled, kStart + 1ms);  // crossed the cancellation: no answer to it
  EXPECT_EQ(due(kStart + 500ms), Ids{"cancel a"});
  told("a", CommandState::cancelled, kStart + 600ms);
  EXPECT_EQ(due(kStart + 2s), Ids{});
  EXPECT_EQ(ledger.open(), 0u);
}

TEST_F(LedgerTest, CancelOfAnothersCommandIsAnsweredOrLost) {
  ledger.cancel(RobotName{"r1"}, CommandId{"theirs"});
  ledger.cancel(RobotName{"r1"}, CommandId{"silent"});
  (void)due(kStart);
  told("theirs", CommandState::rejected, kStart);
  EXPECT_EQ(known("theirs").state, CommandState::rejected);
  alive(kStart + 10s);
  (void)due(kStart + 10s);
  EXPECT_EQ(known("silent").state, CommandState::failed);
  EXPECT_EQ(ledger.next_due(), std::nullopt);
}

TEST_F(LedgerTest, StopGivesUpWhatWasNotSentAndIsAnsweredUnderItsOwnId) {
  for (const char* id : {"a", "b", "c"}) ledger.submit(command(id));
  (void)due(kStart);
  ledger.stop({CommandId{"stop"}, RobotName{"r1"}});
  EXPECT_EQ(known("b").state, CommandState::cancelled);
  EXPECT_EQ(known("c").state, CommandState::cancelled);
  EXPECT_EQ(due(kStart), Ids{"stop"});
  told("stop", CommandState::completed, kStart);
  told("a", CommandState::cancelled, kStart);
  EXPECT_EQ(due(kStart + 1s), Ids{});
  EXPECT_EQ(known("stop").state, CommandState::completed);
}

TEST_F(LedgerTest, WhatCannotBeSentIsRejectedHere) {
  ledger.submit(command("a"));
  ledger.submit(command("b"));
  (void)due(kStart);
  ledger.refuse(CommandId{"a"}, "motion.velocity: nan");
  EXPECT_EQ(known("a").state, CommandState::rejected);
  EXPECT_EQ(known("a").reason, Reason::bad_request);
  EXPECT_EQ(due(kStart), Ids{"b"}) << "the next takes its turn";
}

/// The planner's side of the promise: an id is executed once, and answered each time it comes.
struct FakePlanner {
  std::map<std::string, CommandState> commands;
  std::vector<std::string> order;
};

TEST(LedgerUnderLoss, EveryCommandIsExecutedOnceAndInOrderWhenFourOfFiveMessagesAreLost) {
  constexpr int kRuns = 200;
  constexpr int kCommands = 10;
  for (int run = 0; run < kRuns; ++run) {
    const auto seed = static_cast<std::uint32_t>(1000 + run);
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937 random{seed};
    const auto arrives = [&] { return random() % 5 == 0; };
    Patience patience;
    patience.give_up = 1h;
    Ledger ledger{patience};
    FakePlanner planner;
    for (int i = 0; i < kCommands; ++i) ledger.submit(command("c" + std::to_string(i)));
    LocalTime now = kStart;
    for (int step = 0; ledger.open() > 0 && step < 100'000; ++step, now += 50ms) {
      ledger.on_planner(kPlanner, now);
      for (const auto& id : ids(ledger.due(now))) {
        if (!arrives()) continue;
        if (planner.commands.emplace(id, CommandState::queued).second) planner.order.push_back(id);
        if (arrives()) ledger.on_status(kPlanner, status(id, planner.commands[id]), now);
      }
      // One command in its turn takes a step, and its news may be lost too.
      for (const auto& id : planner.order) {
        auto& state = planner.commands[id];
        if (state == CommandState::completed) continue;
        state = state == CommandState::queued ? CommandState::started : CommandState::completed;
        if (arrives()) ledger.on_status(kPlanner, status(id, state), now);
        break;
      }
    }
    ASSERT_EQ(ledger.open(), 0u);
    ASSERT_EQ(planner.order.size(), static_cast<std::size_t>(kCommands));
    for (int i = 0; i < kCommands; ++i) {
      EXPECT_EQ(planner.order[static_cast<std::size_t>(i)], "c" + std::to_string(i));
      EXPECT_EQ(ledger.find(CommandId{"c" + std::to_string(i)})->status.state, CommandState::completed);
    }
  }
}

/// A client that sleeps until next_due() must neither spin nor sleep through what is due.
TEST(LedgerUnderLoss, NextDueIsNeverInThePastAfterDue) {
  std::mt19937 random{42};
  std::cout << "seed 42\n";
  Ledger ledger;
  LocalTime now = kStart;
  int made = 0;
  for (int step = 0; step < 20'000; ++step) {
    now += std::chrono::milliseconds{random() % 400};
    switch (random() % 6) {
      case 0: ledger.submit(command("c" + std::to_string(made++), random() % 2 == 0 ? "r1" : "r2")); break;
      case 1:
      case 2: ledger.on_planner(kPlanner, now); break;
      case 3:
        if (made > 0) {
          const auto id = "c" + std::to_string(made - 1 - static_cast<int>(random()) % std::min(made, 5));
          if (const Answer* a = ledger.find(CommandId{id})) {
            ledger.on_status(kPlanner, status(id, static_cast<CommandState>(random() % 8), a->status.robot.str()), now);
          }
        }
        break;
      case 4:
        if (made > 0) ledger.cancel(RobotName{"r1"}, CommandId{"c" + std::to_string(made - 1)});
        break;
      default: break;
    }
    (void)ledger.due(now);
    const auto next = ledger.next_due();
    if (!next) continue;
    // What was answered leaves room for the next of its robot at once; that is not spinning, as it is sent then.
    if (*next <= now) {
      EXPECT_FALSE(ledger.due(now).empty()) << "step " << step;
    }
  }
}

}  // namespace
}  // namespace interlace::client
