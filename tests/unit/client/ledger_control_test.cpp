#include <gtest/gtest.h>

#include <iostream>
#include <map>
#include <random>

#include "app_client/ledger.hpp"

/// Holding, resuming and replacing in the client's books, also when messages are lost.
namespace interlace::client {
namespace {

using namespace std::chrono_literals;
using model::CommandId;
using model::CommandState;
using model::Reason;
using model::RobotName;
using Ids = std::vector<std::string>;

constexpr std::uint64_t kPlanner = 7;
const LocalTime kStart{1h};
const RobotName kRobot{"r1"};

model::CommandSubmitted command(const std::string& id) {
  model::CommandSubmitted c;
  c.id = CommandId{id};
  c.robot = kRobot;
  return c;
}

class LedgerControl : public ::testing::Test {
 protected:
  LedgerControl() { ledger.on_planner(kPlanner, kStart); }
  [[nodiscard]] Ids due(LocalTime now) {
    Ids out;
    for (const auto& r : ledger.due(now)) out.push_back(std::visit([](const auto& x) { return x.id.str(); }, r));
    return out;
  }
  void told(const std::string& id, CommandState state, LocalTime now, Reason reason = Reason::none) {
    model::CommandStatus s;
    s.id = CommandId{id};
    s.robot = kRobot;
    s.state = state;
    s.reason = reason;
    ledger.on_status(kPlanner, s, now);
  }
  bool replace(const std::string& id, const Ids& commands) {
    model::QueueReplaced request{CommandId{id}, kRobot, {}};
    for (const auto& c : commands) request.commands.push_back(command(c));
    return ledger.replace(request);
  }
  [[nodiscard]] const model::CommandStatus& known(const std::string& id) const { return ledger.find(CommandId{id})->status; }

