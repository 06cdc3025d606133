#include "simulator/status_judge.hpp"

#include <gtest/gtest.h>

namespace interlace::sim {
namespace {

using model::CommandState;

app::CommandRow row(const std::string& id) {
  app::CommandRow r;
  r.id = model::CommandId{id};
  return r;
}

model::CommandStatus status(const std::string& id, CommandState state, bool escape = false) {
  model::CommandStatus s;
  s.id = model::CommandId{id};
  s.state = state;
  s.escape = escape;
  return s;
}

TEST(StatusJudge, IsContentWhenEverythingCompletesOnce) {
  StatusJudge judge;
  for (const auto state : {CommandState::queued, CommandState::scheduled, CommandState::started, CommandState::completed}) {
    judge.on_status(status("r1-1", state));
  }
  const Verdict v = judge.verdict({row("r1-1")});
  EXPECT_TRUE(v.good()) << v.complaints.front();
  EXPECT_EQ(v.submitted, 1U);
  EXPECT_EQ(v.completed, 1U);
}

TEST(StatusJudge, TellsUnservedRejectedAndLostApart) {
  StatusJudge judge;
  judge.on_status(status("waits", CommandState::waiting));
  judge.on_status(status("behind", CommandState::queued));
  judge.on_status(status("no", CommandState::rejected));
  judge.on_status(status("fails", CommandState::failed));
  const Verdict v = judge.verdict({row("waits"), row("behind"), row("no"), row("fails"), row("silence")});
  EXPECT_EQ(v.unserved, 3U);
  EXPECT_EQ(v.rejected, 1U);
  EXPECT_EQ(v.lost, 1U);
  EXPECT_FALSE(v.good());
}

TEST(StatusJudge, ACommandLeftInItsQueueIsAComplaintOfItsOwnWhenThereIsNoOther) {
  StatusJudge judge;
  judge.on_status(status("behind", CommandState::queued));
  EXPECT_FALSE(judge.verdict({row("behind")}).good());
}

TEST(StatusJudge, SeesAStatusAfterTheFinalOne) {
  StatusJudge judge;
  judge.on_status(status("r1-1", CommandState::completed));
  judge.on_status(status("r1-1", CommandState::completed));
  const Verdict v = judge.verdict({row("r1-1")});
  EXPECT_EQ(v.contradicted, 1U);
  EXPECT_FALSE(v.good());
}

model::CommandStatus escape(const std::string& id, const std::string& serves) {
  model::CommandStatus s = status(id, CommandState::completed, true);
  s.serves = model::CommandId{serves};
  return s;
}

TEST(StatusJudge, AnEscapeMustServeACommandThatCompletes) {
  StatusJudge judge;
  judge.on_status(escape("escape-1", "r1-1"));
  judge.on_status(status("r1-1", CommandState::completed));
  EXPECT_EQ(judge.verdict({row("r1-1")}).fruitless_rounds, 0U);
  judge.on_status(escape("escape-2", "r2-7"));
  judge.on_status(escape("escape-3", "r2-7"));
  judge.on_status(status("r2-7", CommandState::waiting));
  const Verdict v = judge.verdict({row("r1-1"), row("r2-7")});
  EXPECT_EQ(v.escapes, 3U);
  EXPECT_EQ(v.fruitless_rounds, 1U) << "two escapes for one command";
}

}  // namespace
}  // namespace interlace::sim
