#include "simulator/generator.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include "common/model/segment_distance.hpp"
#include "planner/core/admission.hpp"
#include "planner/core/timing_map.hpp"

namespace interlace::sim {

namespace {

using core::SampledMotion;
using core::SampledMotionPtr;
using model::Joints;
using model::kPi;
using model::MotionRequest;
using model::Pose;
using model::Robot;
using model::RobotIndex;
using model::Vector3;

constexpr double kPerMetre = 1000;                    // as in files, so that a file gives the same numbers back
constexpr double kPerRadian = 57.295779513082320877;  // likewise
constexpr int kTrials = 300;                          // targets tried before the robot goes home, and as many again from there
constexpr double kShortest = 0.05;                    // [m] a target is away from where the TCP is
constexpr double kNearest = 0.35, kFarthest = 0.98;   // radius of targets, of the TCP's reach
constexpr double kSideways = 80 / kPerRadian;         // of targets, to either side of forward
constexpr double kLowest = -0.35, kHighest = 0.3;     // of targets above the shoulder, of the TCP's reach
constexpr int kYaw = 30, kPitch = 20;                 // [deg] of the hand, to either side
constexpr const char* kInTheWay = "in another's home";
constexpr std::size_t kGlances = 16;  // postures looked at before a map is built

/// Random numbers that are the same on every machine: the standard fixes the engine, not the distributions.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : engine_(seed) {}

  /// Uniform in [0, 1).
  double share() { return static_cast<double>(engine_() >> 11U) * 0x1p-53; }
  double between(double low, double high) { return low + (high - low) * share(); }
  /// Uniform in low … high.
  int whole(int low, int high) { return low + static_cast<int>(share() * (high - low + 1)); }
  bool chance(double probability) { return share() < probability; }

 private:
  std::mt19937_64 engine_;
};

/// How far the TCP can be from the shoulder [m].
double tcp_reach(const model::RobotModel& m) {
  const auto& p = m.kinematics.parameters();
  return std::abs(p.a1) + std::hypot(p.b, p.c2) + m.kinematics.forearm_length() + std::abs(p.c4) + m.X_FT.translation().norm();
}

Vector3 shoulder(const Robot& robot) {
  return robot.X_WB * Vector3{0, 0, robot.model.kinematics.parameters().c1};
}

double whole(double value, double per_si) {
  return std::round(value * per_si) / per_si;
}

/// The pose with whole millimetres and degrees nearest to `X`.
Pose whole(const Pose& X) {
  Vector3 p = X.translation();
  Vector3 rpy = model::rpy_of(X.linear());
  for (double& x : p) x = whole(x, kPerMetre);
  for (double& angle : rpy) angle = whole(angle, kPerRadian);
  return model::make_pose(p, model::rotation_from_rpy(rpy));
}

MotionRequest line_to(const Pose& X_WT) {
  MotionRequest request;
  request.target = model::LinearTarget{X_WT};
  return request;
}
MotionRequest joints_to(const Joints& q) {
  MotionRequest request;
  request.target = model::JointTarget{q};
  return request;
}

/// Tells what a robot can do while all others stand at home.
class AllOthersHome {
 public:
  explicit AllOthersHome(const model::Cell& cell) : cell_(cell) {
    for (const Robot& robot : cell.robots) {
      homes_.push_back(std::make_unique<SampledMotion>(model::Motion::rest(robot, robot.home), cell.planning.resolution));
      model::place_capsules(robot.model, robot.X_WB, robot.home, capsules_.emplace_back());
    }
  }

  /// Empty, or why `robot` cannot stand at `q`.
  [[nodiscard]] const char* why_not_stand(RobotIndex robot, const Joints& q) const {
    std::vector<model::Capsule> own;
    model::place_capsules(cell_.robots[robot].model, cell_.robots[robot].X_WB, q, own);
    for (RobotIndex other = 0; other < homes_.size(); ++other) {
      if (other == robot) continue;
      for (const auto& a : own) {
        for (const auto& b : capsules_[other]) {
          if (model::segment_distance(a.a, a.b, b.a, b.b) - a.radius - b.radius <= cell_.planning.margin) return kInTheWay;
        }
      }
    }
    return nullptr;
  }

