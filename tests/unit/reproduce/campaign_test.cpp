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
  ASSERT_EQ(rows->rows.size(), 1U);
  EXPECT_EQ(campaign_table(*rows),
            "| cell | strategy | commands | completed | unserved | lost | escapes | warnings | collisions | least clearance [mm] | virtual "
            "time [s] | real time [s] |\n|---|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|\n"
            "| pattern-serial-3 | `event` | 100000 | 100000 | 0 | 0 | 12 | 0 | 0 | 1.20 | 123457 | 88 |\n");
}

TEST(Campaign, CellsMayStandAroundTheRowsOrAsKeys) {
  for (const char* text :
       {R"({"runs": [{"cell": "a", "strategies": [{"strategy": "acm", "completed": 5}]}]})",
        R"({"a": [{"strategy": "acm", "completed": 5}]})", R"({"a": {"acm": {"strategy": "acm", "completed": 5, "cell": "a"}}})",
        R"({"pattern": "a", "results": [{"strategy": "acm", "completed": 5, "lost": null}]})"}) {
    const auto rows = parse_campaign(text, "c.json");
    ASSERT_TRUE(rows) << rows.error();
    ASSERT_EQ(rows->rows.size(), 1U) << text;
    EXPECT_EQ(rows->rows[0].cell, "a") << text;
    EXPECT_EQ(rows->rows[0].completed, 5) << text;
    EXPECT_FALSE(rows->rows[0].lost) << text;
  }
}

TEST(Campaign, TheFileOfTheProgramIsRead) {
  const auto campaign = parse_campaign(R"({"strategy": "acm", "per_robot": 4, "stopped": false, "real_s": 9.5, "failing": [{"cell": "a",
      "seed": 3, "collisions": 0}], "cells": [{"cell": "pattern-serial-3", "robots": 3, "submitted": 24, "completed": 20, "warnings": 3,
      "nearest": {"clearance_m": 0.0005, "t_s": 1, "link_a": "x", "link_b": "y"}}, {"cell": "pattern-square-4", "submitted": 16,
      "completed": 16, "nearest": null}]})",
                                       "some/where/acm.json");
  ASSERT_TRUE(campaign) << campaign.error();
  ASSERT_EQ(campaign->rows.size(), 2U);
  EXPECT_EQ(campaign->rows[0].strategy, "acm");
  EXPECT_EQ(campaign->rows[0].commands, 24);
  EXPECT_EQ(campaign->rows[0].least_clearance, 0.0005);
  EXPECT_FALSE(campaign->rows[1].least_clearance);
  EXPECT_EQ(campaign_command(*campaign),
            "interlace-campaign --cells deploy/cells/pattern-serial-3 deploy/cells/pattern-square-4 --commands 40 --per-robot 4 --strategy "
            "acm --report acm.json");
}

TEST(Campaign, AHeadingIsNoCell) {
  const auto rows = parse_campaign(R"({"runs": [{"strategy": "acm", "completed": 5}]})", "c.json");
  ASSERT_TRUE(rows) << rows.error();
  EXPECT_EQ(rows->rows[0].cell, "");
}

TEST(Campaign, WhatIsNoCampaignIsRefusedWithItsName) {
  for (const char* text : {"", "{", "[]", R"({"strategy": "event"})", R"({"completed": true})", "3"}) {
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
