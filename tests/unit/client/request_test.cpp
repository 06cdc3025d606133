#include "app_client/request.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace interlace::client {
namespace {

const app::Units kMmDeg = make_units("mm", "deg");

TEST(MakeRequest, LinearInMillimetresAndDegrees) {
  const auto r = make_request({"linear", {300, -250, 330, 0, 0, 90}, 50.0, 200.0}, kMmDeg);
  ASSERT_TRUE(r) << r.error();
  const auto& X_WT = std::get<model::LinearTarget>(r->target).X_WT;
  EXPECT_NEAR((X_WT.translation() - model::Vector3{0.3, -0.25, 0.33}).norm(), 0, 1e-12);
  EXPECT_NEAR((X_WT.linear() * model::Vector3::UnitX() - model::Vector3::UnitY()).norm(), 0, 1e-12);
  EXPECT_DOUBLE_EQ(*r->velocity, 0.05);
  EXPECT_DOUBLE_EQ(*r->acceleration, 0.2);
}

TEST(MakeRequest, LinearInMetresAndRadians) {
  const auto r = make_request({"linear", {0.3, -0.25, 0.33, model::kPi, 0, 0}, 0.05, {}}, make_units("m", "rad"));
  ASSERT_TRUE(r) << r.error();
  const auto& X_WT = std::get<model::LinearTarget>(r->target).X_WT;
  EXPECT_NEAR((X_WT.translation() - model::Vector3{0.3, -0.25, 0.33}).norm(), 0, 1e-12);
  EXPECT_NEAR((X_WT.linear() * model::Vector3::UnitY() + model::Vector3::UnitY()).norm(), 0, 1e-12);
  EXPECT_DOUBLE_EQ(*r->velocity, 0.05);
  EXPECT_FALSE(r->acceleration);
}

TEST(MakeRequest, JointsAreAnglesOnly) {
  const auto r = make_request({"joint", {0, 90, -90, 180, 45, 0}, {}, {}}, make_units("m", "deg"));
  ASSERT_TRUE(r) << r.error();
  const auto& q = std::get<model::JointTarget>(r->target).q;
  EXPECT_NEAR(q[1], model::kPi / 2, 1e-12);
  EXPECT_NEAR(q[2], -model::kPi / 2, 1e-12);
  EXPECT_NEAR(q[3], model::kPi, 1e-12);
}

TEST(MakeRequest, SaysWhatIsTakenAndLeftAndWhen) {
  MotionWords words{"linear", {300, -250, 330, 0, 0, 90}, {}, {}};
  EXPECT_FALSE(make_request(words, kMmDeg)->tools);
  words.attach = "long";
  ASSERT_TRUE(make_request(words, kMmDeg)->tools);
  EXPECT_EQ(make_request(words, kMmDeg)->tools->attach, model::ToolName{"long"});
  EXPECT_EQ(make_request(words, kMmDeg)->tools->when, model::ToolTime::completion);
  words.detach = "short";
  words.when = "start";
  EXPECT_EQ(make_request(words, kMmDeg)->tools->detach, model::ToolName{"short"});
  EXPECT_EQ(make_request(words, kMmDeg)->tools->when, model::ToolTime::start);
  words.attach = "a/b";
  EXPECT_NE(make_request(words, kMmDeg).error().find("--attach: found \"a/b\""), std::string::npos);
}

TEST(MakeRequest, NamesTheNumberThatIsWrong) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  const auto error = [&](const MotionWords& words) {
    const auto r = make_request(words, kMmDeg);
    return r ? std::string{"accepted"} : r.error();
  };
  EXPECT_NE(error({"linear", {1, nan, 3, 0, 0, 0}, {}, {}}).find("Y: found nan"), std::string::npos);
  EXPECT_NE(error({"linear", {1, 2, 3, 0, 0, inf}, {}, {}}).find("YAW: found inf"), std::string::npos);
  EXPECT_NE(error({"joint", {1, 2, nan, 0, 0, 0}, {}, {}}).find("J3: found nan"), std::string::npos);
  EXPECT_NE(error({"linear", {1e12, 2, 3, 0, 0, 0}, {}, {}}).find("X: found 1e+12"), std::string::npos);
  EXPECT_NE(error({"linear", {1, 2, 3, 0, 0, 0}, 0.0, {}}).find("--velocity: found 0"), std::string::npos);
  EXPECT_NE(error({"linear", {1, 2, 3, 0, 0, 0}, {}, -1.0}).find("--acceleration: found -1"), std::string::npos);
  EXPECT_NE(error({"linear", {1, 2, 3}, {}, {}}).find("expected six"), std::string::npos);
  EXPECT_NE(error({"hop", {1, 2, 3, 0, 0, 0}, {}, {}}).find("expected linear or joint"), std::string::npos);
}

TEST(MakeUnits, KnowsTwoOfEach) {
  EXPECT_THROW((void)make_units("inch", "deg"), std::invalid_argument);
  EXPECT_THROW((void)make_units("mm", "turn"), std::invalid_argument);
}

}  // namespace
}  // namespace interlace::client
