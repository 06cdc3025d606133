#include "common/model/bodies.hpp"

namespace interlace::model {

namespace {

constexpr std::size_t kUpperArm = 2;  ///< the last link that a tool is kept off

}  // namespace

Robot with_tools(const Robot& robot, const std::vector<Tool>& tools, ToolSet held) {
  Robot body = robot;
  const std::size_t own = body.model.capsules.size();
  for (std::size_t i = 0; i < tools.size(); ++i) {
    if (!held.has(i)) continue;
    for (const LinkCapsule& capsule : tools[i].capsules) {
      for (std::size_t k = 0; k < own; ++k) {
        if (body.model.capsules[k].link <= kUpperArm) body.model.self_pairs.emplace_back(k, body.model.capsules.size());
      }
      body.model.capsules.push_back(capsule);
    }
  }
  body.tools = held;
  return body;
}

const Robot& Bodies::of(RobotIndex robot, ToolSet held) {
  const Robot& bare = cell_->robots[robot];
  if (held.empty()) return bare;
  std::unique_ptr<const Robot>& body = made_[robot][held];
  if (!body) body = std::make_unique<const Robot>(with_tools(bare, cell_->tools, held));
  return *body;
}

MotionBodies MotionBodies::of(Bodies& bodies, RobotIndex robot, const ToolSteps& steps) {
  return {&bodies.of(robot, steps.at_start()), &bodies.of(robot, steps.during), &bodies.of(robot, steps.at_end()),
          &bodies.of(robot, steps.after), &bodies.of(robot, steps.all())};
}

Result<ToolSteps, std::string> tool_steps(const Cell& cell, const RobotName& robot, ToolSet held, const std::optional<ToolChange>& change) {
  ToolSteps steps{held, held, held};
  if (!change) return steps;
  ToolSet changed = held;
  for (const ToolName* name : {&change->detach, &change->attach}) {
    if (name->empty()) continue;
    const auto tool = cell.find(*name);
    if (!tool) return unexpected("there is no tool \"" + name->str() + "\" in cell " + cell.name);
    const bool leaves = name == &change->detach;
    if (held.covers(*tool) != leaves) {
      return unexpected(robot.str() + (leaves ? " would leave " : " would take ") + name->str() +
                        (leaves ? ", which it will not hold then" : ", which it will hold already"));
    }
    changed = leaves ? changed.without(*tool) : changed | *tool;
  }
  steps.after = changed;
  if (change->when == ToolTime::start) steps.during = changed;
  return steps;
}

}  // namespace interlace::model
