#include "simulator/reproduce/svg.hpp"

#include <gtest/gtest.h>

#include "simulator/reproduce/axes.hpp"
#include "tests/unit/reproduce/pictures.hpp"

namespace interlace::reproduce {
namespace {

TEST(Svg, IsWellFormedWhateverTheTextsAre) {
  Svg svg{200, 100, "a < b & \"c\""};
  svg.hatching("h", "#123456");
  svg.rect(1, 2, 3, 4, {"url(#h)", "#000000"}, "hint with 'quotes' & <angles>");
  svg.begin_clip(0, 0, 10, 10);
  svg.line({0, 0}, {1, 1}, {});
  svg.polyline({{0, 0}, {1, 2}}, {});
  svg.path("M0 0H1V1Z", {});
  svg.end_clip();
  TextStyle turned;
  turned.upwards = true;
  svg.text({5, 5}, "</text><script>\x01", turned);
  EXPECT_EQ(test::fault_in_xml(svg.str()), "") << svg.str();
  EXPECT_EQ(svg.str().find("<script"), std::string::npos);
}

TEST(Svg, TheCheckerOfTheseTestsFindsFaults) {
  EXPECT_NE(test::fault_in_xml("<a><b></a>"), "");
  EXPECT_NE(test::fault_in_xml("<a>x & y</a>"), "");
  EXPECT_NE(test::fault_in_xml("<a>"), "");
  EXPECT_EQ(test::fault_in_xml("<a b=\"c\"><d/>&amp;</a>\n"), "");
}

TEST(Svg, EscapesText) {
  EXPECT_EQ(escaped("a<b>&\"'\n"), "a&lt;b&gt;&amp;&quot;&#39;");
}

TEST(Svg, NumbersAreShortAndHaveNoNegativeZero) {
  EXPECT_EQ(number(1.0), "1");
  EXPECT_EQ(number(0.5), "0.5");
  EXPECT_EQ(number(100), "100");
  EXPECT_EQ(number(2.345678), "2.35");
  EXPECT_EQ(number(-0.0001), "0");
}

TEST(Svg, SimplifiedKeepsCornersAndEnds) {
  const auto kept = simplified({{0, 0}, {1, 0.01}, {2, 0}, {3, 5}, {4, 0}}, 0.1);
  ASSERT_EQ(kept.size(), 4U);
  EXPECT_EQ(kept[1].x, 2);
  EXPECT_EQ(kept[2].y, 5);
  EXPECT_EQ(kept.back().x, 4);
}

TEST(Axes, TicksAreRoundAndInside) {
  EXPECT_EQ(ticks(0, 10, 5), (std::vector<double>{0, 2, 4, 6, 8, 10}));
  EXPECT_EQ(ticks(-200, 300, 5), (std::vector<double>{-200, -100, 0, 100, 200, 300}));
  EXPECT_TRUE(ticks(0, 10, 0).empty());
  EXPECT_TRUE(ticks(1, 1, 5).empty());
}

}  // namespace
}  // namespace interlace::reproduce
