#include "common/model/pose.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/arms.hpp"

namespace interlace::test {
namespace {

using model::Quaternion;
using model::Vector3;

TEST(Pose, RpyTurnsAboutXThenYThenZOfTheWorld) {
  const auto turned = [](const Vector3& rpy, const Vector3& v) -> Vector3 { return model::rotation_from_rpy(rpy) * v; };
  EXPECT_TRUE(turned({0, 0, kPi / 2}, Vector3::UnitX()).isApprox(Vector3::UnitY(), 1e-12)) << "yaw is about z";
  EXPECT_TRUE(turned({0, kPi / 2, 0}, Vector3::UnitZ()).isApprox(Vector3::UnitX(), 1e-12)) << "pitch is about y";
  EXPECT_TRUE(turned({kPi / 2, 0, 0}, Vector3::UnitY()).isApprox(Vector3::UnitZ(), 1e-12)) << "roll is about x";
  EXPECT_TRUE(turned({kPi / 2, 0, kPi / 2}, Vector3::UnitY()).isApprox(Vector3::UnitZ(), 1e-12)) << "roll comes first";
}

TEST(Pose, NearestTurnStaysWithinHalfATurn) {
  EXPECT_NEAR(model::nearest_turn(0.1, 2 * kPi), 0.1 + 2 * kPi, 1e-12);
  EXPECT_NEAR(model::nearest_turn(3, -3), 3 - 2 * kPi, 1e-12);
  Seed seed;
  for (int i = 0; i < 1000; ++i) {
    const double angle = seed.uniform(-20, 20);
    const double reference = seed.uniform(-20, 20);
    const double near = model::nearest_turn(angle, reference);
    EXPECT_LE(std::abs(near - reference), kPi + 1e-9);
    EXPECT_NEAR(std::remainder(near - angle, 2 * kPi), 0, 1e-9);
  }
}

TEST(Pose, AngleBetweenRotationsIsTheShortWay) {
  const Quaternion none = Quaternion::Identity();
  const auto about_z = [](double angle) { return Quaternion{Eigen::AngleAxisd{angle, Vector3::UnitZ()}}; };
  EXPECT_NEAR(model::angle_between(none, about_z(0.3)), 0.3, 1e-12);
  EXPECT_NEAR(model::angle_between(none, about_z(2 * kPi - 0.3)), 0.3, 1e-12);
  EXPECT_NEAR(model::angle_between(none, about_z(kPi)), kPi, 1e-7);
  EXPECT_NEAR(model::angle_between(none, about_z(1e-9)), 1e-9, 1e-15) << "small angles keep their digits";
  const Quaternion q = about_z(0.3);
  EXPECT_NEAR(model::angle_between(q, Quaternion{-q.w(), -q.x(), -q.y(), -q.z()}), 0, 1e-12) << "q and −q are one rotation";
}

}  // namespace
}  // namespace interlace::test
