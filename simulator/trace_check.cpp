#include "simulator/trace_check.hpp"

#include <algorithm>
#include <cmath>

namespace interlace::sim {

namespace {

using model::Capsule;
using model::Vector3;

constexpr double kRounding = 1e-9;  // [m] of travelled ways, on the safe side

/// Squared distance of two segments: the foot points on both, each clamped to its segment and found anew for the other one clamped.
/// Every step brings the points nearer, so near-parallel segments, where the first guess is hardly determined, come out right too.
double squared_distance(const Capsule& one, const Capsule& two) {
  const Vector3 u = one.b - one.a;
  const Vector3 v = two.b - two.a;
  const Vector3 w = one.a - two.a;
  const double uu = u.squaredNorm();
  const double vv = v.squaredNorm();
  const double uv = u.dot(v);
  const double uw = u.dot(w);
  const double vw = v.dot(w);
  const auto within = [](double x) { return std::clamp(x, 0.0, 1.0); };
  const auto nearest_on_one = [&](double t) { return uu > 0 ? within((t * uv - uw) / uu) : 0.0; };
  const auto nearest_on_two = [&](double s) { return vv > 0 ? within((s * uv + vw) / vv) : 0.0; };
  const double skew = uu * vv - uv * uv;
  double s = skew > 0 ? within((uv * vw - vv * uw) / skew) : 0.0;
  const double t = nearest_on_two(s);
  s = nearest_on_one(t);
  return (w + s * u - t * v).squaredNorm();
}

/// Longest distance [m] any end of a body can have from the axis of each joint, in whatever posture.
std::array<double, model::kJoints> levers(const model::RobotModel& m) {
  const auto& p = m.kinematics.parameters();
  const double upper_arm = std::hypot(p.b, p.c2);
  const double forearm = std::hypot(p.a2, p.c3);
  // Way from each link's frame to the next one's, from the turret (1) to the flange (6); c1 lies on the axis of joint 1.
  const std::array<double, 7> way{0, std::abs(p.a1), upper_arm, forearm, 0, std::abs(p.c4), 0};
  std::array<double, model::kJoints> lever{};
  for (const auto& capsule : m.capsules) {
    double length = std::max(capsule.a.norm(), capsule.b.norm());
    for (std::size_t link = capsule.link; link >= 1; --link) {  // joint index link − 1 carries this link
      lever[link - 1] = std::max(lever[link - 1], length);
      if (link > 1) length += way[link - 1];
    }
  }
  return lever;
}

}  // namespace

TraceCheck::TraceCheck(const model::Cell& cell) : cell_(cell), held_(cell), arms_(cell.robots.size()), fixtures_(cell.fixtures) {
  for (model::RobotIndex i = 0; i < arms_.size(); ++i) {
    hold(i, {});
    for (model::RobotIndex j = i + 1; j < arms_.size(); ++j) {
      Pair pair;
      pair.a = i;
      pair.b = j;
      pairs_.push_back(pair);
    }
    for (std::size_t f = 0; f < cell.fixtures.size(); ++f)
      places_.push_back({i, f, std::vector<Measured>(arms_[i].body->model.capsules.size())});
  }
}

void TraceCheck::hold(model::RobotIndex robot, model::ToolSet tools) {
  Arm& arm = arms_[robot];
  arm.body = &held_.of(robot, tools);
  arm.lever = levers(arm.body->model);
  arm.placed = false;
  for (Pair& pair : pairs_) {
    if (pair.a == robot || pair.b == robot) pair.travelled_a = -1;  // to be measured anew
  }
  for (Place& place : places_) {
    if (place.robot != robot) continue;
    place.travelled = -1;
    place.bodies.assign(arm.body->model.capsules.size(), {});
  }
}

void TraceCheck::step(double t, const std::vector<model::Joints>& joints) {
  for (model::RobotIndex i = 0; i < arms_.size(); ++i) {
    Arm& arm = arms_[i];
    if (steps_ > 0 && arm.q == joints[i]) continue;
    if (steps_ > 0) {
      double way = kRounding;
      for (std::size_t k = 0; k < model::kJoints; ++k) way += arm.lever[k] * std::abs(joints[i][k] - arm.q[k]);
      arm.travelled += way;
    }
    arm.q = joints[i];
    arm.placed = false;
  }
  ++steps_;
  for (Pair& pair : pairs_) {
    if (pair.travelled_a >= 0) {
      const double moved = arms_[pair.a].travelled - pair.travelled_a + arms_[pair.b].travelled - pair.travelled_b;
      if (moved == 0) continue;  // both stand as they were measured
      if (pair.clearance - moved > std::max(pair.least, 0.0)) {
        pair.touching = false;
        continue;
      }
    }
    measure(t, pair);
  }
  for (Place& place : places_) {
    if (place.travelled >= 0) {
      const double moved = arms_[place.robot].travelled - place.travelled;
      if (moved == 0) continue;
      if (place.clearance - moved > std::max(place.least, 0.0)) {
        place.touching = false;
        continue;
      }
    }
    measure(t, place);
  }
}

const std::vector<Capsule>& TraceCheck::bodies(model::RobotIndex robot) {
  Arm& arm = arms_[robot];
  if (!arm.placed) model::place_capsules(arm.body->model, arm.body->X_WB, arm.q, arm.bodies);
  arm.placed = true;
  return arm.bodies;
}

void TraceCheck::measure(double t, Pair& pair) {
  ++measured_;
  const auto& a = bodies(pair.a);
  const auto& b = bodies(pair.b);
  double least = std::numeric_limits<double>::infinity();
  std::size_t least_i = 0;
  std::size_t least_j = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) {
      const double d = std::sqrt(squared_distance(a[i], b[j])) - a[i].radius - b[j].radius;
      if (d >= least) continue;
      least = d;
      least_i = i;
      least_j = j;
    }
  }
  pair.clearance = least;
  pair.travelled_a = arms_[pair.a].travelled;
  pair.travelled_b = arms_[pair.b].travelled;
  pair.least = std::min(pair.least, least);
  if (least <= 0 && !pair.touching) ++collisions_;
  pair.touching = least <= 0;
  if (least >= least_.clearance) return;
  least_ = {least, t, pair.a, pair.b, arms_[pair.a].body->model.capsules[least_i].name, arms_[pair.b].body->model.capsules[least_j].name};
}

