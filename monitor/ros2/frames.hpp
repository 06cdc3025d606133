#pragma once

#include <cstddef>
#include <string>

#include "common/ros2/messages.hpp"
#include "monitor/cell_picture.hpp"

/// Joints and frames of a cell as ROS 2's tools name them. Every robot's begin with its name and '_'. The frames of an arm are those of
/// model::LinkFrames: base, link1 … link6 (the flange), and tcp; all of them hang from `world`. Pure.
namespace interlace::monitor {

inline constexpr const char* kWorldFrame = "world";

/// "r1_joint1"; `joint` 0 … 5, base to flange.
[[nodiscard]] std::string joint_name(const model::RobotName& robot, std::size_t joint);
/// "r1_base", "r1_link6"; `link` 0 … 6.
[[nodiscard]] std::string link_frame(const model::RobotName& robot, std::size_t link);
/// "r1_tcp".
[[nodiscard]] std::string tcp_frame(const model::RobotName& robot);

[[nodiscard]] ros2::Pose to_ros2(const model::Pose& X);
[[nodiscard]] ros2::Header world_header(ros2::Time stamp);

/// Joints [rad] of the robots that are heard: those of one that is silent are left out, not told again.
[[nodiscard]] ros2::JointState joint_states(const CellPicture& picture, ros2::Time stamp);

/// Frames of the links of the robots that are heard, each in the one before it.
[[nodiscard]] ros2::TFMessage moving_frames(const CellPicture& picture, ros2::Time stamp);

/// What never moves: the bases in the world, the TCPs on their flanges.
[[nodiscard]] ros2::TFMessage fixed_frames(const model::Cell& cell, ros2::Time stamp);

}  // namespace interlace::monitor
