#include "planner/core/eef_map.hpp"

#include <algorithm>

namespace interlace::core {

namespace {

constexpr std::size_t kWrist = 4;  ///< the first link of the hand

model::Robot hand_alone(model::Robot robot) {
  auto& capsules = robot.model.capsules;
  capsules.erase(std::remove_if(capsules.begin(), capsules.end(), [](const model::LinkCapsule& c) { return c.link < kWrist; }),
                 capsules.end());
  robot.model.self_pairs.clear();
  return robot;
}

}  // namespace

EefMap::EefMap(const model::Cell& cell) : resolution_(cell.planning.resolution), event_(make_strategy("event", cell)) {
  hands_.reserve(cell.robots.size());  // motions refer to them
  for (const model::Robot& robot : cell.robots) hands_.push_back(hand_alone(robot));
}

SampledMotionPtr EefMap::hand_of(model::RobotIndex robot, const SampledMotionPtr& whole) const {
  if (const auto found = kept_.find(whole->id()); found != kept_.end()) return found->second.hand;
  for (auto it = kept_.begin(); it != kept_.end();) it = it->second.whole.expired() ? kept_.erase(it) : std::next(it);
  auto hand = std::make_shared<SampledMotion>(whole->motion().with_bodies_of(hands_[robot]), resolution_);
  return kept_.emplace(whole->id(), Kept{whole, std::move(hand)}).first->second.hand;
}

Assessment EefMap::assess(const Candidate& candidate, const std::vector<Neighbour>& neighbours, const Timing& timing, MapStore& maps,
                          Evidence evidence) const {
  Candidate hand = candidate;
  hand.motion = hand_of(candidate.robot, candidate.motion);
  std::vector<Neighbour> others = neighbours;
  for (Neighbour& n : others) n.motion = hand_of(n.robot, n.motion);
  return event_->assess(hand, others, timing, maps, evidence);
}

}  // namespace interlace::core
