#include "common/app/config/model_text.hpp"

#include <gtest/gtest.h>

#include "common/app/config/cell_file.hpp"
#include "tests/support/arms.hpp"
#include "tests/support/seed.hpp"

namespace interlace::app {
namespace {

using model::LinkCapsule;
using model::RobotModel;

constexpr double kDigits = 1e-10;  // [m], [rad] of twelve significant digits in mm and deg, of numbers below 10

/// What the reader makes of `text` in a cell with one robot, standing in the middle of its limits.
RobotModel read_back(const std::string& text, const RobotModel& model) {
  const model::Joints middle = (model.joints.min + model.joints.max) / 2 * 180 / model::kPi;
  std::ostringstream cell;
  cell << "interlace: 1\nunits: {length: mm, angle: deg}\ncell: c\n"
       << text << "robots:\n  - name: r1\n    model: " << model.name
       << "\n    base: {xyz: [0, 0, 0], rpy: [0, 0, 0]}\n    start: {joints: ["
       << middle.transpose().format(Eigen::IOFormat{12, Eigen::DontAlignCols, ", "}) << "]}\n    tcp: {velocity: 1, acceleration: 1}\n";
  const auto loaded = parse_cell(cell.str(), "cell.yaml");
  EXPECT_TRUE(loaded) << cell.str() << (loaded ? "" : to_string(loaded.error()));
  return loaded ? loaded->cell.robots.at(0).model : RobotModel{};
}

void expect_same(const std::optional<model::Joints>& found, const std::optional<model::Joints>& expected) {
  ASSERT_EQ(found.has_value(), expected.has_value());
  const model::Joints none = model::Joints::Zero();
  EXPECT_LT((found.value_or(none) - expected.value_or(none)).norm(), kDigits);
}

void expect_same(const RobotModel& found, const RobotModel& expected) {
  const auto& p = found.kinematics.parameters();
  const auto& e = expected.kinematics.parameters();
  EXPECT_EQ(found.name, expected.name);
  for (const auto& [x, y] : {std::pair{p.a1, e.a1}, {p.a2, e.a2}, {p.b, e.b}, {p.c1, e.c1}, {p.c2, e.c2}, {p.c3, e.c3}, {p.c4, e.c4}}) {
    EXPECT_NEAR(x, y, kDigits);
  }
  for (std::size_t i = 0; i < model::kJoints; ++i) EXPECT_NEAR(p.offsets[i], e.offsets[i], kDigits);
  EXPECT_EQ(p.signs, e.signs);
  EXPECT_LT((found.joints.min - expected.joints.min).norm(), kDigits);
  EXPECT_LT((found.joints.max - expected.joints.max).norm(), kDigits);
  expect_same(found.joints.velocity, expected.joints.velocity);
  expect_same(found.joints.acceleration, expected.joints.acceleration);
  EXPECT_TRUE(found.X_FT.isApprox(expected.X_FT, kDigits));
  ASSERT_EQ(found.capsules.size(), expected.capsules.size());
  for (std::size_t i = 0; i < expected.capsules.size(); ++i) {
    const LinkCapsule& c = found.capsules[i];
    const LinkCapsule& d = expected.capsules[i];
    EXPECT_EQ(c.name, d.name);
    EXPECT_EQ(c.link, d.link);
    EXPECT_LT((c.a - d.a).norm(), kDigits);
    EXPECT_LT((c.b - d.b).norm(), kDigits);
    EXPECT_NEAR(c.radius, d.radius, kDigits);
  }
  EXPECT_EQ(found.self_pairs, expected.self_pairs);
}

TEST(ModelText, IsReadBackAsTheSameModel) {
  test::Seed seed{51};
  for (int i = 0; i < 100; ++i) {
    RobotModel m = test::random_arm(seed);
    for (LinkCapsule& c : m.capsules) c.radius = seed.uniform(1e-5, 1e-4);  // so thin that the reader sees no collision with itself
    m.self_pairs = model::default_self_pairs(m.capsules);
    if (seed.chance(0.5)) m.joints.velocity = model::Joints::Constant(seed.uniform(0.1, 5));
    if (seed.chance(0.5)) m.joints.acceleration = model::Joints::Constant(seed.uniform(0.1, 5));
    if (seed.chance(0.5)) m.self_pairs = {{0, 4}, {1, 6}};
    if (seed.chance(0.2)) m.self_pairs.clear();
    if (seed.chance(0.2)) m.X_FT = model::Pose::Identity();
    expect_same(read_back(model_text(m, "A comment\nof two lines"), m), m);
    if (testing::Test::HasFailure()) FAIL() << "seed " << seed.value() << ", model " << i << "\n" << model_text(m);
  }
}

TEST(ModelText, LooksAsAPersonWouldWriteIt) {
  RobotModel m;
  m.name = "small";
  m.kinematics = model::Kinematics{{0, -0.07, 0, 0.29, 0.27, 0.302, 0.072, {0, 0, -model::kPi / 2, 0, 0, 0}, {1, 1, -1, 1, 1, 1}}};
  m.capsules = {{"base", 0, {0, 0, 0}, {0, 0, 0.1664}, 0.09}};
  m.self_pairs = model::default_self_pairs(m.capsules);
  EXPECT_EQ(model_text(m, "Fitted."),
            "# Fitted.\n"
            "models:  # lengths in mm, angles in deg\n"
            "  small:\n"
            "    kinematics: {type: opw, a1: 0, a2: -70, b: 0, c1: 290, c2: 270, c3: 302, c4: 72, offsets: [0, 0, -90, 0, 0, 0], "
            "signs: [1, 1, -1, 1, 1, 1]}\n"
            "    joints: {min: [-360, -360, -360, -360, -360, -360], max: [360, 360, 360, 360, 360, 360]}\n"
            "    capsules:\n"
            "      - {name: base, link: 0, from: [0, 0, 0], to: [0, 0, 166.4], radius: 90}\n");
}

}  // namespace
}  // namespace interlace::app
