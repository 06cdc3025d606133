#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "common/app/report.hpp"
#include "common/model/cell.hpp"

namespace interlace::monitor {

/// What an observer has seen of one robot and one fixture.
struct FixtureClearance {
  model::RobotIndex robot = 0;
  std::size_t fixture = 0;   ///< index in the cell
  double least = 0;          ///< least clearance of its bodies, link 0 left out [m]; ≤ 0 is a collision
  double at = 0;             ///< when [s]
  std::string link;          ///< empty: never near enough to be measured
  double below_zero = 0;     ///< time in collision [s]
  std::size_t contacts = 0;  ///< how often a collision began
};

/// The part of a clearance observer that looks at things that never move. Pure. Not thread-safe. `cell` must outlive it.
class FixtureObserver {
 public:
  explicit FixtureObserver(const model::Cell& cell);

  /// `robot`, of `model`, has its bodies at `bodies` at `t` [s], for `step` [s]. `travelled`: bound of the way of any of their points so
  /// far [m]; while that cannot have brought them nearer than ever, or to contact, nothing is measured. True: it touches a fixture.
  bool measure(model::RobotIndex robot, const model::RobotModel& model, const std::vector<model::Capsule>& bodies, double travelled,
               double t, double step);

  /// `robot` holds something else: what was measured of it says nothing any more.
  void forget(model::RobotIndex robot);

  /// Robots in the order of the cell, for each of them the fixtures.
  [[nodiscard]] const std::vector<FixtureClearance>& pairs() const { return pairs_; }
  /// The one with the least clearance; null when none was measured.
  [[nodiscard]] const FixtureClearance* least() const;
  [[nodiscard]] std::size_t contacts() const;
  /// The contacts, for a report.
  [[nodiscard]] std::vector<app::FixtureContact> report() const;

 private:
  struct State {
    bool current = false;  // what follows was measured with what the robot holds now
    double clearance = 0;  // lower bound then [m]
    double travelled = 0;  // then [m]
    bool touching = false;
  };
  bool measure(FixtureClearance& pair, State& state, const model::RobotModel& model, const std::vector<model::Capsule>& bodies,
               double travelled, double t);

  const model::Cell& cell_;
  std::vector<FixtureClearance> pairs_;
  std::vector<State> states_;
};

}  // namespace interlace::monitor
