#pragma once

#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "common/model/cell.hpp"
#include "planner/core/strategy.hpp"

namespace interlace::core {

/// The collision map of 1987: starts are chosen as `event` chooses them, but only end-effectors are looked at (capsules on links 4 to 6).
/// Everything else of the arms passes through each other unseen: a baseline to compare with, not a way to run a cell. An arm without such
/// capsules is never in anybody's way.
/// Keeps a copy of each motion with the hand alone as long as that motion lives, so not thread-safe.
/// Source: Lee, Lee: Collision-free motion planning of two robots, 1987; dissertation section 3.1.
class EefMap final : public Strategy {
 public:
  explicit EefMap(const model::Cell& cell);

  [[nodiscard]] std::string_view name() const override { return "eef-map"; }
  [[nodiscard]] Assessment assess(const Candidate& candidate, const std::vector<Neighbour>& neighbours, const Timing& timing,
                                  MapStore& maps, Evidence evidence) const override;

 private:
  struct Kept {
    std::weak_ptr<SampledMotion> whole;
    SampledMotionPtr hand;
  };
  [[nodiscard]] const model::Robot& hand_of(const model::Robot& body) const;
  [[nodiscard]] SampledMotionPtr hand_of(const SampledMotionPtr& whole) const;

  double resolution_;
  std::unique_ptr<Strategy> event_;
  mutable std::map<std::pair<model::RobotName, model::ToolSet>, std::unique_ptr<const model::Robot>> hands_;  ///< only hands are bodies
  mutable std::map<std::uint64_t, Kept> kept_;  ///< by the id of the whole motion; a memo, nothing depends on what it holds
};

}  // namespace interlace::core
