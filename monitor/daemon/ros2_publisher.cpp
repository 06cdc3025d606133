#include "monitor/daemon/ros2_publisher.hpp"

#include <string>
#include <utility>

#include "common/app/logging.hpp"
#include "common/ros2/names.hpp"
#include "monitor/ros2/diagnostics.hpp"
#include "monitor/ros2/frames.hpp"
#include "monitor/ros2/markers.hpp"
#include "monitor/ros2/robot_description.hpp"

namespace interlace::monitor {

namespace {

constexpr bool kLatched = true;

/// By the wall clock: the only one that those who look on share with us.
ros2::Time stamp_now() {
  const auto since_epoch = std::chrono::system_clock::now().time_since_epoch();
  const auto seconds = std::chrono::floor<std::chrono::seconds>(since_epoch);
  const auto rest = std::chrono::duration_cast<std::chrono::nanoseconds>(since_epoch - seconds);
  return {static_cast<std::int32_t>(seconds.count()), static_cast<std::uint32_t>(rest.count())};
}

std::string topic_of(const model::Cell& cell, const char* kind) {
  return "/" + ros2::topic_part(cell.name) + "/" + kind;
}

}  // namespace

Ros2Publisher::Ros2Publisher(const model::Cell& cell, std::uint32_t domain)
    : participant_({domain, "interlace-monitor " + cell.name}),
      description_(participant_, {topic_of(cell, "robot_description"), kLatched, 1}),
      fixtures_(participant_, {topic_of(cell, "fixtures"), kLatched, 1}),
      capsules_(participant_, {topic_of(cell, "capsules"), kLatched, 1}),
      fixed_frames_(participant_, {"/tf_static", kLatched, 1}),
      frames_(participant_, {"/tf", !kLatched, 100}),
      joints_(participant_, {topic_of(cell, "joint_states")}),
      diagnostics_(participant_, {"/diagnostics"}) {
  const ros2::Time stamp = stamp_now();
  description_.write({robot_description(cell)});
  fixtures_.write(fixture_markers(cell, stamp));
  fixed_frames_.write(fixed_frames(cell, stamp));
  app::log(app::LogLevel::info, "ros2", {{"domain", domain}, {"joint_states", topic_of(cell, "joint_states")}});
}

void Ros2Publisher::show(const CellPicture& picture, Clock::time_point now) {
  const ros2::Time stamp = stamp_now();
  if (const auto joints = joint_states(picture, stamp); !joints.name.empty()) {
    joints_.write(joints);
    frames_.write(moving_frames(picture, stamp));
  }
  if (now >= next_markers_) {
    capsules_.write(capsule_markers(picture, stamp));
    next_markers_ = now + kMarkerPeriod;
  }
  auto diagnosed = diagnostics(picture, stamp);
  if (now >= next_diagnostics_ || differ_in_level(diagnosed, told_)) {
    diagnostics_.write(diagnosed);
    told_ = std::move(diagnosed);
    next_diagnostics_ = now + kDiagnosticsPeriod;
  }
}

}  // namespace interlace::monitor
