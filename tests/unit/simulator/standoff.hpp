#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "simulator/trace_check.hpp"
#include "simulator/virtual_cell.hpp"
#include "tests/support/motions.hpp"

namespace interlace::test {

using model::CommandState;
using model::Reason;
using model::Vector3;

/// A crafted situation, run in virtual time by the real planner, proxies and controllers. Safety is judged from the controllers' postures
/// by sim::TraceCheck, which shares no code with the planner.
class Standoff {
 public:
  /// What one motion of a robot came to, escapes included, in the order of their decisions.
  struct Trip {
    std::string id, robot, serves, text;
    bool escape = false;
    CommandState state = CommandState::scheduled;
    model::Joints from = model::Joints::Zero(), to = model::Joints::Zero();        ///< where the robot stood before and after [rad]
    model::Pose X_WT0 = model::Pose::Identity(), X_WT1 = model::Pose::Identity();  ///< its TCP there
    [[nodiscard]] Vector3 way() const { return X_WT1.translation() - X_WT0.translation(); }
    [[nodiscard]] bool orientation_kept() const { return (X_WT1.linear() - X_WT0.linear()).norm() < 1e-6; }
  };

  explicit Standoff(std::shared_ptr<const model::Cell> its_cell) : cell(std::move(its_cell)), check_(*cell) {}

  /// The next command of `robot`, released at `at` [s]. Its id is <robot>-<n>, n from 1 on.
  Standoff& command(const std::string& robot, const model::MotionRequest& motion, double at = 0) {
    const model::RobotName name{robot};
    auto entry = std::find_if(program_.robots.begin(), program_.robots.end(), [&](const auto& r) { return r.first == name; });
    if (entry == program_.robots.end()) entry = program_.robots.insert(entry, {name, {}});
    model::ProgramStep step;
    step.motion = motion;
    step.at = at;
    entry->second.push_back(std::move(step));
    return *this;
  }

  Standoff& run(const std::string& strategy = "event") {
    sim::VirtualOptions options;
    options.strategy = strategy;
    options.check_period = 0.002;
    options.observe = false;
    options.on_status = [this](const model::CommandStatus& s) { heard(s); };
    options.on_postures = [this](double t, const std::vector<model::Joints>& q) { saw(t, q); };
    report = sim::run_virtual(cell, program_, options);
    return *this;
  }

  /// No robot touches another in any posture, every submitted command completes, and no motion is left undone.
  void expect_safe_and_served() const {
    EXPECT_EQ(check_.collisions(), 0U) << check_.least().link_a << " and " << check_.least().link_b << " at " << check_.least().t << " s";
    EXPECT_GT(check_.least().clearance, 0);
    EXPECT_EQ(report.completed, program_.size()) << story();
    for (const auto& [id, status] : last) EXPECT_EQ(status.state, CommandState::completed) << id << "\n" << story();
  }

  [[nodiscard]] std::vector<Trip> escapes() const {
    std::vector<Trip> result;
    std::copy_if(trips.begin(), trips.end(), std::back_inserter(result), [](const Trip& t) { return t.escape; });
    return result;
  }

  /// Everything that was said of `id`, in order.
  [[nodiscard]] std::vector<model::CommandStatus> said_of(const std::string& id) const {
    std::vector<model::CommandStatus> result;
    std::copy_if(statuses.begin(), statuses.end(), std::back_inserter(result), [&](const auto& s) { return s.id.str() == id; });
    return result;
  }

  /// The first status of `id` in `state`; fails the test when there is none.
  [[nodiscard]] model::CommandStatus first_of(const std::string& id, CommandState state) const {
    for (const auto& s : statuses) {
      if (s.id.str() == id && s.state == state) return s;
    }
    ADD_FAILURE() << id << " never was " << model::to_string(state) << "\n" << story();
    return {};
  }

  /// Everything that was said, a line each.
  [[nodiscard]] std::string story() const {
    std::string text;
    for (const auto& s : statuses) {
      text += "  " + s.id.str() + " of " + s.robot.str() + " " + model::to_string(s.state) + " (" + model::to_string(s.reason) + ")" +
              (s.serves.empty() ? "" : " for " + s.serves.str()) + (s.text.empty() ? "" : ": " + s.text) + "\n";
      for (const auto& r : s.refusals) text += "    " + r.robot.str() + " " + model::to_string(r.way) + ": " + r.text + "\n";
    }
    return text;
  }

  std::shared_ptr<const model::Cell> cell;
  app::RunReport report;
  std::vector<model::CommandStatus> statuses;
  std::map<std::string, model::CommandStatus> last;
  std::vector<Trip> trips;

 private:
  void heard(const model::CommandStatus& s) {
    statuses.push_back(s);
    last[s.id.str()] = s;
    if (s.state == CommandState::scheduled) {
      const auto known = std::find_if(trips.begin(), trips.end(), [&](const Trip& t) { return t.id == s.id.str(); });
      if (known == trips.end()) {
        Trip trip;
        trip.id = s.id.str();
        trip.robot = s.robot.str();
        trip.serves = s.serves.str();
        trip.escape = s.escape;
        trips.push_back(std::move(trip));
      }
    }
    for (Trip& trip : trips) {
      if (trip.id != s.id.str()) continue;
      trip.state = s.state;
      trip.text = s.state == CommandState::scheduled ? s.text : trip.text;
      if (s.state == CommandState::started) place(trip, trip.from, trip.X_WT0);
      if (s.state == CommandState::completed) arrived_.push_back(static_cast<std::size_t>(&trip - trips.data()));
    }
  }

  void saw(double t, const std::vector<model::Joints>& q) {
    postures_ = q;
    check_.step(t, q);
    for (const std::size_t i : arrived_) place(trips[i], trips[i].to, trips[i].X_WT1);
    arrived_.clear();
  }

  void place(const Trip& trip, model::Joints& q, model::Pose& X_WT) const {
    const auto index = cell->find(model::RobotName{trip.robot}).value();
    q = postures_.empty() ? cell->robots[index].start : postures_[index];
    X_WT = cell->robots[index].X_WB * model::tcp_pose(cell->robots[index].model, q);
  }

  sim::TraceCheck check_;
  model::Program program_;
  std::vector<model::Joints> postures_;
  std::vector<std::size_t> arrived_;  // trips whose end is seen with the next postures
};

}  // namespace interlace::test
