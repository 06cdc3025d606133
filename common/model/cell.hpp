#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "common/model/fixture.hpp"
#include "common/model/ids.hpp"
#include "common/model/robot_model.hpp"
#include "common/model/tools.hpp"

namespace interlace::model {

/// Speed limits of a TCP. Without angular limits a rotation follows the translation it goes with, and a pure rotation takes
/// kUnlimitedRotation; see docs/adr/0002-rotation-without-limits.md.
struct TcpLimits {
  double velocity = 0;                         ///< [m/s]
  double acceleration = 0;                     ///< [m/s²]
  std::optional<double> angular_velocity;      ///< [rad/s]
  std::optional<double> angular_acceleration;  ///< [rad/s²]
  double slowest = 1;                          ///< least part of its speed at which the strategy `lookahead` may let a linear move go
};

/// How far a controller may be from ideal. The planner widens its predictions by it; the simulated controller draws from it.
struct ControllerTraits {
  double start_latency = 0;  ///< mean time from the command to the first movement [s]
  double start_jitter = 0;   ///< largest deviation from that mean [s]
  double speed_error = 0;    ///< largest relative deviation of the duration, 0.01 = 1 %
  double path_error = 0;     ///< largest distance of any point of the robot from where its path has it [m]

  /// Latest start after the command [s].
  [[nodiscard]] double latest_start() const { return start_latency + start_jitter; }
};

struct Robot {
  RobotName name;
  RobotModel model;
  Pose X_WB = Pose::Identity();
  Joints start = Joints::Zero();  ///< joints when the cell is switched on
  Joints home = Joints::Zero();
  TcpLimits tcp;
  ControllerTraits controller;
  std::vector<ToolName> holds;  ///< what is in its hand when the cell is switched on
  ToolSet tools;                ///< whose capsules `model` has as well: none in a cell, see Bodies
};

/// Axis-aligned box in the world frame [m].
struct Box {
  Vector3 min = Vector3::Zero();
  Vector3 max = Vector3::Zero();
};

struct PlanningOptions {
  double resolution = 0.01;  ///< smallest cell of a collision map [s]
  double margin = 0;         ///< clearance kept beyond contact [m]
  std::string strategy = "lookahead";
  bool escapes = true;                    ///< robots in the way are sent out of it; else their neighbours wait for people
  std::optional<double> lead;             ///< shortest time from a decision to a start [s]; default: the program's own
  std::optional<double> start_tolerance;  ///< latest start after the planned one, before the controller's own latency [s]; ditto
  double patience = 120;                  ///< a command whose turn came longer ago goes before all others, whatever their priority [s]
  double budget = 0.02;                   ///< of one decision of the strategy `lookahead` [s], counted in work, not measured
  double promise = 0;       ///< a start of `lookahead` may be so long before a promised departure it relies on [s]; 0: only after
  std::optional<Box> zone;  ///< of the strategy `zone`; default: made from what the robots can reach
};

/// Checked description of one cell: at least one robot, unique names, start postures reachable, inside limits and clear of each other
/// and of the fixtures.
struct Cell {
  std::string name;
  std::vector<Robot> robots;
  std::vector<Fixture> fixtures;
  std::vector<Tool> tools;  ///< at most kMaxTools, names unique
  PlanningOptions planning;

  /// Index of the robot called `name`, if there is one.
  [[nodiscard]] std::optional<RobotIndex> find(const RobotName& robot) const {
    for (RobotIndex i = 0; i < robots.size(); ++i) {
      if (robots[i].name == robot) return i;
    }
    return std::nullopt;
  }

  /// The tool called `name` as a set; empty optional when the cell does not know it.
  [[nodiscard]] std::optional<ToolSet> find(const ToolName& tool) const {
    for (std::size_t i = 0; i < tools.size(); ++i) {
      if (tools[i].name == tool) return ToolSet::of(i);
    }
    return std::nullopt;
  }
  [[nodiscard]] ToolSet all_tools() const { return ToolSet::first(tools.size()); }

  /// The set of `names`. A name the cell does not know could be anything, so it stands for all tools.
  [[nodiscard]] ToolSet set_of(const std::vector<ToolName>& names) const {
    ToolSet set;
    for (const ToolName& tool : names) set = set | find(tool).value_or(all_tools());
    return set;
  }
  [[nodiscard]] std::vector<ToolName> names_of(ToolSet set) const {
    std::vector<ToolName> names;
    for (std::size_t i = 0; i < tools.size(); ++i) {
      if (set.has(i)) names.push_back(tools[i].name);
    }
    return names;
  }
};

}  // namespace interlace::model
