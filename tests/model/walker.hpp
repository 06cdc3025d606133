#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <unordered_map>
#include <vector>

#include "tests/model/world.hpp"

namespace interlace::test {

/// What a walk through a scenario has found.
struct Walk {
  std::size_t states = 0;                                  ///< different ones
  std::size_t branches = 0;                                ///< that ended, or met a state seen before
  std::size_t ends = 0;                                    ///< different last states
  std::size_t depth = 0;                                   ///< of the longest branch
  double interleavings = 0;                                ///< ways from the first state to a last one
  double least = std::numeric_limits<double>::infinity();  ///< clearance [m]
  bool whole = true;                                       ///< nothing was left out
  std::string fault;                                       ///< the first one, with what led to it
  std::size_t delays = 0, cancels = 0;                     ///< ends with a delayed command, with a cancelled one
  std::size_t most_escapes = 0;                            ///< carried out in one branch
  std::vector<std::vector<std::size_t>> samples;           ///< numbers of the choices of some branches to their ends
  std::vector<std::string> sample_ends;                    ///< and the signatures there
};

/// Walks a scenario depth first through every order of its events, each state once. Stops at the first fault.
class Walker {
 public:
  /// At most `limit` states: a walk that is cut there says so.
  Walker(const Scenario& scenario, std::size_t limit);

  Walk walk();

  /// The state that numbers of choices lead to from the start.
  [[nodiscard]] World replay(const std::vector<std::size_t>& numbers);

 private:
  static constexpr double kOpen = -1;  // on the way to the present state
  static constexpr std::size_t kDeepest = 2000;

  double walk_from(World world);
  double end_at(const World& world);
  void blame(const std::string& text);

  const Scenario& scenario_;
  std::size_t limit_;
  MotionsSeen motions_;
  Judge judge_;
  Walk found_;
  std::unordered_map<std::string, double> seen_;  // interleavings from each state on
  std::vector<std::size_t> numbers_;
  std::vector<std::string> told_;
};

}  // namespace interlace::test
