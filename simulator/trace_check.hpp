#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "common/model/bodies.hpp"
#include "simulator/fixture_check.hpp"

namespace interlace::sim {

/// Where two robots, or a robot and a fixture, were nearest to each other.
struct Nearest {
  double clearance = std::numeric_limits<double>::infinity();  ///< [m]; ≤ 0 is a collision
  double t = 0;                                                ///< [s]
  model::RobotIndex a = 0, b = 0;
  std::string link_a, link_b;  ///< with a fixture `b` is `a`, and `link_b` is "fixture NAME"
};

/// Judges recorded joint postures: the least clearance of all pairs of robots, and of robots and fixtures, and how often one began to touch
/// another. What it says holds for every posture given. Distances and bounds are its own and share no code with the planner, nor with the
/// observer.
///
/// Work is left out only where a bound proves that it changes nothing: since a pair was last measured, no point of a robot has moved
/// farther than the sum over its joints of |Δq| times the joint's longest lever. While that cannot bring the pair below the least
/// clearance it has had, nor to contact, nothing is placed and nothing measured. A body near a fixture is placed, and measured only when
/// its ends have gone far enough since it last was. Not thread-safe. The cell must outlive it.
class TraceCheck {
 public:
  explicit TraceCheck(const model::Cell& cell);

  /// From the next step on `robot` holds `tools`; nothing before the first call, which a trace cannot tell.
  void hold(model::RobotIndex robot, model::ToolSet tools);

  /// All robots at `joints` [rad], in the order of the cell, at `t` [s].
  void step(double t, const std::vector<model::Joints>& joints);

  [[nodiscard]] const Nearest& least() const { return least_; }
  [[nodiscard]] std::size_t collisions() const { return collisions_; }              ///< how often a pair began to touch, fixtures included
  [[nodiscard]] std::size_t fixture_contacts() const { return fixture_contacts_; }  ///< how many of them with a fixture
  [[nodiscard]] std::size_t steps() const { return steps_; }                        ///< postures judged
  [[nodiscard]] std::size_t measured() const { return measured_; }                  ///< pairs measured in them, for statistics

 private:
  struct Arm {
    const model::Robot* body = nullptr;          // with what it holds
    std::array<double, model::kJoints> lever{};  // longest distance of a body's point from each joint's axis [m]
    model::Joints q;
    double travelled = 0;  // bound of the way of any point so far [m]
    std::vector<model::Capsule> bodies;
    bool placed = false;  // bodies are those of q
  };
  struct Pair {
    model::RobotIndex a, b;
    double clearance = 0;                      // when last measured [m]
    double travelled_a = -1, travelled_b = 0;  // then; before the first measurement negative
    double least = std::numeric_limits<double>::infinity();
    bool touching = false;
  };
  struct Measured {
    model::Vector3 a, b;                                          // ends of the body's axis when it was last measured
    double clearance = -std::numeric_limits<double>::infinity();  // then: at least this [m]
  };
  struct Place {
    model::RobotIndex robot;
    std::size_t fixture;
    std::vector<Measured> bodies;
    double clearance = 0;   // when last looked at: at least this [m]
    double travelled = -1;  // then; before the first measurement negative
    double least = std::numeric_limits<double>::infinity();
    bool touching = false;
  };
  void measure(double t, Pair& pair);
  void measure(double t, Place& place);
  const std::vector<model::Capsule>& bodies(model::RobotIndex robot);

  const model::Cell& cell_;
  model::Bodies held_;
  std::vector<Arm> arms_;
  std::vector<Pair> pairs_;
  FixtureCheck fixtures_;
  std::vector<Place> places_;
  Nearest least_;
  std::size_t collisions_ = 0, fixture_contacts_ = 0, steps_ = 0, measured_ = 0;
};

}  // namespace interlace::sim
