#include "planner/core/admission.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "planner/core/fixture_clearance.hpp"
#include "planner/core/reach.hpp"

namespace interlace::core {

namespace {

/// Capsules fixed to a robot's base, as bodies that never move.
class ImmovableBase {
 public:
  explicit ImmovableBase(const model::Robot& robot) : robot_(&robot) {
    const auto& capsules = robot.model.capsules;
    for (std::size_t i = 0; i < capsules.size(); ++i) {
      const model::LinkCapsule& c = capsules[i];
      if (c.link == 0) bodies_.emplace_back(i, Body{{robot.X_WB * c.a, robot.X_WB * c.b, c.radius}});
    }
  }
  [[nodiscard]] const model::Robot& robot() const { return *robot_; }
  [[nodiscard]] const std::vector<std::pair<std::size_t, Body>>& bodies() const { return bodies_; }

 private:
  const model::Robot* robot_;
  std::vector<std::pair<std::size_t, Body>> bodies_;
};

/// A ball around that base.
ReachableVolume base_volume(const model::Robot& robot) {
  ReachableVolume ball{robot.X_WB.translation(), 0};
  for (const model::LinkCapsule& c : robot.model.capsules) {
    if (c.link == 0) ball.radius = std::max(ball.radius, std::max(c.a.norm(), c.b.norm()) + c.radius);
  }
  return ball;
}

class PathCheck {
 public:
  PathCheck(SampledMotion& motion, double margin) : motion_(motion), margin_(margin), path_error_(motion.robot().controller.path_error) {}

  std::optional<model::MotionError> against_itself() {
    return walk(0, 0, [this](const SampledMotion::Piece& piece) -> std::optional<model::MotionError> {
      for (const auto& [i, j] : motion_.robot().model.self_pairs) {
        if (near(piece.bodies[i], piece.bodies[j], piece.reach[i] + piece.reach[j] + 2 * path_error_)) {
          return error(piece.centre, model::Reason::self_collision, fmt::format("{} would touch the robot's own {}", name(i), name(j)));
        }
      }
      return std::nullopt;
    });
  }

  std::optional<model::MotionError> against(const std::vector<model::Fixture>& fixtures) {
    const auto contact = first_contact(motion_, fixtures, margin_ + path_error_);
    if (!contact) return std::nullopt;
    const double length = motion_.motion().length(contact->t);
    return error(
        contact->t, model::Reason::fixture_collision,
        fmt::format("{} would touch fixture {} after {:.1f} mm,", name(contact->body), fixtures[contact->fixture].name, 1e3 * length));
  }

  std::optional<model::MotionError> against(const ImmovableBase& base) {
    return walk(0, 0, [&](const SampledMotion::Piece& piece) -> std::optional<model::MotionError> {
      for (std::size_t i = 0; i < piece.bodies.size(); ++i) {
        for (const auto& [j, body] : base.bodies()) {
          if (near(piece.bodies[i], body, piece.reach[i] + path_error_)) {
            return error(piece.centre, model::Reason::base_collision,
                         fmt::format("{} would touch {} of {}", name(i), base.robot().model.capsules[j].name, base.robot().name.str()));
          }
        }
      }
      return std::nullopt;
    });
  }

 private:
  /// Depth first in order of time, so the first finding at the resolution limit is the first place on the path.
  template <typename Check>
  std::optional<model::MotionError> walk(int level, std::size_t index, const Check& check) {
    auto found = check(motion_.piece(level, index));
    if (!found || level == motion_.depth()) return found;
    if (auto first = walk(level + 1, 2 * index, check)) return first;
    return walk(level + 1, 2 * index + 1, check);
  }

  [[nodiscard]] bool near(const Body& a, const Body& b, double reach) const {
    const double bound = reach + margin_;
    return !surely_farther(a, b, bound) && clearance(a, b) <= bound;
  }

  [[nodiscard]] std::string name(std::size_t body) const { return motion_.robot().model.capsules[body].name; }

  [[nodiscard]] model::MotionError error(double t, model::Reason reason, std::string what) const {
    const model::Motion& m = motion_.motion();
    const double whole = m.length(m.duration());
    const double progress = whole > 0 ? m.length(t) / whole : m.duration() > 0 ? t / m.duration() : 1;
    const Vector3 place = m.tcp(t).translation();
    return {reason, progress, place,
            fmt::format("{} at {:.0f} % of the path, TCP at ({:.1f}, {:.1f}, {:.1f}) mm", what, 100 * progress, 1e3 * place.x(),
                        1e3 * place.y(), 1e3 * place.z())};
  }

  SampledMotion& motion_;
  double margin_;
  double path_error_;  // [m] of any of the robot's points
};

}  // namespace

std::optional<model::MotionError> path_collision(SampledMotion& motion, const model::Cell& cell, model::RobotIndex robot, double margin) {
  PathCheck check{motion, margin};
  if (auto found = check.against_itself()) return found;
  if (auto found = check.against(cell.fixtures)) return found;
  const ReachableVolume reach = reachable_volume(motion.robot());
  for (model::RobotIndex other = 0; other < cell.robots.size(); ++other) {
    if (other == robot || !reach.meets(base_volume(cell.robots[other]), margin)) continue;
    if (auto found = check.against(ImmovableBase{cell.robots[other]})) return found;
  }
  return std::nullopt;
}

model::Result<SampledMotionPtr, model::MotionError> admit(const model::Cell& cell, model::RobotIndex robot,
                                                          const model::MotionBodies& bodies, const model::Joints& from,
                                                          const model::MotionRequest& request) {
  auto motion = model::plan_motion(*bodies.during, from, request);
  if (!motion) return model::unexpected(motion.error());
  auto sampled = std::make_shared<SampledMotion>(std::move(*motion), cell.planning.resolution, bodies);
  const double margin = cell.planning.margin;
  if (bodies.at_start != bodies.during) {
    if (auto collision = path_collision(sampled->at_start(), cell, robot, margin)) {
      collision->progress = 0;
      collision->text += ", as the tool is changed before it starts";
      return model::unexpected(*collision);
    }
  }
  if (auto collision = path_collision(*sampled, cell, robot, margin)) return model::unexpected(*collision);
  if (bodies.at_end != bodies.during) {
    if (auto collision = path_collision(sampled->at_end(), cell, robot, margin)) {
      collision->text += ", as the tool is changed there";
      return model::unexpected(*collision);
    }
  }
  return sampled;
}

}  // namespace interlace::core
