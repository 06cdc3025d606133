#include "modeller/fitted_shape.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "modeller/capsule_fit.hpp"
#include "tests/e2e/scratch.hpp"
#include "tests/support/shapes.hpp"

namespace interlace::test {
namespace {

using modeller::fit;
using modeller::FittedShape;
using modeller::Shape;

TEST(FittedShape, LiesInTheFrameOfItsLink) {
  Scratch scratch;
  Shape shape;
  shape.link = 2;
  shape.file = scratch.file("upper.stl", binary_stl(cylinder(0.05, 0.3)));
  shape.X_LM = model::make_pose({0.1, 0.2, 0.3}, model::rotation_from_rpy({0, model::kPi / 2, 0}));  // z of the mesh along x of the link
  const auto fitted = fit(shape, {});
  ASSERT_TRUE(fitted) << to_string(fitted.error());
  ASSERT_EQ(fitted->cover.capsules.size(), 1U);
  const auto& c = fitted->cover.capsules[0];
  EXPECT_NEAR(((c.a + c.b) / 2 - Vector3{0.25, 0.2, 0.3}).norm(), 0, 1e-3);
  EXPECT_LT((c.b - c.a).tail<2>().norm(), 1e-3);
  EXPECT_NEAR(c.radius, 0.055, 0.005);
  EXPECT_EQ(fitted->vertices, 96U);
}

TEST(FittedShape, NamesEachCapsuleOnce) {
  const auto with = [](std::size_t link, std::size_t capsules) {
    FittedShape f;
    f.shape.link = link;
    f.cover.capsules.resize(capsules);
    return f;
  };
  std::vector<std::string> names;
  for (const auto& c : modeller::link_capsules({with(0, 1), with(2, 2), with(6, 1), with(2, 1), with(5, 1)})) names.push_back(c.name);
  EXPECT_EQ(names, (std::vector<std::string>{"base", "link2-1", "link2-2", "flange", "link2-3", "link5"}));
}

TEST(FittedShape, TellsHowWellItFits) {
  Scratch scratch;
  Shape shape;
  shape.file = scratch.file("base.obj", obj(box({0.1, 0.1, 0.3})));
  const auto whole = fit(shape, {});
  ASSERT_TRUE(whole);
  EXPECT_NE(modeller::describe(*whole).find("1 capsule, all 8 vertices inside by"), std::string::npos) << modeller::describe(*whole);
  EXPECT_NE(modeller::describe(*whole).find("more volume than the mesh"), std::string::npos) << modeller::describe(*whole);
  const auto j = to_json(*whole);
  EXPECT_EQ(j["body"], "mesh");
  EXPECT_NEAR(j["body_volume_m3"].get<double>(), 0.003, 1e-9);
  EXPECT_GT(j["inside_m"]["least"].get<double>(), 0);
  EXPECT_EQ(j["capsules"].size(), 1U);

  shape.file = scratch.file("plate.obj", "v 0 0 0\nv 9 0 0\nv 0 9 0\nf 1 2 3\n");
  const auto flat = fit(shape, {});
  ASSERT_TRUE(flat);
  EXPECT_NE(modeller::describe(*flat).find("around a shape without volume"), std::string::npos) << modeller::describe(*flat);
  EXPECT_TRUE(to_json(*flat)["excess"].is_null());
}

TEST(FittedShape, HandsOnWhyThereIsNoMesh) {
  Shape shape;
  shape.file = "no/such/mesh.stl";
  const auto fitted = fit(shape, {});
  ASSERT_FALSE(fitted);
  EXPECT_EQ(to_string(fitted.error()), "no/such/mesh.stl: no such file");
}

}  // namespace
}  // namespace interlace::test
