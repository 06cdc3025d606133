// Slower at once, where that is done sooner than after a wait.
#include "planner/core/outlook.hpp"

#include <algorithm>
#include <array>

#include "planner/core/outlook_work.hpp"

namespace interlace::core {

using model::RobotIndex;

namespace {

constexpr double kShortestWait = 0.1;                       // [s] instead of which somebody may go slower
constexpr std::array<double, 3> kSpeeds{0.05, 0.35, 0.65};  // tried, between as slow as waiting and as fast as can be

}  // namespace

/// `plan` with its start `which`, of a command that waits where its robot stands, at `part` of its speed and at once.
std::optional<OutlookPlan> Outlook::with_slower(const OutlookPlan& plan, std::size_t which, double part) {
  const RobotIndex robot = plan.starts[which].robot;
  const WaitingMotion& command = robots_[robot].queue.front();
  const model::TcpLimits& most = cell_.robots[robot].tcp;
  WaitingMotion slower{command.request, nullptr};
  slower.request.velocity = part * command.request.velocity.value_or(most.velocity);
  slower.request.acceleration = part * part * command.request.acceleration.value_or(most.acceleration);
  slower.motion = admitted(robot, command.motion->bodies(), command.motion->motion().from(), slower.request);
  if (!slower.motion || !same_place(slower.motion->motion().to(), command.motion->motion().to())) return std::nullopt;
  OutlookPlan changed = plan;
  PlannedStart first = changed.starts[which];
  first.slower = std::move(slower);
  changed.starts.erase(changed.starts.begin() + static_cast<std::ptrdiff_t>(which));
  changed.starts.insert(changed.starts.begin(), std::move(first));
  return follow(changed);
}

std::optional<OutlookPlan> Outlook::slowed_down(const OutlookPlan& plan, std::size_t budget, MapStore& maps) {
  maps_ = &maps;
  work_ = 0;
  map_work_ = 0;
  std::optional<OutlookPlan> best;
  for (RobotIndex robot = 0; robot < robots_.size(); ++robot) {
    const double slowest = cell_.robots[robot].tcp.slowest;
    const auto& starts = plan.starts;
    const auto first = std::find_if(starts.begin(), starts.end(), [&](const PlannedStart& s) { return s.robot == robot; });
    if (slowest >= 1 || first == starts.end() || first->detour || first->slower || robots_[robot].seen.back().committed) continue;
    const SampledMotionPtr& motion = robots_[robot].queue.front().motion;
    const double duration = motion->motion().duration(), wait = model::to_seconds(first->start - robots_[robot].free);
    if (!motion->motion().is_linear() || wait < kShortestWait) continue;
    const double as_late = duration / (duration + wait);  // as slow as this it is done no sooner than after the wait
    for (const double share : kSpeeds) {
      const double part = as_late + share * (1 - as_late);
      if (part < slowest) continue;
      if (work_ + map_work_ > budget) return best;
      auto slower = with_slower(plan, static_cast<std::size_t>(first - starts.begin()), part);
      if (slower && slower->better_than(best ? *best : plan)) best = std::move(slower);
    }
  }
  return best;
}

}  // namespace interlace::core