void TraceCheck::measure(double t, Place& place) {
  constexpr double kBeyond = 0.02;  // [m] that a lower bound must be beyond what matters: more often exact, and less often measured
  const auto& capsules = arms_[place.robot].body->model.capsules;
  const auto& own = bodies(place.robot);
  const double matters = std::max(place.least, 0.0);
  bool touches = false;
  place.clearance = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < own.size(); ++i) {
    if (capsules[i].link == 0) continue;  // it never moves, and stands on some of them
    Measured& last = place.bodies[i];
    const double moved = std::max((own[i].a - last.a).norm(), (own[i].b - last.b).norm()) + kRounding;
    if (last.clearance - moved > matters) {
      place.clearance = std::min(place.clearance, last.clearance - moved);
      continue;
    }
    ++measured_;
    const double d = fixtures_.clearance(own[i], place.fixture, matters + kBeyond);
    last = {own[i].a, own[i].b, d};
    place.clearance = std::min(place.clearance, d);
    place.least = std::min(place.least, d);
    touches = touches || d <= 0;
    if (d < least_.clearance) least_ = {d, t, place.robot, place.robot, capsules[i].name, "fixture " + cell_.fixtures[place.fixture].name};
  }
  place.travelled = arms_[place.robot].travelled;
  if (touches && !place.touching) {
    ++collisions_;
    ++fixture_contacts_;
  }
  place.touching = touches;
}

}  // namespace interlace::sim
