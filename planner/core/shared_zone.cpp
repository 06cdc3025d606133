#include "planner/core/shared_zone.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "planner/core/neighbourhood.hpp"

namespace interlace::core {

namespace {

constexpr double kDrawnBack = 0.005;    ///< of a slab's faces from the bodies at home [m]
constexpr double kZoneRounding = 1e-9;  ///< [m]

using Capsules = std::vector<model::Capsule>;

Capsules at_home(const model::Robot& robot) {
  Capsules capsules;
  model::place_capsules(robot.model, robot.X_WB, robot.home, capsules);
  return capsules;
}

/// The point of `capsules` farthest in the direction `u` (a unit vector).
Vector3 farthest(const Capsules& capsules, const Vector3& u) {
  Vector3 best = Vector3::Zero();
  double most = -std::numeric_limits<double>::infinity();
  for (const model::Capsule& c : capsules) {
    const Vector3 p = (u.dot(c.a) > u.dot(c.b) ? c.a : c.b) + c.radius * u;
    if (u.dot(p) > most) {
      most = u.dot(p);
      best = p;
    }
  }
  return best;
}

struct Gap {
  Vector3 direction;  ///< from a to b, unit
  double width;       ///< between the two bodies along it [m]; ≤ 0: no plane square to it separates them
};

/// The direction in which the convex hulls of `a` and `b` are farthest apart, which is that of the shortest way between them; `first`
/// unless another one is better. Source: Gilbert 1966, the point of a convex set (here of all b − a) nearest to the origin.
Gap widest_gap(const Capsules& a, const Capsules& b, const Vector3& first) {
  constexpr int kRounds = 2000;
  constexpr double kEnough = 1e-5;  // [m]
  const auto nearest = [&](const Vector3& u) -> Vector3 { return farthest(b, -u) - farthest(a, u); };
  Gap best{first, first.dot(nearest(first))};
  Vector3 v = nearest(first);
  for (int round = 0; round < kRounds && v.norm() > kEnough; ++round) {
    const Vector3 u = v.normalized();
    const Vector3 w = nearest(u);
    if (u.dot(w) > best.width + kEnough) best = {u, u.dot(w)};
    const Vector3 step = w - v;
    if (v.norm() - u.dot(w) < kEnough || step.squaredNorm() == 0) break;
    v += std::clamp(-v.dot(step) / step.squaredNorm(), 0.0, 1.0) * step;
  }
  return best;
}

double distance_to_axis(const Vector3& p, const Body& body) {
  const Vector3 axis = body.b - body.a;
  const double along = body.half_length > 0 ? std::clamp(axis.dot(p - body.a) / axis.squaredNorm(), 0.0, 1.0) : 0.0;
  return (p - body.a - along * axis).norm();
}

/// Half the length of the body's shadow on a line along `u`, of its axis alone.
double half_shadow(const Body& body, const Vector3& u) {
  return std::abs(u.dot(body.b - body.a)) / 2;
}

bool may_be_in(const model::Box& box, const Body& body, double reach) {
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const double middle = body.centre[axis];
    const double half = half_shadow(body, Vector3::Unit(axis)) + body.radius + reach + kZoneRounding;
    if (middle + half < box.min[axis] || middle - half > box.max[axis]) return false;
  }
  return true;
}

bool meets_box(const ReachableVolume& volume, const model::Box& box) {
  return (volume.centre - volume.centre.cwiseMax(box.min).cwiseMin(box.max)).norm() <= volume.radius;
}

}  // namespace

SharedZone::SharedZone(const model::Cell& cell) : cell_(cell), shares_(cell.robots.size()) {
  if (cell.planning.zone) return;
  const Neighbourhood neighbourhood{cell};
  for (model::RobotIndex a = 0; a < cell.robots.size(); ++a) {
    for (const model::RobotIndex b : neighbourhood.of(a)) {
      if (a < b) divide(a, b);
    }
  }
}

