#pragma once

#include <cstdint>
#include <deque>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <vector>

#include "common/model/bodies.hpp"
#include "planner/core/sampled_motion.hpp"

namespace interlace::monitor {

/// A motion that a robot made, makes or is going to make. Times [s] on the observer's line.
struct KnownMotion {
  model::CommandId id;
  std::uint32_t attempt = 0;
  bool dispatched = false;  ///< sent to its proxy; else only decided, and planned here from the client's request
  bool escape = false;
  double earliest = 0, latest = 0;  ///< start window; equal when only the start is known
  std::optional<double> started, ended;
  core::SampledMotionPtr motion;

  [[nodiscard]] double start() const { return started.value_or(earliest); }
  [[nodiscard]] double end() const { return ended.value_or(start() + motion->motion().duration()); }
};

/// What the robots of a cell were seen to be told: their latest motions, planned again from the dispatches, so that a viewer needs no
/// kinematics and a collision map can be shown. Pure. Not thread-safe.
class MotionBook {
 public:
  static constexpr std::size_t kKept = 24;  ///< of each robot

  /// `cell` must outlive it.
  explicit MotionBook(const model::Cell& cell) : cell_(cell), bodies_(cell), motions_(cell.robots.size()) {}

  /// Null when the dispatch names a robot or asks for a motion that cannot be. What is returned stays where it is until the next call.
  const KnownMotion* on_dispatch(const model::Dispatch& dispatch, double earliest, double latest);
  /// A start is decided and not yet sent; the robot stands at `from` and holds `held`.
  const KnownMotion* on_decision(const model::CommandId& id, const model::RobotName& robot, const model::MotionRequest& request,
                                 const model::Joints& from, model::ToolSet held, double start);
  /// Whether it is known. A refused, withdrawn or failed one is forgotten.
  bool on_execution(const model::ExecutionReported& report, double at);
  /// A decision that was taken back; with `dispatched_too` also one that had been sent. False when it was not known, or has started and
  /// goes on.
  bool forget(const model::RobotName& robot, const model::CommandId& id, bool dispatched_too);

  [[nodiscard]] const std::deque<KnownMotion>& of(model::RobotIndex robot) const { return motions_[robot]; }
  [[nodiscard]] const KnownMotion* find(model::RobotIndex robot, const model::CommandId& id) const;
  /// Not over yet, of all robots.
  [[nodiscard]] std::vector<const KnownMotion*> coming(double now) const;

  /// `request` of a robot standing at `from`, as the maps need it; empty when it cannot be.
  [[nodiscard]] core::SampledMotionPtr plan(model::RobotIndex robot, const model::Joints& from, model::ToolSet held,
                                            const model::MotionRequest& request);
  /// Standing at `q`.
  [[nodiscard]] core::SampledMotionPtr rest(model::RobotIndex robot, const model::Joints& q, model::ToolSet held);
  /// The robot with what it holds.
  [[nodiscard]] const model::Robot& body(model::RobotIndex robot, model::ToolSet held) { return bodies_.of(robot, held); }

 private:
  const KnownMotion* keep(model::RobotIndex robot, KnownMotion motion);

  const model::Cell& cell_;
  model::Bodies bodies_;
  std::vector<std::deque<KnownMotion>> motions_;  // in the order they were heard of
};

/// A ghost for the page: the way of the TCP and the bodies at a few places of it (docs/monitor.md).
[[nodiscard]] nlohmann::json to_json(const KnownMotion& motion);

/// The ends of capsules one after the other, as frames have them [m].
[[nodiscard]] nlohmann::json ends_json(const std::vector<model::Capsule>& capsules);

}  // namespace interlace::monitor
