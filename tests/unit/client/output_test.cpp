#include "app_client/output.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace interlace::client {
namespace {

using model::CommandState;
using model::Reason;

model::PlannerState waiting_state(model::Instant until) {
  model::PlannerState s;
  s.cell = "c";
  s.strategy = "event";
  s.at = model::at_seconds(10);
  s.incarnation = ~0ull;
  model::RobotStatus r;
  r.name = model::RobotName{"r1"};
  r.mode = model::RobotMode::commanded;
  r.queued = 3;
  r.current = model::CommandId{"cmd-1"};
  r.reason = Reason::delayed;
  r.text = "r1 starts later";
  model::Conflict c;
  c.blocker = model::RobotName{"r2"};
  c.until = until;
  r.conflicts.push_back(c);
  s.robots.push_back(r);
  return s;
}

TEST(Describe, ARobotThatWaitsSaysWhyAndUntilWhen) {
  const std::string text = describe(waiting_state(model::at_seconds(11.5)), true);
  EXPECT_NE(text.find("planner alive, strategy event"), std::string::npos) << text;
  EXPECT_NE(text.find("cmd-1"), std::string::npos) << text;
  EXPECT_NE(text.find("delayed: r1 starts later (free in 1.50 s)"), std::string::npos) << text;
  EXPECT_NE(describe(waiting_state(model::kForever), true).find("no end known"), std::string::npos);
  EXPECT_NE(describe(waiting_state(model::kForever), false).find("SILENT"), std::string::npos);
}

TEST(Describe, WhyItWasLateIsSaidOnlyUntilItStarts) {
  model::CommandStatus s;
  s.state = CommandState::scheduled;
  s.reason = Reason::delayed;
  s.text = "2 s later";
  EXPECT_EQ(describe(s), "scheduled: delayed: 2 s later");
  s.state = CommandState::completed;
  EXPECT_EQ(describe(s), "completed");
  s.state = CommandState::rejected;
  s.reason = Reason::unreachable;
  s.text = "too far";
  EXPECT_EQ(describe(s), "rejected: unreachable: too far");
}

TEST(Describe, AnEscapeIsMarkedWithTheCommandItServesAlsoWhileItMoves) {
  auto state = waiting_state(model::kForever);
  auto& robot = state.robots[0];
  robot.mode = model::RobotMode::moving;
  robot.current = model::CommandId{"escape-0-1"};
  robot.serves = model::CommandId{"send-7"};
  robot.reason = Reason::escape;
  robot.text = "r1 goes +z to make room for send-7";
  robot.conflicts.clear();
  const std::string text = describe(state, true);
  EXPECT_NE(text.find("escape-0-1 (escape for send-7)"), std::string::npos) << text;
  EXPECT_NE(text.find("escape: r1 goes +z to make room for send-7"), std::string::npos) << text;
  EXPECT_EQ(to_json(state, true)["robots"][0]["serves"], "send-7");

  model::CommandStatus s;
  s.id = robot.current;
  s.escape = true;
  s.serves = robot.serves;
  s.state = CommandState::started;
  s.reason = Reason::escape;
  EXPECT_EQ(describe_escape(s), "escape escape-0-1 for send-7  started");
  const auto json = to_json(Answer{s, false, true});
  EXPECT_EQ(json["origin"], "escape");
  EXPECT_EQ(json["serves"], "send-7");
}

TEST(Describe, ADeadlockExplainsEveryWayThatWasTried) {
  auto state = waiting_state(model::kForever);
  auto& robot = state.robots[0];
  robot.reason = Reason::deadlock;
  robot.text = "r1 cannot pass r2";
  robot.refusals = {{model::RobotName{"r2"}, model::EscapeWay::plus_x, "r3 stands there"},
                    {model::RobotName{"r2"}, model::EscapeWay::home, "it is at home"}};
  const std::string text = describe(state, true);
  EXPECT_NE(text.find("deadlock: r1 cannot pass r2 (no end known)"), std::string::npos) << text;
  EXPECT_NE(text.find("r2 cannot go +x: r3 stands there"), std::string::npos) << text;
  EXPECT_NE(text.find("r2 cannot go home: it is at home"), std::string::npos) << text;
  const auto json = to_json(state, true)["robots"][0];
  EXPECT_TRUE(json["serves"].is_null());
  EXPECT_EQ(json["refusals"][0], nlohmann::json::parse(R"({"robot": "r2", "way": "+x", "explanation": "r3 stands there"})"));

  model::CommandStatus s;
  s.state = CommandState::waiting;
  s.reason = Reason::deadlock;
  s.text = robot.text;
  s.refusals = robot.refusals;
  EXPECT_EQ(describe(s),
            "waiting: deadlock: r1 cannot pass r2\n    r2 cannot go +x: r3 stands there\n    r2 cannot go home: it is at home");
}

TEST(Json, KeepsSixtyFourBitsAndUsesNullForNoEnd) {
  const auto json = to_json(waiting_state(model::kForever), true);
  EXPECT_EQ(json["incarnation"], "ffffffffffffffff");
  EXPECT_TRUE(json["robots"][0]["conflicts"][0]["until_s"].is_null());
  EXPECT_EQ(json["alive"], true);
  Answer answer;
  answer.status.state = CommandState::queued;
  EXPECT_TRUE(to_json(answer)["start_s"].is_null());
  EXPECT_EQ(to_json(answer)["state"], "queued");
}

}  // namespace
}  // namespace interlace::client
