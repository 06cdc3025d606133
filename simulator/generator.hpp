#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "common/model/cell.hpp"
#include "common/model/program.hpp"
#include "common/model/result.hpp"

namespace interlace::sim {

/// What a random program shall be like. Shares are 0 … 1.
struct GeneratorOptions {
  std::uint64_t seed = 1;
  std::size_t per_robot = 10;  ///< commands for each robot
  double shared = 0.7;         ///< share of targets in space that another robot reaches too, where there is such space
  double joint_moves = 0.15;   ///< share of joint moves; none for models without joint speeds
  double slower = 0.15;        ///< share of commands with a TCP speed below the robot's
};

/// A random program that is well-formed (DESIGN section 6). Of each command, from where its robot will be:
/// * it is admissible: reachable, within limits, clear of the robot itself, of the fixtures and of the others' bases;
/// * all of it, its end included, is clear of all others standing at home, certified like the planner's collision maps;
/// * from its end the robot can go home, by a linear or a joint move that is admissible and clear in the same way;
/// * it is admissible and clear in the same way from home too, so that a robot that was sent home in between can still carry it out.
/// Targets are whole millimetres and degrees: places in front of the robot at a working height, the hand within 30° of its own forward
/// direction sideways and 20° up or down. Where a robot finds no such target from where it is, its next command is the way home.
/// The same cell and options give the same program on every machine. Pure; any thread.
/// The error says which robot finds no target even from home, and what was wrong with those tried.
[[nodiscard]] model::Result<model::Program, std::string> generate_program(const model::Cell& cell, const GeneratorOptions& options);

}  // namespace interlace::sim
