#include "common/model/ids.hpp"

#include <gtest/gtest.h>

#include <string>
#include <unordered_set>

#include "common/model/cell.hpp"
#include "common/model/messages.hpp"

namespace interlace::test {
namespace {

using model::CommandId;
using model::is_valid_name;

TEST(Names, MayTravelAsTopicsFilesAndTableCells) {
  for (const char* good : {"r1", "a", "cell-4.2", "client_7:12", "A9"}) EXPECT_TRUE(is_valid_name(good)) << good;
  EXPECT_TRUE(is_valid_name(std::string(model::kMaxNameLength, 'x')));
}

TEST(Names, MayNotBeEmptyLongOrHoldAnythingElse) {
  for (const char* bad : {"", " ", "a b", "a/b", "ä", "a\n", "a,b", "a\"b", "../x"}) EXPECT_FALSE(is_valid_name(bad)) << bad;
  EXPECT_FALSE(is_valid_name(std::string(model::kMaxNameLength + 1, 'x')));
  EXPECT_FALSE(is_valid_name(std::string("a\0b", 3)));
}

TEST(Names, CompareAndHashByTheirText) {
  EXPECT_EQ(CommandId{"a"}, CommandId{"a"});
  EXPECT_NE(CommandId{"a"}, CommandId{"b"});
  EXPECT_LT(CommandId{"a"}, CommandId{"b"});
  EXPECT_EQ((std::unordered_set<CommandId>{CommandId{"a"}, CommandId{"a"}, CommandId{"b"}}).size(), 2U);
}

TEST(Cell, FindsRobotsByName) {
  model::Cell cell;
  cell.robots.resize(2);
  cell.robots[0].name = model::RobotName{"r1"};
  cell.robots[1].name = model::RobotName{"r2"};
  EXPECT_EQ(cell.find(model::RobotName{"r2"}), 1U);
  EXPECT_FALSE(cell.find(model::RobotName{"r3"}));
}

TEST(States, FinalOnesComeLast) {
  using model::CommandState;
  for (const auto s : {CommandState::queued, CommandState::waiting, CommandState::scheduled, CommandState::started})
    EXPECT_FALSE(is_final(s));
  for (const auto s : {CommandState::completed, CommandState::rejected, CommandState::cancelled, CommandState::failed})
    EXPECT_TRUE(is_final(s));
}

}  // namespace
}  // namespace interlace::test
