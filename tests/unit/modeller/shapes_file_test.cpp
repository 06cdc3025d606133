#include "modeller/shapes_file.hpp"

#include <gtest/gtest.h>

#include "tests/e2e/scratch.hpp"

namespace interlace::test {
namespace {

class ShapesFile : public testing::Test {
 protected:
  std::string refusal(const std::string& text) {
    const auto loaded = modeller::load_shapes(scratch_.file("shapes.yaml", text));
    return loaded ? "accepted" : to_string(loaded.error()).substr(scratch_.path("shapes.yaml").size());
  }
  Scratch scratch_;
};

const std::string kHead = "interlace: 1\nunits: {length: mm, angle: deg}\n";

TEST_F(ShapesFile, EveryKeyArrives) {
  const auto loaded = modeller::load_shapes(scratch_.file("shapes.yaml", kHead + R"(shapes:
  - {link: 0, mesh: base.stl}
  - {link: 6, mesh: /arm/hand.obj, units: m, frame: {xyz: [10, 20, 30], rpy: [0, 0, 90]}, capsules: 3}
)"));
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  ASSERT_EQ(loaded->size(), 2U);
  const auto& base = (*loaded)[0];
  EXPECT_EQ(base.link, 0U);
  EXPECT_EQ(base.file, scratch_.path("base.stl")) << "beside the file that lists it";
  EXPECT_DOUBLE_EQ(base.scale, 0.001);
  EXPECT_TRUE(base.X_LM.isApprox(model::Pose::Identity()));
  EXPECT_FALSE(base.capsules);
  const auto& hand = (*loaded)[1];
  EXPECT_EQ(hand.link, 6U);
  EXPECT_EQ(hand.file, "/arm/hand.obj");
  EXPECT_DOUBLE_EQ(hand.scale, 1);
  EXPECT_TRUE((hand.X_LM * model::Vector3{1, 0, 0}).isApprox(model::Vector3{0.010, 1.020, 0.030}, 1e-12));
  EXPECT_EQ(hand.capsules.value_or(0), 3U);
}

TEST_F(ShapesFile, TheUnitsOfTheFileAreThoseOfItsMeshes) {
  const auto loaded = modeller::load_shapes(
      scratch_.file("shapes.yaml",
                    "interlace: 1\nunits: {length: m, angle: rad}\nshapes: [{link: 0, mesh: a.stl}, {link: 1, mesh: b.stl, units: mm}]\n"));
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  EXPECT_DOUBLE_EQ((*loaded)[0].scale, 1);
  EXPECT_DOUBLE_EQ((*loaded)[1].scale, 0.001);
}

TEST_F(ShapesFile, TellsWhatIsWrongAndWhere) {
  EXPECT_EQ(refusal(kHead), ":1:1: shapes: required key is missing");
  EXPECT_EQ(refusal(kHead + "shapes: []\n"), ":3:9: shapes: found [], expected at least one shape");
  EXPECT_EQ(refusal(kHead + "shapes:\n  - {mesh: a.stl}\n"), ":4:5: shapes[0].link: required key is missing");
  EXPECT_EQ(refusal(kHead + "shapes:\n  - {link: 7, mesh: a.stl}\n"),
            ":4:12: shapes[0].link: found \"7\", expected a whole number from 0 to 6");
  EXPECT_EQ(refusal(kHead + "shapes:\n  - {link: 1, mesh: a.stl, units: inch}\n"),
            ":4:35: shapes[0].units: found \"inch\", expected mm or m");
  EXPECT_EQ(refusal(kHead + "shapes:\n  - {link: 1, mesh: a.stl, capsules: 17}\n"),
            ":4:38: shapes[0].capsules: found \"17\", expected a whole number from 1 to 16");
  EXPECT_EQ(refusal(kHead + "shapes:\n  - {link: 1, mesh: a.stl, frames: 1}\n"),
            ":4:28: shapes[0].frames: unknown key (did you mean \"frame\"?)");
  const auto missing = modeller::load_shapes(scratch_.path("missing.yaml"));
  ASSERT_FALSE(missing);
  EXPECT_EQ(to_string(missing.error()), scratch_.path("missing.yaml") + ": no such file");
}

}  // namespace
}  // namespace interlace::test