  /// The motion of `request` from `from`; or why it is not admissible and clear.
  model::Result<SampledMotionPtr, const char*> go(RobotIndex robot, const Joints& from, const MotionRequest& request) {
    auto planned = model::plan_motion(cell_.robots[robot], from, request);
    if (!planned) return model::unexpected(model::to_string(planned.error().reason));
    for (std::size_t i = 1; i <= kGlances; ++i) {
      const double t = planned->duration() * static_cast<double>(i) / static_cast<double>(kGlances);
      if (const char* why = why_not_stand(robot, planned->joints(t))) return model::unexpected(why);
    }
    auto motion = std::make_shared<SampledMotion>(std::move(*planned), cell_.planning.resolution);
    if (const auto collision = core::path_collision(*motion, cell_, robot, cell_.planning.margin)) {
      return model::unexpected(model::to_string(collision->reason));
    }
    for (RobotIndex other = 0; other < homes_.size(); ++other) {
      if (other == robot) continue;
      if (!core::build_timing_map(*motion, *homes_[other], cell_.planning.margin).blocked.empty()) {
        return model::unexpected(kInTheWay);
      }
    }
    return motion;
  }

  /// The way home from `from`, linear where possible; empty when there is none.
  std::optional<std::pair<MotionRequest, SampledMotionPtr>> home_from(RobotIndex robot, const Joints& from) {
    const Robot& r = cell_.robots[robot];
    const MotionRequest linear = line_to(r.X_WB * model::tcp_pose(r.model, r.home));
    if (auto motion = go(robot, from, linear)) return std::pair{linear, *motion};
    const MotionRequest joint = joints_to(r.home);
    if (auto motion = go(robot, from, joint)) return std::pair{joint, *motion};
    return std::nullopt;
  }

 private:
  const model::Cell& cell_;
  std::vector<std::unique_ptr<SampledMotion>> homes_;
  std::vector<std::vector<model::Capsule>> capsules_;
};

class Generator {
 public:
  Generator(const model::Cell& cell, const GeneratorOptions& options)
      : cell_(cell), options_(options), dice_(options.seed), others_home_(cell) {}

  model::Result<model::Program, std::string> run() {
    model::Program program;
    for (RobotIndex robot = 0; robot < cell_.robots.size(); ++robot) {
      auto& steps = program.robots.emplace_back(cell_.robots[robot].name, std::vector<model::ProgramStep>{}).second;
      Joints q = cell_.robots[robot].start;
      bool at_home = q == cell_.robots[robot].home;
      while (steps.size() < options_.per_robot) {
        auto step = next(robot, q);
        const bool goes_home = !step;
        if (goes_home) {
          if (!at_home) step = others_home_.home_from(robot, q);
          if (!step) return model::unexpected(complaint(robot, at_home));
        }
        at_home = goes_home;
        q = step->second->motion().to();
        steps.push_back({step->first, 0, 0});
      }
    }
    return program;
  }

 private:
  using Step = std::pair<MotionRequest, SampledMotionPtr>;

  std::optional<Step> next(RobotIndex robot, const Joints& from) {
    refusals_.clear();
    for (int trial = 0; trial < kTrials; ++trial) {
      const char* why = nullptr;
      if (auto step = attempt(robot, from, why)) return step;
      ++refusals_[why];
    }
    return std::nullopt;
  }

