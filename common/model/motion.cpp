#include "common/model/motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/model/motion_bounds.hpp"

namespace interlace::model {

namespace {

constexpr double kKnotLength = 0.002;   // [m] of path between knots, on average
constexpr double kKnotAngle = 0.01;     // [rad] likewise
constexpr double kLargestStep = 0.1;    // [rad] a joint may turn between knots before the path is looked at more closely
constexpr int kLargestRefinement = 12;  // halvings of a knot interval before a step counts as a jump
constexpr double kNoWay = 1e-9;         // [m] or [rad] below which there is nothing to travel

Quaternion rotation_of(const Pose& X) {
  return Quaternion{X.linear()};
}

double degrees(double rad) {
  return rad * 180 / kPi;
}

}  // namespace

Motion Motion::rest(const Robot& robot, const Joints& q) {
  Motion m{robot};
  m.knots_ = {q};
  m.lengths_ = {0.0};
  return m;
}

Pose Motion::tcp_in_base(const Line& line, double t) const {
  const double along = line.translation.distance() > 0 ? line.translation.at(t) / line.translation.distance() : 1.0;
  const Vector3 p = line.p_BT0 + along * (line.p_BT1 - line.p_BT0);
  if (line.rotation.distance() <= 0) return make_pose(p, line.q_BT1);
  return make_pose(p, line.q_BT0.slerp(line.rotation.at(t) / line.rotation.distance(), line.q_BT1));
}

Pose Motion::flange_in_base(const Line& line, double t) const {
  if (line.rotation.distance() > 0) return tcp_in_base(line, t) * line.X_TF;
  Pose X_BF = line.X_BF1;  // as it will be, less the way that is left
  X_BF.translation() -= (line.translation.distance() - line.translation.at(t)) * line.direction;
  return X_BF;
}

Joints Motion::between_knots(double t) const {
  if (knots_.size() == 1 || t <= 0) return knots_.front();
  if (t >= duration_) return knots_.back();
  const double x = t / duration_ * static_cast<double>(knots_.size() - 1);
  const auto i = std::min(static_cast<std::size_t>(x), knots_.size() - 2);
  return knots_[i] + (x - static_cast<double>(i)) * (knots_[i + 1] - knots_[i]);
}

Motion Motion::with_bodies_of(const Robot& robot) const {
  Motion same = *this;
  same.robot_ = &robot;
  return same;
}

Joints Motion::joints(double t) const {
  if (t <= 0 || knots_.size() == 1) return knots_.front();
  if (t >= duration_) return knots_.back();
  if (!line_) {
    Joints q = knots_.front();
    for (std::size_t i = 0; i < kJoints; ++i) q[i] += std::copysign(joint_laws_[i].at(t), knots_.back()[i] - knots_.front()[i]);
    return q;
  }
  Joints near = between_knots(t);
  const auto exact = robot_->model.kinematics.inverse(flange_in_base(*line_, t), line_->branch);
  if (!exact) return near;  // the walk along the path found every knot in reach, so only rounding can miss in between
  Joints q;
  for (std::size_t i = 0; i < kJoints; ++i) q[i] = nearest_turn((*exact)[i], near[i]);
  return q;
}

Pose Motion::tcp(double t) const {
  if (line_) return robot_->X_WB * tcp_in_base(*line_, std::clamp(t, 0.0, duration_));
  return robot_->X_WB * tcp_pose(robot_->model, joints(t));
}

double Motion::length(double t) const {
  if (line_) return line_->translation.at(t);
  if (knots_.size() == 1 || t <= 0) return 0;
  if (t >= duration_) return lengths_.back();
  const double x = t / duration_ * static_cast<double>(knots_.size() - 1);
  const auto i = std::min(static_cast<std::size_t>(x), knots_.size() - 2);
  return lengths_[i] + (x - static_cast<double>(i)) * (lengths_[i + 1] - lengths_[i]);
}

void Motion::frames(double t, LinkFrames& X) const {
  if (line_ && t > 0 && t < duration_ && robot_->model.kinematics.frames(flange_in_base(*line_, t), line_->branch, X)) return;
  X = robot_->model.kinematics.forward(joints(t));
}

void Motion::displacement(double t0, double centre, double t1, std::vector<double>& out) const {
  LinkFrames X;
  frames(centre, X);
  std::vector<Vector3> ends;
  for (const LinkCapsule& c : robot_->model.capsules) {
    ends.emplace_back(X[c.link] * c.a);
    ends.emplace_back(X[c.link] * c.b);
  }
  out.resize(robot_->model.capsules.size());
  displacement(t0, centre, t1, {X, ends.data()}, out.data());
}

void Motion::displacement(double t0, double centre, double t1, const PlacedArm& at_centre, double* out) const {
  if (duration_ <= 0) {
    std::fill_n(out, robot_->model.capsules.size(), 0.0);
  } else if (line_) {
    line_displacement(*line_, t0, centre, t1, at_centre, out);
  } else {
    joint_displacement(t0, centre, t1, at_centre, out);
  }
}

void Motion::line_displacement(const Line& line, double t0, double centre, double t1, const PlacedArm& at_centre, double* out) const {
  // The laws are monotone, so the ends of the interval are the farthest from its centre.
  HandSweep hand;
  const double along = line.translation.at(centre);
  const double turned = line.rotation.at(centre);
  hand.direction = line.direction;
  hand.axis = line.axis;
  hand.way = {line.translation.at(t0) - along, line.translation.at(t1) - along};
  hand.turn = {line.rotation.at(t0) - turned, line.rotation.at(t1) - turned};
  displacement_by_hand(robot_->model, line.branch, at_centre, hand, out);
}

void Motion::joint_displacement(double t0, double centre, double t1, const PlacedArm& at_centre, double* out) const {
  JointSweep sweep;
  for (std::size_t i = 0; i < kJoints; ++i) {
    const TimeLaw& law = joint_laws_[i];
    sweep[i] = std::max(law.at(t1) - law.at(centre), law.at(centre) - law.at(t0));
  }
  displacement_by_joints(robot_->model, at_centre, sweep, out);
}

namespace {

/// The request's speeds, checked against the robot's own.
Result<TcpLimits, MotionError> chosen_limits(const Robot& robot, const MotionRequest& request) {
  TcpLimits limits = robot.tcp;
  const auto check = [&](const std::optional<double>& wanted, double& limit, const char* what,
                         const char* unit) -> std::optional<MotionError> {
    if (!wanted) return std::nullopt;
    if (!(*wanted > 0) || *wanted > limit * (1 + 1e-9)) {
      return MotionError{
          Reason::bad_request, 0, {}, fmt::format("{} {:g} {} is not above 0 and at most {:g} {}", what, *wanted, unit, limit, unit)};
    }
    limit = *wanted;
    return std::nullopt;
  };
  if (auto error = check(request.velocity, limits.velocity, "velocity", "m/s")) return unexpected(*error);
  if (auto error = check(request.acceleration, limits.acceleration, "acceleration", "m/s²")) return unexpected(*error);
  return limits;
}

/// Time laws of a straight line of `length` [m] with a turn of `angle` [rad], both of the same duration.
std::pair<TimeLaw, TimeLaw> line_laws(double length, double angle, const TcpLimits& limits) {
  TimeLaw translation;
  TimeLaw rotation;
  if (length > kNoWay) translation = TimeLaw{length, limits.velocity, limits.acceleration};
  if (angle > kNoWay) {
    if (limits.angular_velocity && limits.angular_acceleration) {
      rotation = TimeLaw{angle, *limits.angular_velocity, *limits.angular_acceleration};
    } else if (length > kNoWay) {  // no limit given: the same profile as the translation, scaled to the angle
      rotation = TimeLaw{angle, limits.velocity * angle / length, limits.acceleration * angle / length};
    } else {
      const double a = 4 * angle / (kUnlimitedRotation * kUnlimitedRotation);
      rotation = TimeLaw{angle, a * kUnlimitedRotation, a};
    }
  }
  const double duration = std::max(translation.duration(), rotation.duration());
  return {translation.stretched_to(duration), rotation.stretched_to(duration)};
}

MotionError joint_limit_error(const Robot& robot, std::size_t joint, double angle, double progress, const Vector3& place) {
  return {Reason::joint_limit, progress, place,
          fmt::format("joint {} would be at {:.1f}°, outside its limits [{:.1f}°, {:.1f}°], at {:.0f} % of the path", joint + 1,
                      degrees(angle), degrees(robot.model.joints.min[joint]), degrees(robot.model.joints.max[joint]), 100 * progress)};
}

/// Walks a path from knot to knot, looking closer where a joint turns fast, until it is continuous or provably jumps.
class PathWalk {
 public:
  /// `posture(t)`: raw joints at `t`, empty when out of reach; `place(t)`: TCP in the world [m]; `share(t)`: how much of the path lies
  /// behind, 0 … 1.
  template <typename Posture, typename Place, typename Share>
  static Result<std::vector<Joints>, MotionError> along(const Robot& robot, const Joints& from, double duration, std::size_t steps,
                                                        const Posture& posture, const Place& place, const Share& share) {
    std::vector<Joints> knots{from};
    for (std::size_t i = 1; i <= steps; ++i) {
      const double t0 = duration * static_cast<double>(i - 1) / static_cast<double>(steps);
      const double t1 = duration * static_cast<double>(i) / static_cast<double>(steps);
      auto next = step(robot, knots.back(), t0, t1, duration, 0, posture, place, share);
      if (!next) return unexpected(next.error());
      knots.push_back(*next);
    }
    return knots;
  }

