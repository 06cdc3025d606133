#include "planner/core/robot_record.hpp"

namespace interlace::core {

const model::Joints& RobotRecord::joints_after_motion() const {
  if (following) return following->command.motion->motion().to();
  return committed ? committed->command.motion->motion().to() : standing->motion().to();
}

const model::Joints& RobotRecord::joints_at_end() const {
  if (!queue.empty()) return queue.back().motion->motion().to();
  return escapes.empty() ? joints_after_motion() : escapes.back().motion->motion().to();
}

model::ToolSet RobotRecord::tools_after_motion() const {
  if (following) return following->command.tools.after;
  return committed ? committed->command.tools.after : tools;
}

model::ToolSet RobotRecord::tools_at_end() const {
  return queue.empty() ? tools_after_motion() : queue.back().tools.after;  // an escape changes nothing
}

void RobotRecord::add_as_neighbour(model::RobotIndex index, Instant now, std::vector<Neighbour>& out) const {
  Neighbour n;
  n.robot = index;
  n.lost = lost();
  n.reach = reach;
  n.motion = standing;
  const auto add = [&](const Commitment& c) {
    n.motion = c.command.motion;
    n.committed = true;
    n.started = c.phase == Commitment::Phase::started;
    n.start_from = c.start_from;
    n.start_until = c.start_until;
    n.overdue = !n.started && c.phase == Commitment::Phase::dispatched && now > c.start_until;
    out.push_back(n);
  };
  if (!committed) out.push_back(n);
  if (committed) add(*committed);
  if (following) add(*following);
}

}  // namespace interlace::core