  Ledger ledger;
};

TEST_F(LedgerControl, HoldAndResumeAreSentAgainUntilAnswered) {
  EXPECT_TRUE(ledger.hold({CommandId{"h"}, kRobot}));
  EXPECT_FALSE(ledger.hold({CommandId{"h"}, kRobot}));
  EXPECT_EQ(due(kStart), Ids{"h"});
  EXPECT_EQ(due(kStart + 500ms), Ids{"h"});
  told("h", CommandState::completed, kStart + 600ms);
  EXPECT_EQ(due(kStart + 2s), Ids{});
  EXPECT_TRUE(ledger.resume({CommandId{"r"}, kRobot}));
  EXPECT_EQ(due(kStart + 2s), Ids{"r"});
  ledger.on_planner(kPlanner, kStart + 12s);
  EXPECT_EQ(due(kStart + 12s), Ids{});
  EXPECT_EQ(known("r").state, CommandState::failed) << "nobody answered";
  EXPECT_EQ(ledger.next_due(), std::nullopt);
}

TEST_F(LedgerControl, AReplacementGoesAfterTheCommandOnItsWayAndBeforeAnyLaterOne) {
  for (const char* id : {"a", "b"}) ledger.submit(command(id));
  ASSERT_EQ(due(kStart), Ids{"a"});
  ASSERT_TRUE(replace("x", {"n1", "n2"}));
  EXPECT_EQ(known("b").state, CommandState::cancelled);
  EXPECT_EQ(known("b").reason, Reason::replaced);
  ledger.submit(command("later"));
  EXPECT_EQ(due(kStart), Ids{}) << "`a` could come after it and would be carried out";
  told("a", CommandState::queued, kStart + 1ms);
  EXPECT_EQ(due(kStart + 1ms), Ids{"x"});
  EXPECT_EQ(ledger.open(), 4u);
  told("a", CommandState::cancelled, kStart + 2ms, Reason::replaced);
  told("n1", CommandState::queued, kStart + 2ms);
  EXPECT_EQ(due(kStart + 2ms), Ids{}) << "not before all of it is answered";
  told("x", CommandState::completed, kStart + 3ms);
  EXPECT_EQ(due(kStart + 3ms), Ids{"later"});
  EXPECT_EQ(ledger.open(), 3u);
}

TEST_F(LedgerControl, WhatARefusedReplacementHadIsRejectedWithIt) {
  ASSERT_TRUE(replace("x", {"n1", "n2"}));
  ASSERT_EQ(due(kStart), Ids{"x"});
  told("n1", CommandState::rejected, kStart, Reason::unreachable);
  told("x", CommandState::rejected, kStart, Reason::unreachable);
  EXPECT_EQ(known("n2").state, CommandState::rejected);
  EXPECT_EQ(ledger.open(), 0u);
}

TEST_F(LedgerControl, AReplacementThatNobodyAnswersTakesItsCommandsAlong) {
  ASSERT_TRUE(replace("x", {"n1"}));
  (void)due(kStart);
  ledger.on_planner(kPlanner, kStart + 11s);
  (void)due(kStart + 11s);
  EXPECT_EQ(known("x").state, CommandState::failed);
  EXPECT_EQ(known("n1").state, CommandState::failed);
  EXPECT_EQ(ledger.open(), 0u);
}

TEST_F(LedgerControl, AnotherPlannerLosesAReplacementToo) {
  ASSERT_TRUE(replace("x", {"n1"}));
  (void)due(kStart);
  ledger.on_planner(kPlanner + 1, kStart + 1s);
  EXPECT_EQ(known("x").state, CommandState::failed);
  EXPECT_EQ(known("n1").state, CommandState::failed);
  EXPECT_EQ(ledger.open(), 0u);
}

TEST_F(LedgerControl, IdsAreNewOnesAndUsedOnce) {
  ledger.submit(command("a"));
  EXPECT_FALSE(replace("x", {"a"}));
  EXPECT_FALSE(replace("x", {"n", "n"}));
  EXPECT_FALSE(replace("a", {"n"}));
  EXPECT_EQ(ledger.find(CommandId{"n"}), nullptr);
  EXPECT_EQ(known("a").state, CommandState::queued);
}

TEST_F(LedgerControl, WhatIsCancelledBeforeItsReplacementIsSentIsNoPartOfIt) {
  ledger.submit(command("a"));
  (void)due(kStart);
  ASSERT_TRUE(replace("x", {"n1", "n2"}));
  ledger.cancel(kRobot, CommandId{"n1"});
  EXPECT_EQ(known("n1").state, CommandState::cancelled);
  told("a", CommandState::queued, kStart);
  const auto requests = ledger.due(kStart);
  ASSERT_EQ(requests.size(), 1u);
  const auto& sent = std::get<model::QueueReplaced>(requests[0]);
  ASSERT_EQ(sent.commands.size(), 1u);
  EXPECT_EQ(sent.commands[0].id.str(), "n2");
}

TEST_F(LedgerControl, ASecondReplacementTakesTheFirstBackWhenItWasNotSent) {
  ledger.submit(command("a"));
  (void)due(kStart);
  ASSERT_TRUE(replace("x", {"n1"}));
  ASSERT_TRUE(replace("y", {"n2"}));
  EXPECT_EQ(known("x").state, CommandState::cancelled);
  EXPECT_EQ(known("n1").state, CommandState::cancelled);
  told("a", CommandState::queued, kStart);
  EXPECT_EQ(due(kStart), Ids{"y"});
}

/// Four of five messages lost: the planner carries a replacement out once, and the commands after it stay after it.
TEST(LedgerControlUnderLoss, EveryReplacementIsCarriedOutOnceAndInItsPlace) {
  for (std::uint32_t seed = 1; seed <= 200; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937 random{seed};
    const auto arrives = [&] { return random() % 5 == 0; };
    Patience patience;
    patience.give_up = 1h;
    Ledger ledger{patience};
    std::map<std::string, CommandState> statuses;
    Ids queue, done;
    const auto admit = [&](const std::string& id) {
      if (statuses.emplace(id, CommandState::queued).second) queue.push_back(id);
    };
    for (const char* id : {"a", "b", "c"}) ledger.submit(command(id));
    LocalTime now = kStart;
    for (int step = 0; step < 100'000 && (ledger.open() > 0 || step < 40); ++step, now += 50ms) {
      if (step == 30) {
        model::QueueReplaced request{CommandId{"x"}, kRobot, {command("n1"), command("n2")}};
        ASSERT_TRUE(ledger.replace(request));
        ledger.submit(command("later"));
      }
      ledger.on_planner(kPlanner, now);
      const auto say = [&](const std::string& id) {
        model::CommandStatus s;
        s.id = CommandId{id};
        s.robot = kRobot;
        s.state = statuses[id];
        if (arrives()) ledger.on_status(kPlanner, s, now);
      };
      for (const auto& request : ledger.due(now)) {
        if (!arrives()) continue;
        const auto id = std::visit([](const auto& x) { return x.id.str(); }, request);
        if (const auto* replacement = std::get_if<model::QueueReplaced>(&request); replacement && statuses.count(id) == 0) {
          for (const auto& gone : queue) statuses[gone] = CommandState::cancelled;
          queue.clear();
          for (const auto& c : replacement->commands) admit(c.id.str());
          statuses[id] = CommandState::completed;
        } else if (!replacement) {
          admit(id);
        }
        say(id);
      }
      if (!queue.empty() && step % 20 == 0) {
        statuses[queue.front()] = CommandState::completed;
        done.push_back(queue.front());
        say(queue.front());
        queue.erase(queue.begin());
      }
    }
    ASSERT_EQ(ledger.open(), 0u);
    ASSERT_GE(done.size(), 3u);
    EXPECT_EQ(Ids(done.end() - 3, done.end()), (Ids{"n1", "n2", "later"}));
  }
}

}  // namespace
}  // namespace interlace::client
