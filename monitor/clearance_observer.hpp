#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "common/model/bodies.hpp"
#include "monitor/fixture_observer.hpp"

namespace interlace::monitor {

/// What an observer has seen of one pair of robots.
struct PairClearance {
  model::RobotIndex a = 0, b = 0;
  double least = 0;  ///< least clearance between their bodies [m]; ≤ 0 is a collision
  double at = 0;     ///< when [s]
  std::string link_a, link_b;
  double below_zero = 0;     ///< time in collision [s]
  std::size_t contacts = 0;  ///< how often a collision began
};

/// Judges a run by the robots' postures alone: places every capsule and measures every pair of links, and every link and fixture, at equal
/// steps of time, postures in between interpolated. Shares neither state nor distance code with the planner, so a mistake there shows here.
/// Pure: time comes in with the postures. Not thread-safe.
class ClearanceObserver {
 public:
  /// Measures every `step` [s]. A robot silent for longer than `patience` [s] is left out until it is heard again. `cell` must outlive it.
  ClearanceObserver(const model::Cell& cell, double step, double patience);

  /// Robot stands or passes at `joints` [rad] at `t` [s] with `tools` in its hand; older news than the last of that robot are ignored.
  /// Between two postures it is taken to hold what it holds at either.
  void on_posture(model::RobotIndex robot, double t, const model::Joints& joints, model::ToolSet tools = {});

  /// Least clearance of all pairs so far; empty until two robots were seen at the same time.
  [[nodiscard]] std::optional<PairClearance> least() const;
  [[nodiscard]] const std::vector<PairClearance>& pairs() const { return pairs_; }
  [[nodiscard]] const FixtureObserver& fixtures() const { return fixtures_; }
  /// Least clearance of anything measured so far [m], fixtures included; empty when nothing was.
  [[nodiscard]] std::optional<double> least_clearance() const;
  [[nodiscard]] double below_zero() const { return below_zero_; }                        ///< time in which anything was in collision [s]
  [[nodiscard]] std::size_t contacts() const;                                            ///< fixtures included
  [[nodiscard]] double observed() const { return static_cast<double>(steps_) * step_; }  ///< time examined [s]

 private:
  struct Sample {
    double t;
    model::Joints q;
    model::ToolSet tools;
  };
  struct Track {
    const model::Robot* body = nullptr;  // with what it holds
    std::deque<Sample> samples;
    std::vector<model::Capsule> bodies;
    bool placed = false;   // bodies are where the robot is
    model::Joints q;       // that bodies show, once there are any
    double travelled = 0;  // bound of the way of any of their points so far [m]
  };
  struct PairState {
    bool seen = false;
    bool current = false;  // measured with what both hold now
    bool touching = false;
    // When last measured: a lower bound of the clearance, and how far both had travelled [m].
    double clearance = 0;
    double travelled_a = 0, travelled_b = 0;
  };
  void examine_up_to(double newest);
  void place_at(double t);
  void place(model::RobotIndex robot, const model::Joints& q, model::ToolSet tools);
  bool measure_pair(double t, PairClearance& pair, PairState& state);
  void measure(double t);

  model::Bodies held_;
  double step_;
  double patience_;
  std::vector<Track> tracks_;
  std::vector<PairClearance> pairs_;
  std::vector<PairState> states_;
  FixtureObserver fixtures_;
  std::optional<double> next_;  // next time to examine [s]
  std::size_t steps_ = 0;
  double below_zero_ = 0;
};

}  // namespace interlace::monitor
