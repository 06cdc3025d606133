#include "app_client/release_plan.hpp"

#include <algorithm>

namespace interlace::client {

std::vector<PlannedCommand> release_plan(const model::Program& program, const std::string& run) {
  std::vector<PlannedCommand> plan;
  plan.reserve(program.size());
  std::size_t longest = 0;
  for (const auto& [robot, steps] : program.robots) longest = std::max(longest, steps.size());
  std::vector<double> released(program.robots.size(), 0.0);
  for (std::size_t i = 0; i < longest; ++i) {
    for (std::size_t r = 0; r < program.robots.size(); ++r) {
      const auto& [robot, steps] = program.robots[r];
      if (i >= steps.size()) continue;
      released[r] = std::max(released[r], steps[i].at);
      PlannedCommand planned;
      planned.command.id = model::CommandId{run + '.' + std::to_string(plan.size() + 1)};
      planned.command.robot = robot;
      planned.command.motion = steps[i].motion;
      planned.command.priority = steps[i].priority;
      planned.command.deadline = steps[i].deadline;
      planned.release = released[r];
      planned.ordinal = i + 1;
      planned.of = steps.size();
      plan.push_back(std::move(planned));
    }
  }
  std::stable_sort(plan.begin(), plan.end(), [](const PlannedCommand& a, const PlannedCommand& b) { return a.release < b.release; });
  return plan;
}

}  // namespace interlace::client
