#include "common/mesh/mesh.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/e2e/scratch.hpp"
#include "tests/support/shapes.hpp"

// What comes in from files of shapes, and what does not.
namespace interlace::test {
namespace {

constexpr double kMillimetres = 0.001;

Mesh read(const std::string& path, double scale = kMillimetres) {
  const auto read = mesh::read_mesh(path, scale);
  EXPECT_TRUE(read) << (read ? "" : to_string(read.error()));
  return read.value_or(Mesh{});
}

/// Corner `k` of triangle `t` of both lies at the same place, to the single precision of the files.
void expect_same_surface(const Mesh& found, const Mesh& expected) {
  ASSERT_EQ(found.triangles.size(), expected.triangles.size());
  EXPECT_EQ(found.vertices.size(), expected.vertices.size()) << "corners at one place are one vertex";
  for (std::size_t t = 0; t < expected.triangles.size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const Vector3& p = found.vertices.at(found.triangles[t][k]);
      const Vector3& q = expected.vertices.at(expected.triangles[t][k]);
      EXPECT_LT((p - q).norm(), 1e-6 * q.norm()) << "triangle " << t << ", corner " << k;
    }
  }
}

class ReadMesh : public testing::Test {
 protected:
  std::string refusal(const std::string& name, const std::string& text) { return refusal_of(scratch_.file(name, text)); }
  std::string refusal_of(const std::string& path) {
    const auto read = mesh::read_mesh(path, kMillimetres);
    if (read) return "accepted";
    EXPECT_EQ(read.error().file, path);
    EXPECT_EQ(to_string(read.error()), path + ": " + read.error().rule);
    return read.error().rule;
  }
  Scratch scratch_;
};

TEST_F(ReadMesh, AllFormatsGiveTheSameSurface) {
  for (const Mesh& shape : {box({0.1, 0.2, 0.3}), cylinder(0.05, 0.4), bent_pipe(0.2, 0.03, 2 * model::kPi)}) {
    expect_same_surface(read(scratch_.file("shape.stl", ascii_stl(shape))), shape);
    expect_same_surface(read(scratch_.file("binary.stl", binary_stl(shape))), shape);
    expect_same_surface(read(scratch_.file("shape.obj", obj(shape))), shape);
    expect_same_surface(read(scratch_.file("SHAPE.STL", binary_stl(shape, 1)), 1), shape);
  }
}

TEST_F(ReadMesh, PolygonsAndLinesAreSolidToo) {
  const Mesh square = read(scratch_.file("square.obj", "v 0 0 0\nv 9 0 0\nv 9 9 0\nv 0 9 0\nf 1 2 3 4\n"));
  EXPECT_EQ(square.vertices.size(), 4U);
  EXPECT_EQ(square.triangles.size(), 2U);
  const Mesh arrow = read(scratch_.file("arrow.obj", "v 0 0 0\nv 9 9 0\nv 0 3 0\nv -9 9 0\nf 2 3 4 1\n"));
  EXPECT_EQ(arrow.vertices.size(), 4U) << "a polygon that is not convex";
  EXPECT_EQ(arrow.triangles.size(), 2U);
  const Mesh flag = read(scratch_.file("flag.obj", "v 0 0 0\nv 9 0 0\nv 9 9 0\nv 0 -99 0\nf 1 2 3\nl 1 4\n"));
  ASSERT_EQ(flag.vertices.size(), 4U) << "the pole of the flag";
  EXPECT_EQ(flag.triangles.size(), 2U);
  EXPECT_TRUE(std::any_of(flag.vertices.begin(), flag.vertices.end(), [](const Vector3& p) { return p.y() < -0.09; }));
}

TEST_F(ReadMesh, SeveralBodiesArriveTogether) {
  const Mesh two = together(box({0.1, 0.1, 0.1}), moved(box({0.1, 0.1, 0.1}), model::make_pose({1, 0, 0}, model::Quaternion::Identity())));
  const std::string text = "o first\n" + obj(box({0.1, 0.1, 0.1})) + "o second\nv 2000 0 0\nv 2001 0 0\nv 2000 1 0\nf 9 10 11\n";
  EXPECT_EQ(read(scratch_.file("two.stl", ascii_stl(two))).vertices.size(), 16U);
  EXPECT_EQ(read(scratch_.file("two.obj", text)).triangles.size(), 13U);
}

TEST_F(ReadMesh, AMaterialLibraryIsNotLookedFor) {
  scratch_.file("shape.mtl", "newmtl red\nKd 1 0 0\n");
  expect_same_surface(read(scratch_.file("shape.obj", "mtllib shape.mtl\n" + obj(box({1, 1, 1})))), box({1, 1, 1}));
}

TEST_F(ReadMesh, RefusesWhatIsNoFile) {
  EXPECT_EQ(refusal_of(scratch_.path("missing.stl")), "no such file");
  EXPECT_EQ(refusal_of(scratch_.path("")), "is not a regular file");
  EXPECT_EQ(refusal("shape.dae", "<COLLADA/>"), "expected an .stl or .obj file");
  EXPECT_EQ(refusal("shape", ""), "expected an .stl or .obj file");
}

TEST_F(ReadMesh, RefusesWhatIsNotWhatItsNameSays) {
  EXPECT_EQ(refusal("empty.stl", "").substr(0, 22), "cannot be read as .stl");
  EXPECT_EQ(refusal("text.stl", "Dear reader,\n").substr(0, 22), "cannot be read as .stl");
  const std::string whole = binary_stl(box({1, 1, 1}));
  EXPECT_EQ(refusal("torn.stl", whole.substr(0, whole.size() - 60)).substr(0, 22), "cannot be read as .stl");
}

TEST_F(ReadMesh, RefusesASurfaceOfNothing) {
  const auto nothing = [](const std::string& rule) {
    return rule.find("no triangles") != std::string::npos || rule.find("cannot be read as") == 0;
  };
  EXPECT_PRED1(nothing, refusal("empty.obj", ""));
  EXPECT_PRED1(nothing, refusal("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n"));
  EXPECT_PRED1(nothing, refusal("empty.stl", "solid shape\nendsolid shape\n"));
  EXPECT_PRED1(nothing, refusal("binary.stl", binary_stl(Mesh{})));
}

TEST_F(ReadMesh, RefusesWhatIsNoPlace) {
  Mesh shape = box({1, 1, 1});
  shape.vertices[3].y() = std::nan("");
  EXPECT_EQ(refusal("nan.stl", binary_stl(shape)), "a coordinate is not a finite number");
  EXPECT_EQ(refusal("nan.obj", obj(shape)), "a coordinate is not a finite number");
  shape.vertices[3].y() = INFINITY;
  EXPECT_EQ(refusal("infinite.stl", binary_stl(shape)), "a coordinate is not a finite number");
  shape.vertices[3].y() = 1001;
  EXPECT_EQ(refusal("far.obj", obj(shape)), "a coordinate lies beyond 1000 m: are the units right?");
}

}  // namespace
}  // namespace interlace::test
