#include "monitor/motion_book.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "monitor/numbers.hpp"

namespace interlace::monitor {

namespace {

constexpr const char* kEscapePrefix = "escape-";  // of ids of escapes: idl/README.md
constexpr int kGhosts = 6;                        // bodies shown along a sweep
constexpr int kPathPoints = 24;

bool is_escape(const model::CommandId& id) {
  return id.str().rfind(kEscapePrefix, 0) == 0;
}

}  // namespace

core::SampledMotionPtr MotionBook::plan(model::RobotIndex robot, const model::Joints& from, model::ToolSet held,
                                        const model::MotionRequest& request) {
  const auto steps = model::tool_steps(cell_, cell_.robots[robot].name, held, request.tools);
  if (!steps) return nullptr;
  const auto motion = model::plan_motion(bodies_.of(robot, steps->during), from, request);
  if (!motion) return nullptr;
  return std::make_shared<core::SampledMotion>(*motion, cell_.planning.resolution, model::MotionBodies::of(bodies_, robot, *steps));
}

core::SampledMotionPtr MotionBook::rest(model::RobotIndex robot, const model::Joints& q, model::ToolSet held) {
  return std::make_shared<core::SampledMotion>(model::Motion::rest(bodies_.of(robot, held), q), cell_.planning.resolution);
}

const KnownMotion* MotionBook::keep(model::RobotIndex robot, KnownMotion motion) {
  auto& kept = motions_[robot];
  kept.erase(std::remove_if(kept.begin(), kept.end(), [&](const KnownMotion& m) { return m.id == motion.id && !m.started; }), kept.end());
  kept.push_back(std::move(motion));
  if (kept.size() > kKept) kept.pop_front();
  return &kept.back();
}

const KnownMotion* MotionBook::on_dispatch(const model::Dispatch& d, double earliest, double latest) {
  const auto robot = cell_.find(d.robot);
  if (!robot) return nullptr;
  if (const KnownMotion* known = find(*robot, d.id); known != nullptr && known->dispatched && known->attempt == d.attempt) return known;
  KnownMotion motion;
  motion.id = d.id;
  motion.attempt = d.attempt;
  motion.dispatched = true;
  motion.escape = is_escape(d.id);
  motion.earliest = earliest;
  motion.latest = latest;
  motion.motion = plan(*robot, d.from, cell_.set_of(d.holds), d.motion);
  return motion.motion ? keep(*robot, std::move(motion)) : nullptr;
}

const KnownMotion* MotionBook::on_decision(const model::CommandId& id, const model::RobotName& name, const model::MotionRequest& request,
                                           const model::Joints& from, model::ToolSet held, double start) {
  const auto robot = cell_.find(name);
  if (!robot) return nullptr;
  if (const KnownMotion* known = find(*robot, id); known != nullptr && (known->dispatched || known->earliest == start)) return known;
  KnownMotion motion;
  motion.id = id;
  motion.escape = is_escape(id);
  motion.earliest = motion.latest = start;
  motion.motion = plan(*robot, from, held, request);
  return motion.motion ? keep(*robot, std::move(motion)) : nullptr;
}

bool MotionBook::on_execution(const model::ExecutionReported& report, double at) {
  const auto robot = cell_.find(report.robot);
  if (!robot) return false;
  auto& kept = motions_[*robot];
  const auto found = std::find_if(kept.rbegin(), kept.rend(), [&](const KnownMotion& m) { return m.id == report.id && m.dispatched; });
  if (found == kept.rend() || found->attempt != report.attempt) return false;
  switch (report.state) {
    case model::ExecutionState::accepted: break;
    case model::ExecutionState::started: found->started = at; break;
    case model::ExecutionState::completed: found->ended = at; break;
    case model::ExecutionState::refused:
    case model::ExecutionState::withdrawn:
    case model::ExecutionState::failed: kept.erase(std::next(found).base()); break;
  }
  return true;
}

bool MotionBook::forget(const model::RobotName& name, const model::CommandId& id, bool dispatched_too) {
  const auto robot = cell_.find(name);
  if (!robot) return false;
  auto& kept = motions_[*robot];
  const auto found = std::find_if(kept.begin(), kept.end(),
                                  [&](const KnownMotion& m) { return m.id == id && !m.started && (dispatched_too || !m.dispatched); });
  if (found == kept.end()) return false;
  kept.erase(found);
  return true;
}

const KnownMotion* MotionBook::find(model::RobotIndex robot, const model::CommandId& id) const {
  const auto& kept = motions_[robot];
  const auto found = std::find_if(kept.rbegin(), kept.rend(), [&](const KnownMotion& m) { return m.id == id; });
  return found == kept.rend() ? nullptr : &*found;
}

std::vector<const KnownMotion*> MotionBook::coming(double now) const {
  std::vector<const KnownMotion*> motions;
  for (const auto& kept : motions_) {
    for (const KnownMotion& m : kept) {
      if (!m.ended && m.end() > now) motions.push_back(&m);
    }
  }
  return motions;
}

nlohmann::json ends_json(const std::vector<model::Capsule>& capsules) {
  nlohmann::json ends = nlohmann::json::array();
  for (const model::Capsule& c : capsules) {
    for (const model::Vector3& p : {c.a, c.b}) {
      for (const double x : {p.x(), p.y(), p.z()}) ends.push_back(metres(x));
    }
  }
  return ends;
}

nlohmann::json to_json(const KnownMotion& known) {
  const model::Motion& motion = known.motion->motion();
  const model::Robot& robot = motion.robot();
  nlohmann::json path = nlohmann::json::array(), ghosts = nlohmann::json::array();
  for (int i = 0; i <= kPathPoints; ++i) path.push_back(metres(motion.tcp(motion.duration() * i / kPathPoints).translation()));
  std::vector<model::Capsule> bodies;
  for (int i = 1; i <= kGhosts; ++i) {
    model::place_capsules(robot.model, robot.X_WB, motion.joints(motion.duration() * i / kGhosts), bodies);
    ghosts.push_back(ends_json(bodies));
  }
  nlohmann::json radii = nlohmann::json::array();
  for (const model::Capsule& c : bodies) radii.push_back(metres(c.radius));
  return {{"id", known.id.str()},        {"robot", robot.name.str()}, {"escape", known.escape},    {"start", seconds(known.start())},
          {"end", seconds(known.end())}, {"path", std::move(path)},   {"radii", std::move(radii)}, {"ghosts", std::move(ghosts)}};
}

}  // namespace interlace::monitor
