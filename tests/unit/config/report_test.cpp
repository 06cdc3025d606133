#include "common/app/report.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "common/app/evidence.hpp"

namespace interlace::app {
namespace {

using model::CommandState;
using model::Reason;

constexpr double kOrigin = 100;  // [s] of planner time

model::CommandStatus status_of(const std::string& id, CommandState state, Reason reason = Reason::none) {
  model::CommandStatus s;
  s.id = model::CommandId{id};
  s.robot = model::RobotName{"r1"};
  s.submitted = model::at_seconds(kOrigin);
  s.state = state;
  s.reason = reason;
  return s;
}

model::CommandStatus deadlock(const std::string& id) {
  auto s = status_of(id, CommandState::waiting, Reason::deadlock);
  s.refusals = {{model::RobotName{"r2"}, model::EscapeWay::minus_y, "r3 stands there"}};
  return s;
}

model::Conflict conflict(model::Instant until) {
  return {model::RobotName{"r2"}, "link2", "eef", model::kEarliest, until, -0.012, model::Vector3{0.3, 0, 0.2}};
}

class Report : public ::testing::Test {
 protected:
  Report() { collector_.on_submitted(model::CommandId{"a"}, model::RobotName{"r1"}, 0); }
  [[nodiscard]] nlohmann::json row(std::size_t i = 0) const { return to_json(collector_.finish("event"))["commands"].at(i); }

  ReportCollector collector_{model::at_seconds(kOrigin)};
};

TEST_F(Report, AWarningIsCountedEachTimeACommandNewlyIsInADeadlock) {
  collector_.on_status(deadlock("a"));
  collector_.on_status(deadlock("a"));  // said again
  EXPECT_EQ(collector_.warnings(), 1u);
  collector_.on_status(status_of("a", CommandState::waiting, Reason::blocked));
  EXPECT_EQ(collector_.warnings(), 1u);
  collector_.on_status(deadlock("a"));
  EXPECT_EQ(collector_.warnings(), 2u);
  collector_.on_submitted(model::CommandId{"b"}, model::RobotName{"r2"}, 0);
  collector_.on_status(deadlock("b"));
  const RunReport report = collector_.finish("event");
  EXPECT_EQ(report.warnings, 3u);
  EXPECT_EQ(to_json(report)["warnings"], 3);
  EXPECT_NE(summary(report).find("3 deadlock warnings"), std::string::npos) << summary(report);
}

TEST_F(Report, ACommandOfAnotherClientWarnsItsOwnClient) {
  collector_.on_status(deadlock("foreign"));
  EXPECT_EQ(collector_.warnings(), 0u);
}

TEST_F(Report, EscapesAreCountedApartAndNameWhatTheyServe) {
  auto escape = status_of("escape-1", CommandState::scheduled, Reason::escape);
  escape.escape = true;
  escape.serves = model::CommandId{"a"};
  collector_.on_status(escape);
  collector_.on_status(status_of("a", CommandState::completed));
  const RunReport report = collector_.finish("event");
  EXPECT_EQ(report.escapes, 1u);
  EXPECT_EQ(report.submitted, 1u);
  EXPECT_EQ(report.completed, 1u);
  EXPECT_EQ(row(1)["origin"], "escape");
  EXPECT_EQ(row(1)["serves"], "a");
  EXPECT_TRUE(row(0)["serves"].is_null());
  EXPECT_EQ(row(0)["origin"], "client");
}

TEST_F(Report, ConflictsTellUntilWhenFromTheStartOfTheRun) {
  auto waiting = status_of("a", CommandState::waiting, Reason::blocked);
  waiting.conflicts = {conflict(model::at_seconds(kOrigin + 3.5)), conflict(model::kForever)};
  collector_.on_status(waiting);
  const auto conflicts = row()["conflicts"];
  ASSERT_EQ(conflicts.size(), 2u);
  EXPECT_EQ(conflicts[0]["blocker"], "r2");
  EXPECT_EQ(conflicts[0]["link"], "link2");
  EXPECT_EQ(conflicts[0]["blocker_link"], "eef");
  EXPECT_DOUBLE_EQ(conflicts[0]["until_s"], 3.5);
  EXPECT_EQ(conflicts[0]["open_ended"], false);
  EXPECT_TRUE(conflicts[1]["until_s"].is_null());
  EXPECT_EQ(conflicts[1]["open_ended"], true);
}

TEST_F(Report, TheEvidenceOfADeadlockOutlivesIt) {
  auto warned = deadlock("a");
  warned.conflicts = {conflict(model::kForever)};
  collector_.on_status(warned);
  collector_.on_status(status_of("a", CommandState::cancelled, Reason::on_request));
  EXPECT_EQ(row()["reason"], "on_request");
  EXPECT_EQ(row()["conflicts"].size(), 1u);
  EXPECT_EQ(row()["refusals"], nlohmann::json::parse(R"([{"robot": "r2", "way": "-y", "explanation": "r3 stands there"}])"));
  const std::string text = summary(collector_.finish("event"));
  EXPECT_NE(text.find("r2 cannot go -y: r3 stands there"), std::string::npos) << text;
}

TEST(Evidence, SaysWhoWhichLinksAndUntilWhen) {
  const auto now = model::at_seconds(1);
  EXPECT_EQ(describe(conflict(model::at_seconds(2.5)), now), "r2's eef in the way of link2, 12.0 mm deep, free in 1.50 s");
  EXPECT_EQ(describe(conflict(model::kForever), now), "r2's eef in the way of link2, 12.0 mm deep, no end known");
  auto zone = conflict(model::at_seconds(1));
  zone.blocker_link.clear();
  EXPECT_EQ(describe(zone, now), "r2 holds the zone that link2 would be in, free now");
  zone.own_link.clear();
  EXPECT_EQ(describe(zone, now), "r2 could be anywhere in its reach, free now");
}

}  // namespace
}  // namespace interlace::app
