#include "planner/core/robot_record.hpp"

namespace interlace::core {

const model::Joints& RobotRecord::joints_after_motion() const {
  return committed ? committed->command.motion->motion().to() : standing->motion().to();
}

const model::Joints& RobotRecord::joints_at_end() const {
  if (!queue.empty()) return queue.back().motion->motion().to();
  return escapes.empty() ? joints_after_motion() : escapes.back().motion->motion().to();
}

Neighbour RobotRecord::as_neighbour(model::RobotIndex index, Instant now) const {
  Neighbour n;
  n.robot = index;
  n.lost = lost();
  n.motion = committed ? committed->command.motion : standing;
  if (committed) {
    n.committed = true;
    n.started = committed->phase == Commitment::Phase::started;
    n.start_from = committed->start_from;
    n.start_until = committed->start_until;
    n.overdue = !n.started && committed->phase == Commitment::Phase::dispatched && now > committed->start_until;
  }
  return n;
}

}  // namespace interlace::core
