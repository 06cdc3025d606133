#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/fixtures.hpp"
#include "tests/unit/config/samples.hpp"

namespace interlace::app {
namespace {

using model::Vector3;
using samples::Broken;
using samples::kCell;
using samples::replaced;

constexpr double kExact = 1e-12;  // [m] rounding of the conversion of units

/// The sample cell with these fixtures; the first one stands in line 47.
std::string with(const std::string& fixtures) {
  return replaced(kCell, "fixtures: []\n", "fixtures:\n" + fixtures);
}

const std::string kBox = "  - {name: box, type: box, pose: {xyz: [2000, 0, 100], rpy: [0, 0, 90]}, size: [100, 200, 300]}\n";
const std::string kCylinder = "  - {name: pole, type: cylinder, pose: {xyz: [0, 2000, 0], rpy: [0, 0, 0]}, radius: 50, length: 900}\n";
const std::string kSphere = "  - {name: lamp, type: sphere, pose: {xyz: [0, 0, 3000], rpy: [0, 0, 0]}, radius: 80}\n";
const std::string kPlane = "  - {name: floor, type: plane, normal: [0, 0, 2], offset: -200}\n";
const std::string kMesh = "  - {name: table, type: mesh, file: table.stl, pose: {xyz: [2000, 0, 0], rpy: [0, 0, 0]}}\n";

/// Answers with a box of half a metre, and notes what was asked for.
struct Shelf {
  std::string path;
  double scale = 0;
  std::string wrong;                             // instead of an answer
  model::TriangleMesh::Triangle extra{0, 0, 0};  // added to the box
  [[nodiscard]] MeshReader reader() {
    return [this](const std::string& p, double s, bool solid) -> model::Result<std::shared_ptr<const model::TriangleMesh>, std::string> {
      path = p;
      scale = s;
      if (!wrong.empty()) return model::unexpected(wrong);
      const auto box = test::box_mesh(Vector3::Constant(0.25));
      auto triangles = box->triangles();
      if (extra[0] != extra[1]) triangles.push_back(extra);
      return std::make_shared<const model::TriangleMesh>(box->vertices(), std::move(triangles), solid);
    };
  }
};

TEST(ConfigFixtures, EveryTypeArrivesInSiUnits) {
  Shelf shelf;
  const auto loaded = parse_cell(with(kBox + kCylinder + kSphere + kPlane + kMesh), "cells/line/cell.yaml", shelf.reader());
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  const auto& fixtures = loaded->cell.fixtures;
  ASSERT_EQ(fixtures.size(), 5U);
  EXPECT_EQ(fixtures[0].name, "box");
  EXPECT_TRUE(std::get<model::BoxShape>(fixtures[0].shape).half.isApprox(Vector3{0.05, 0.1, 0.15}, kExact));
  EXPECT_TRUE((fixtures[0].X_WO * Vector3{1, 0, 0}).isApprox(Vector3{2, 1, 0.1}, kExact));
  EXPECT_DOUBLE_EQ(std::get<model::CylinderShape>(fixtures[1].shape).radius, 0.05);
  EXPECT_DOUBLE_EQ(std::get<model::CylinderShape>(fixtures[1].shape).half_length, 0.45);
  EXPECT_DOUBLE_EQ(std::get<model::SphereShape>(fixtures[2].shape).radius, 0.08);
  EXPECT_TRUE(std::get<model::PlaneShape>(fixtures[3].shape).normal.isApprox(Vector3::UnitZ(), kExact));
  EXPECT_DOUBLE_EQ(std::get<model::PlaneShape>(fixtures[3].shape).offset, -0.2);
  EXPECT_TRUE(std::get<model::MeshShape>(fixtures[4].shape).mesh->solid());
  EXPECT_EQ(shelf.path, "cells/line/table.stl") << "beside the cell file";
  EXPECT_DOUBLE_EQ(shelf.scale, 0.001) << "by default in the units of the cell file";
}

TEST(ConfigFixtures, AMeshHasItsOwnScaleAndMayBeASurface) {
  Shelf shelf;
  shelf.extra = {0, 1, 7};  // a sheet across: its edges belong to three triangles or to one
  const auto surface = parse_cell(with(replaced(kMesh, "table.stl", "/t.obj, scale: 1000, solid: false")), "cell.yaml", shelf.reader());
  ASSERT_TRUE(surface) << to_string(surface.error());
  EXPECT_FALSE(std::get<model::MeshShape>(surface->cell.fixtures[0].shape).mesh->solid());
  EXPECT_EQ(shelf.path, "/t.obj");
  EXPECT_DOUBLE_EQ(shelf.scale, 1.0);

  const auto open = parse_cell(with(kMesh), "cell.yaml", shelf.reader());
  ASSERT_FALSE(open);
  samples::expect_only(open.error().findings,
                       {"", "", "", 47, "fixtures[0].file", "\"table.stl\"", "expected a closed surface, but 3 of its edges are open"},
                       "cell.yaml");
}

TEST(ConfigFixtures, WhatIsWrongWithAMeshFileIsTold) {
  Shelf shelf;
  shelf.wrong = "table.stl: holds no triangles";
  const auto broken = parse_cell(with(kMesh), "cell.yaml", shelf.reader());
  ASSERT_FALSE(broken);
  samples::expect_only(broken.error().findings, {"", "", "", 47, "fixtures[0].file", "\"table.stl\"", "holds no triangles"}, "cell.yaml");
  samples::expect_only(samples::cell_findings(with(kMesh)),
                       {"", "", "", 47, "fixtures[0].file", "\"table.stl\"", "together with a cell file on disk"}, "cell.yaml");
}

class FixtureRule : public testing::TestWithParam<Broken> {};

TEST_P(FixtureRule, IsToldWithItsPlace) {
  const Broken& broken = GetParam();
  samples::expect_only(samples::cell_findings(with(replaced(kBox + kCylinder + kSphere + kPlane, broken.from, broken.to))), broken,
                       "cell.yaml");
}

INSTANTIATE_TEST_SUITE_P(
    Fixtures, FixtureRule,
    testing::Values(Broken{"NoName", "name: box, ", "", 47, "fixtures[0].name", "", "required key is missing"},
                    Broken{"NameTwice", "name: pole", "name: box", 48, "fixtures[1].name", "\"box\"", "fixtures[0] has it already"},
                    Broken{"NoType", "type: box, ", "", 47, "fixtures[0].type", "", "required key is missing"},
                    Broken{"UnknownType", "type: box", "type: bocks", 47, "fixtures[0].type", "\"bocks\"",
                           "expected box, cylinder, mesh, plane or sphere"},
                    Broken{"AnothersKey", "size: [100", "radius: 5, size: [100", 47, "fixtures[0].radius", "",
                           "a box has no radius; it has pose, size"},
                    Broken{"PlaneWithPose", "normal: [0", "pose: {xyz: [0, 0, 0], rpy: [0, 0, 0]}, normal: [0", 50, "fixtures[3].pose", "",
                           "a plane has no pose"},
                    Broken{"UnknownKey", "size: [100", "colour: red, size: [100", 47, "fixtures[0].colour", "", "unknown key"},
                    Broken{"NoSize", ", size: [100, 200, 300]", "", 47, "fixtures[0].size", "", "required key is missing"},
                    Broken{"FlatSize", "[100, 200, 300]", "[100, 0, 300]", 47, "fixtures[0].size[1]", "\"0\"",
                           "expected a number > 0 (mm)"},
                    Broken{"NoLength", ", length: 900", "", 48, "fixtures[1].length", "", "required key is missing"},
                    Broken{"NoRadius", ", radius: 80", "", 49, "fixtures[2].radius", "", "required key is missing"},
                    Broken{"NoNormal", "normal: [0, 0, 2], ", "", 50, "fixtures[3].normal", "", "required key is missing"},
                    Broken{"ZeroNormal", "normal: [0, 0, 2]", "normal: [0, 0, 0]", 50, "fixtures[3].normal", "[0, 0, 0]",
                           "expected a direction out of the material"},
                    Broken{"NoOffset", ", offset: -200", "", 50, "fixtures[3].offset", "", "required key is missing"},
                    Broken{"HalfAPose", ", rpy: [0, 0, 90]", "", 47, "fixtures[0].pose.rpy", "", "required key is missing"}),
    [](const testing::TestParamInfo<Broken>& rule) { return std::string{rule.param.name}; });

TEST(ConfigFixtures, ARobotMayNotStandInOneAtItsStartNorAtHome) {
  const auto block = [](const std::string& xyz) {
    return with("  - {name: block, type: box, pose: {xyz: " + xyz + ", rpy: [0, 0, 0]}, size: [20, 20, 20]}\n");
  };
  samples::expect_only(samples::cell_findings(block("[450, -250, 300]")),
                       {"", "", "", 44, "robots[1].start", "{xyz: [450, -250, 300], rpy: [0, 0, 0]}",
                        "in collision with fixture block: clearance of r2.forearm would be -20 mm, expected > 5 mm"},
                       "cell.yaml");
  const std::string turned_home = replaced(block("[0, 700, 300]"), "home: {joints: [0, 40", "home: {joints: [90, 40");
  samples::expect_only(samples::cell_findings(turned_home),
                       {"", "", "", 34, "robots[0].home", "{joints: [90, 40, 94, 0, -44, 0]}", "in collision with fixture block"},
                       "cell.yaml");
}

TEST(ConfigFixtures, ABaseMayStandInOneAndTheMarginAndThePathErrorAreKept) {
  const auto floor = [](int z) { return with("  - {name: floor, type: plane, normal: [0, 0, 1], offset: " + std::to_string(z) + "}\n"); };
  // The upper arm's lower end is a ball of 117 mm at a height of 290 mm; the margin is 5 mm, r1's path error 2 mm.
  EXPECT_TRUE(samples::cell_findings(floor(165)).empty());
  EXPECT_EQ(samples::cell_findings(floor(167)).size(), 1U) << "r1";
  EXPECT_EQ(samples::cell_findings(floor(169)).size(), 2U) << "one for each robot";
}

TEST(ConfigFixtures, AChangeOfAnyChangesTheFingerprint) {
  Shelf shelf;
  const std::string all = kBox + kCylinder + kSphere + kPlane + kMesh;
  const auto of = [&](const std::string& fixtures) {
    const auto loaded = parse_cell(with(fixtures), "cell.yaml", shelf.reader());
    EXPECT_TRUE(loaded) << (loaded ? "" : to_string(loaded.error()));
    return loaded ? loaded->fingerprint : 0;
  };
  std::vector<std::uint64_t> seen{of(all), of(kBox)};
  for (const auto& [from, to] : std::vector<std::pair<std::string, std::string>>{{"name: box", "name: bin"},
                                                                                 {"xyz: [2000", "xyz: [2001"},
                                                                                 {"size: [100", "size: [101"},
                                                                                 {"radius: 50", "radius: 51"},
                                                                                 {"length: 900", "length: 901"},
                                                                                 {"radius: 80", "radius: 81"},
                                                                                 {"normal: [0, 0, 2]", "normal: [0, 0.1, 2]"},
                                                                                 {"offset: -200", "offset: -201"},
                                                                                 {"file: table.stl", "file: table.stl, solid: false"}}) {
    seen.push_back(of(replaced(all, from, to)));
  }
  std::sort(seen.begin(), seen.end());
  EXPECT_EQ(std::adjacent_find(seen.begin(), seen.end()), seen.end());
  EXPECT_EQ(of(replaced(all, "normal: [0, 0, 2]", "normal: [0, 0, 1]")), of(all)) << "only its direction counts";
}

}  // namespace
}  // namespace interlace::app
