#include "simulator/reproduce/campaign.hpp"

#include <gtest/gtest.h>

namespace interlace::reproduce {
namespace {

TEST(Campaign, AnArrayOfRowsIsRead) {
  const auto rows = parse_campaign(R"([{"cell": "pattern-serial-3", "strategy": "event", "commands": 100000, "completed": 100000,
      "unserved": 0, "lost": 0, "escapes": 12, "warnings": 0, "collisions": 0, "least_clearance_m": 0.0012, "virtual_s": 123456.7,
      "real_s": 88.2}])",
                                   "c.json");
  ASSERT_TRUE(rows) << rows.error();
  ASSERT_EQ(rows->size(), 1U);
  EXPECT_EQ(campaign_table(*rows),
            "| cell | strategy | commands | completed | unserved | lost | escapes | warnings | collisions | least clearance [mm] | virtual "
            "time [s] | real time [s] |\n|---|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|\n"
            "| pattern-serial-3 | `event` | 100000 | 100000 | 0 | 0 | 12 | 0 | 0 | 1.2 | 123457 | 88 |\n");
}

TEST(Campaign, CellsMayStandAroundTheRowsOrAsKeys) {
  for (const char* text :
       {R"({"runs": [{"cell": "a", "strategies": [{"strategy": "acm", "completed": 5}]}]})",
        R"({"a": [{"strategy": "acm", "completed": 5}]})", R"({"a": {"acm": {"strategy": "acm", "completed": 5, "cell": "a"}}})",
        R"({"pattern": "a", "results": [{"strategy": "acm", "completed": 5, "lost": null}]})"}) {
    const auto rows = parse_campaign(text, "c.json");
    ASSERT_TRUE(rows) << rows.error();
    ASSERT_EQ(rows->size(), 1U) << text;
    EXPECT_EQ((*rows)[0].cell, "a") << text;
    EXPECT_EQ((*rows)[0].completed, 5) << text;
    EXPECT_FALSE((*rows)[0].lost) << text;
  }
}

TEST(Campaign, AHeadingIsNoCell) {
  const auto rows = parse_campaign(R"({"runs": [{"strategy": "acm", "completed": 5}]})", "c.json");
  ASSERT_TRUE(rows) << rows.error();
  EXPECT_EQ((*rows)[0].cell, "");
}

TEST(Campaign, WhatIsNoCampaignIsRefusedWithItsName) {
  for (const char* text : {"", "{", "[]", R"({"strategy": "event"})", "3"}) {
    const auto rows = parse_campaign(text, "c.json");
    ASSERT_FALSE(rows) << text;
    EXPECT_EQ(rows.error().rfind("c.json: ", 0), 0U) << rows.error();
  }
  const auto missing = load_campaign("nowhere/c.json");
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error(), "nowhere/c.json: cannot be read");
}

}  // namespace
}  // namespace interlace::reproduce