 private:
  template <typename Posture, typename Place, typename Share>
  static Result<Joints, MotionError> step(const Robot& robot, const Joints& q0, double t0, double t1, double duration, int depth,
                                          const Posture& posture, const Place& place, const Share& share) {
    const double progress = share(t1);
    const auto found = posture(t1);
    if (!found) {
      const Vector3 p = place(t1);
      return unexpected(MotionError{Reason::unreachable, progress, p,
                                    fmt::format("({:.1f}, {:.1f}, {:.1f}) mm is out of reach in this posture, at {:.0f} % of the path",
                                                1e3 * p.x(), 1e3 * p.y(), 1e3 * p.z(), 100 * progress)});
    }
    Joints q1;
    for (std::size_t i = 0; i < kJoints; ++i) q1[i] = nearest_turn((*found)[i], q0[i]);
    Eigen::Index joint = 0;
    const double largest = (q1 - q0).cwiseAbs().maxCoeff(&joint);
    if (largest > kLargestStep) {
      if (depth >= kLargestRefinement) {
        return unexpected(
            MotionError{Reason::joint_jump, progress, place(t1),
                        fmt::format("joint {} would jump by {:.1f}° (singularity or change of branch) at {:.0f} % of the path", joint + 1,
                                    degrees(largest), 100 * progress)});
      }
      const double middle = (t0 + t1) / 2;
      auto half = step(robot, q0, t0, middle, duration, depth + 1, posture, place, share);
      if (!half) return half;
      return step(robot, *half, middle, t1, duration, depth + 1, posture, place, share);
    }
    if (const auto outside = joint_outside_limits(robot.model.joints, q1)) {
      return unexpected(joint_limit_error(robot, *outside, q1[*outside], progress, place(t1)));
    }
    if (robot.model.joints.velocity) {
      for (std::size_t i = 0; i < kJoints; ++i) {
        const double speed = std::abs(q1[i] - q0[i]) / (t1 - t0);
        const double limit = (*robot.model.joints.velocity)[i];
        if (speed > limit * (1 + 1e-6)) {
          return unexpected(
              MotionError{Reason::joint_speed, progress, place(t1),
                          fmt::format("joint {} would turn at {:.1f}°/s, faster than its limit {:.1f}°/s, at {:.0f} % of the path", i + 1,
                                      degrees(speed), degrees(limit), 100 * progress)});
        }
      }
    }
    return q1;
  }
};

std::size_t knots_for(double length, double angle) {
  return static_cast<std::size_t>(std::clamp(std::ceil(std::max(length / kKnotLength, angle / kKnotAngle)), 16.0, 4000.0));
}

bool finite(const Target& target) {
  if (const auto* line = std::get_if<LinearTarget>(&target)) return line->X_WT.matrix().allFinite();
  return std::get<JointTarget>(target).q.allFinite();
}

}  // namespace

Result<Motion, MotionError> plan_motion(const Robot& robot, const Joints& from, const MotionRequest& request) {
  if (!finite(request.target)) return unexpected(MotionError{Reason::bad_request, 0, {}, "the target is not a finite number"});
  const auto limits = chosen_limits(robot, request);
  if (!limits) return unexpected(limits.error());
  const RobotModel& model = robot.model;
  Motion m{robot};

  if (const auto* to_pose = std::get_if<LinearTarget>(&request.target)) {
    const Pose X_BT0 = tcp_pose(model, from);
    const Pose X_BT1 = robot.X_WB.inverse() * to_pose->X_WT;
    Motion::Line line;
    line.branch = model.kinematics.branch_of(from);
    line.p_BT0 = X_BT0.translation();
    line.p_BT1 = X_BT1.translation();
    line.q_BT0 = rotation_of(X_BT0);
    line.q_BT1 = rotation_of(X_BT1);
    line.angle = angle_between(line.q_BT0, line.q_BT1);
    const Vector3 way = line.p_BT1 - line.p_BT0;
    const double length = way.norm();
    line.X_TF = model.X_FT.inverse();
    line.X_BF1 = make_pose(line.p_BT1, line.q_BT1) * line.X_TF;
    const Quaternion whole = line.q_BT1 * line.q_BT0.conjugate();
    const Vector3 axis = whole.w() < 0 ? Vector3{-whole.vec()} : Vector3{whole.vec()};  // slerp takes the shorter way
    line.direction = length > kNoWay ? Vector3{way / length} : Vector3::Zero();
    line.axis = axis.norm() > 0 ? Vector3{axis.normalized()} : Vector3::UnitZ();
    std::tie(line.translation, line.rotation) = line_laws(length, line.angle, *limits);
    m.duration_ = std::max(line.translation.duration(), line.rotation.duration());
    if (m.duration_ == 0) return Motion::rest(robot, from);
    const auto place = [&](double t) { return Vector3{robot.X_WB * m.tcp_in_base(line, t).translation()}; };
    const auto share = [&](double t) {
      const TimeLaw& law = length > kNoWay ? line.translation : line.rotation;
      return law.at(t) / law.distance();
    };
    const auto posture = [&](double t) { return model.kinematics.inverse(m.flange_in_base(line, t), line.branch); };
    auto knots = PathWalk::along(robot, from, m.duration_, knots_for(length, line.angle), posture, place, share);
    if (!knots) return unexpected(knots.error());
    m.knots_ = std::move(*knots);
    m.line_ = line;
    return m;
  }

  const Joints& to = std::get<JointTarget>(request.target).q;
  if (!model.joints.velocity || !model.joints.acceleration) {
    return unexpected(MotionError{Reason::bad_request, 0, {}, "a joint move needs joints.velocity and joints.acceleration in the model"});
  }
  if (const auto outside = joint_outside_limits(model.joints, to)) {
    return unexpected(joint_limit_error(robot, *outside, to[*outside], 1, robot.X_WB * tcp_pose(model, to).translation()));
  }
  for (std::size_t i = 0; i < kJoints; ++i) {
    m.joint_laws_.emplace_back(std::abs(to[i] - from[i]), (*model.joints.velocity)[i], (*model.joints.acceleration)[i]);
    m.duration_ = std::max(m.duration_, m.joint_laws_.back().duration());
  }
  if (m.duration_ == 0) return Motion::rest(robot, from);
  for (TimeLaw& law : m.joint_laws_) law = law.stretched_to(m.duration_);
  m.knots_ = {from, to};
  const std::size_t steps = knots_for(0, (to - from).cwiseAbs().maxCoeff());
  std::vector<Joints> knots;
  m.lengths_ = {0.0};
  Vector3 last = m.tcp(0).translation();
  for (std::size_t i = 0; i <= steps; ++i) {
    const double t = m.duration_ * static_cast<double>(i) / static_cast<double>(steps);
    knots.push_back(i == steps ? to : m.joints(t));
    const Vector3 p = robot.X_WB * tcp_pose(model, knots.back()).translation();
    if (i > 0) m.lengths_.push_back(m.lengths_.back() + (p - last).norm());
    last = p;
  }
  m.knots_ = std::move(knots);
  return m;
}

}  // namespace interlace::model
