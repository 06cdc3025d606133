#include "app_client/ids.hpp"

#include <gtest/gtest.h>

#include <set>

namespace interlace::client {
namespace {

TEST(MakeId, IsAValidNameWithItsPrefixAndNeverTheSameTwice) {
  std::set<std::string> seen;
  for (int i = 0; i < 10'000; ++i) {
    const std::string id = make_id("run");
    EXPECT_TRUE(model::is_valid_name(id)) << id;
    EXPECT_EQ(id.rfind("run-", 0), 0u) << id;
    EXPECT_TRUE(seen.insert(id).second) << id;
  }
}

TEST(MakeId, LeavesRoomForASuffixOfSevenBytes) {
  EXPECT_LE(make_id(std::string(kMaxIdPrefix, 'x')).size() + 7, model::kMaxNameLength);
}

TEST(MakeId, RefusesAPrefixThatIsNoNameOrTooLong) {
  EXPECT_THROW((void)make_id(""), std::invalid_argument);
  EXPECT_THROW((void)make_id("a b"), std::invalid_argument);
  EXPECT_THROW((void)make_id(std::string(kMaxIdPrefix + 1, 'x')), std::invalid_argument);
}

}  // namespace
}  // namespace interlace::client
