#include "monitor/live_view.hpp"
#include "monitor/waiting.hpp"

namespace interlace::monitor {

CellPicture LiveView::picture() const {
  CellPicture picture;
  picture.cell = &cell_.cell;
  picture.planner_heard = planner_heard_lately();
  picture.planner = planner_;
  picture.alarms = alarms_.all();
  for (model::RobotIndex i = 0; i < seen_.size(); ++i) {
    const Seen& seen = seen_[i];
    RobotPicture robot;
    robot.body = placed_[i].robot != nullptr ? placed_[i].robot : &cell_.cell.robots[i];
    robot.posture = seen.posture;
    robot.heard = heard_lately(seen);
    robot.stranger = seen.stranger;
    robot.capsules = placed_[i].bodies;
    robot.clearance = near_.capsules[i];
    if (planner_ && i < planner_->robots.size()) robot.status = planner_->robots[i];
    const CommandRecord* record = commands_.held_up(cell_.cell.robots[i].name, now_);
    const auto zero = record != nullptr ? line_.zero_of(record->planner) : std::nullopt;
    if (zero) robot.waiting = waiting_sentence(*record, *zero, now_);
    picture.robots.push_back(std::move(robot));
  }
  return picture;
}

}  // namespace interlace::monitor
