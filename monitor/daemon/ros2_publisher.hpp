#pragma once

#include <chrono>
#include <cstdint>

#include "common/dds/participant.hpp"
#include "common/dds/ros2_writer.hpp"
#include "monitor/cell_picture.hpp"

namespace interlace::monitor {

/// Shows a cell to ROS 2's tools, on a DDS domain of its own (docs/ros2.md). What never changes is written at once; the rest by show().
/// One thread builds it, uses it and destroys it.
class Ros2Publisher {
 public:
  using Clock = std::chrono::steady_clock;

  static constexpr std::chrono::milliseconds kMarkerPeriod{100};
  static constexpr std::chrono::milliseconds kDiagnosticsPeriod{1000};

  /// Throws std::runtime_error when DDS cannot be joined.
  Ros2Publisher(const model::Cell& cell, std::uint32_t domain);

  /// Joints and frames with each call, markers and diagnostics in their periods; diagnostics also as soon as a level changes.
  void show(const CellPicture& picture, Clock::time_point now);

 private:
  dds::Participant participant_;
  dds::Ros2Writer<ros2::String> description_;
  dds::Ros2Writer<ros2::MarkerArray> fixtures_, capsules_;
  dds::Ros2Writer<ros2::TFMessage> fixed_frames_, frames_;
  dds::Ros2Writer<ros2::JointState> joints_;
  dds::Ros2Writer<ros2::DiagnosticArray> diagnostics_;
  ros2::DiagnosticArray told_;
  Clock::time_point next_markers_{}, next_diagnostics_{};
};

}  // namespace interlace::monitor
