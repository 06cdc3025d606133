#include "common/ros2/names.hpp"

#include <gtest/gtest.h>

namespace interlace::ros2 {
namespace {

TEST(Ros2Names, APartOfATopicHasLettersDigitsAndUnderscores) {
  EXPECT_EQ(topic_part("exp-6-2"), "exp_6_2");
  EXPECT_EQ(topic_part("a.b:C_9"), "a_b_C_9");
  EXPECT_EQ(topic_part("4-arms"), "_4_arms") << "it must not begin with a digit";
}

TEST(Ros2Names, OnDds) {
  EXPECT_EQ(dds_topic("/exp_6_2/joint_states"), "rt/exp_6_2/joint_states");
  EXPECT_EQ(dds_type("sensor_msgs/msg/JointState"), "sensor_msgs::msg::dds_::JointState_");
}

}  // namespace
}  // namespace interlace::ros2