void SharedZone::divide(model::RobotIndex a, model::RobotIndex b) {
  const double margin = cell_.planning.margin;
  const auto share_with = [&](model::RobotIndex other) {
    Share share;
    share.volume = reachable_volume(cell_, other);
    share.volume.radius += margin;
    share.face = -std::numeric_limits<double>::infinity();
    return share;
  };
  Share of_a = share_with(b);
  Share of_b = share_with(a);
  const Capsules home_a = at_home(cell_.robots[a]);
  const Capsules home_b = at_home(cell_.robots[b]);
  const Vector3 between = cell_.robots[b].X_WB.translation() - cell_.robots[a].X_WB.translation();
  const Gap gap = widest_gap(home_a, home_b, between.norm() > 0 ? Vector3{between.normalized()} : Vector3{Vector3::UnitX()});
  if (gap.width > margin) {
    const double back = std::min(kDrawnBack, (gap.width - margin) / 3);
    of_a.towards = gap.direction;
    of_a.face = gap.direction.dot(farthest(home_a, gap.direction)) + back;
    of_b.towards = -gap.direction;
    of_b.face = -gap.direction.dot(farthest(home_b, -gap.direction)) + back;
  }
  shares_[a].push_back(of_a);
  shares_[b].push_back(of_b);
}

bool SharedZone::may_hold(model::RobotIndex robot, const Body& body, double reach) const {
  if (cell_.planning.zone) return may_be_in(*cell_.planning.zone, body, reach);
  const double around = body.radius + reach + kZoneRounding;
  return std::any_of(shares_[robot].begin(), shares_[robot].end(), [&](const Share& share) {
    const double ahead = share.towards.dot(body.centre) + half_shadow(body, share.towards) + around;
    return ahead > share.face && distance_to_axis(share.volume.centre, body) - around <= share.volume.radius;
  });
}

bool SharedZone::within_reach_of(model::RobotIndex robot) const {
  if (cell_.planning.zone) return meets_box(reachable_volume(cell_, robot), *cell_.planning.zone);
  return !shares_[robot].empty();
}

ZoneVisit SharedZone::visit(model::RobotIndex robot, SampledMotion& motion) const {
  const auto body_in = [&](const SampledMotion::Piece& piece) -> std::optional<std::size_t> {
    for (std::size_t i = 0; i < piece.bodies.size(); ++i) {
      if (may_hold(robot, piece.bodies[i], piece.reach[i])) return i;
    }
    return std::nullopt;
  };
  // The first (or last) piece of the finest level that may be in the zone: whole stretches proven free are stepped over.
  const std::size_t count = std::size_t{1} << motion.finest();
  const auto seek = [&](bool backwards) -> std::optional<std::size_t> {
    std::size_t at = 0;  // pieces of the finest level behind us
    while (at < count) {
      int level = motion.finest();
      std::size_t size = 1;
      std::size_t index = backwards ? count - 1 - at : at;
      const auto starts_here = [&](std::size_t bigger) { return at % bigger == 0; };
      while (level > 0 && starts_here(2 * size)) {  // the largest stretch from here on
        --level;
        size *= 2;
        index /= 2;
      }
      while (body_in(motion.piece(level, index))) {
        if (level == motion.finest()) return index;
        ++level;
        size /= 2;
        index = 2 * index + (backwards ? 1 : 0);
      }
      at += size;
    }
    return std::nullopt;
  };
  ZoneVisit visit;
  const auto first = seek(false);
  if (!first) return visit;
  const std::size_t last = seek(true).value_or(count - 1);
  visit.enters = true;
  visit.body = body_in(motion.piece(motion.finest(), *first)).value_or(0);
  visit.entered = motion.piece(motion.finest(), *first).t0;
  visit.left = motion.piece(motion.finest(), last).t1;
  visit.from_start = body_in(motion.at_start().piece(0, 0)).has_value();
  visit.to_end = body_in(motion.at_end().piece(0, 0)).has_value();
  return visit;
}

}  // namespace interlace::core