  std::optional<Step> attempt(RobotIndex robot, const Joints& from, const char*& why) {
    const Robot& r = cell_.robots[robot];
    const bool has_rates = r.model.joints.velocity && r.model.joints.acceleration;
    const bool joint_move = dice_.chance(options_.joint_moves) && has_rates;
    const bool slower = dice_.chance(options_.slower);
    const double speed = dice_.between(0.4, 1.0);
    const Pose X_WT = target(robot);
    const auto q = model::preferred_posture(r.model, r.X_WB.inverse() * X_WT);
    if (!q) {
      why = "out of reach";
      return std::nullopt;
    }
    const Pose X_WT0 = r.X_WB * model::tcp_pose(r.model, from);
    if ((X_WT.translation() - X_WT0.translation()).norm() < kShortest) {
      why = "too near";
      return std::nullopt;
    }
    if ((why = others_home_.why_not_stand(robot, *q))) return std::nullopt;
    MotionRequest request = line_to(X_WT);
    if (joint_move) {
      Joints rounded = *q;
      for (double& angle : rounded) angle = whole(angle, kPerRadian);
      request = joints_to(rounded);
    }
    if (slower && !joint_move) request.velocity = std::max(std::floor(speed * r.tcp.velocity * kPerMetre), 1.0) / kPerMetre;
    if (request.velocity && *request.velocity > r.tcp.velocity) request.velocity.reset();
    const auto motion = others_home_.go(robot, from, request);
    if (!motion) {
      why = motion.error();
      return std::nullopt;
    }
    const auto from_home = others_home_.go(robot, r.home, request);
    if (!from_home) {
      why = "not from home";
      return std::nullopt;
    }
    if (!others_home_.home_from(robot, (*motion)->motion().to()) || !others_home_.home_from(robot, (*from_home)->motion().to())) {
      why = "no way home";
      return std::nullopt;
    }
    return Step{request, *motion};
  }

  /// A place for the TCP in front of the robot, where wanted in the reach of another one too.
  Pose target(RobotIndex robot) {
    constexpr int kDraws = 200;
    const Robot& r = cell_.robots[robot];
    const bool share = dice_.chance(options_.shared);
    Vector3 p_BT = Vector3::Zero();
    for (int draw = 0; draw < kDraws; ++draw) {
      p_BT = place(r.model);
      if (!share || in_anothers_reach(robot, r.X_WB * p_BT)) break;
    }
    const double yaw = dice_.whole(-kYaw, kYaw) / kPerRadian;
    const double pitch = dice_.whole(-kPitch, kPitch) / kPerRadian;
    // The flange's z axis points where the hand does; at yaw and pitch 0 that is the base's x axis.
    const Eigen::Quaterniond q_BF{Eigen::AngleAxisd{yaw, Vector3::UnitZ()} * Eigen::AngleAxisd{pitch + kPi / 2, Vector3::UnitY()}};
    return whole(r.X_WB * model::make_pose(p_BT, q_BF * Eigen::Quaterniond{r.model.X_FT.linear()}));
  }

  Vector3 place(const model::RobotModel& m) {
    const double reach = tcp_reach(m);
    const double height = reach * dice_.between(kLowest, kHighest);
    const double radius = reach * dice_.between(kNearest, kFarthest);
    const double angle = dice_.between(-kSideways, kSideways);
    return {radius * std::cos(angle), radius * std::sin(angle), m.kinematics.parameters().c1 + height};
  }

  [[nodiscard]] bool in_anothers_reach(RobotIndex robot, const Vector3& p_WT) const {
    for (RobotIndex other = 0; other < cell_.robots.size(); ++other) {
      const Robot& r = cell_.robots[other];
      if (other != robot && (p_WT - shoulder(r)).norm() < tcp_reach(r.model) * kFarthest) return true;
    }
    return false;
  }

  [[nodiscard]] std::string complaint(RobotIndex robot, bool at_home) const {
    std::string why;
    for (const auto& [reason, count] : refusals_) why += fmt::format("{}{} {}", why.empty() ? "" : ", ", count, reason);
    return fmt::format("{} finds no target from {} that is clear while all others are home; tried {}: {}", cell_.robots[robot].name.str(),
                       at_home ? "its home" : "where it is and no way home", kTrials, why);
  }

  const model::Cell& cell_;
  const GeneratorOptions& options_;
  Dice dice_;
  AllOthersHome others_home_;
  std::map<std::string, int> refusals_;  // of the last robot's trials
};

}  // namespace

model::Result<model::Program, std::string> generate_program(const model::Cell& cell, const GeneratorOptions& options) {
  return Generator{cell, options}.run();
}

}  // namespace interlace::sim
