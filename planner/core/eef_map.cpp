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

EefMap::EefMap(const model::Cell& cell) : resolution_(cell.planning.resolution), event_(make_strategy("event", cell)) {}

const model::Robot& EefMap::hand_of(const model::Robot& body) const {
  std::unique_ptr<const model::Robot>& hand = hands_[{body.name, body.tools}];
  if (!hand) hand = std::make_unique<const model::Robot>(hand_alone(body));
  return *hand;
}

SampledMotionPtr EefMap::hand_of(const SampledMotionPtr& whole) const {
  if (const auto found = kept_.find(whole->id()); found != kept_.end()) return found->second.hand;
  for (auto it = kept_.begin(); it != kept_.end();) it = it->second.whole.expired() ? kept_.erase(it) : std::next(it);
  const model::MotionBodies& b = whole->bodies();
  const model::MotionBodies hands{&hand_of(*b.at_start), &hand_of(*b.during), &hand_of(*b.at_end), &hand_of(*b.after), &hand_of(*b.all)};
  auto hand = std::make_shared<SampledMotion>(whole->motion().with_bodies_of(hand_of(whole->robot())), resolution_, hands);
  return kept_.emplace(whole->id(), Kept{whole, std::move(hand)}).first->second.hand;
}

Assessment EefMap::assess(const Candidate& candidate, const std::vector<Neighbour>& neighbours, const Timing& timing, MapStore& maps,
                          Evidence evidence) const {
  Candidate hand = candidate;
  hand.motion = hand_of(candidate.motion);
  std::vector<Neighbour> others = neighbours;
  for (Neighbour& n : others) n.motion = hand_of(n.motion);
  return event_->assess(hand, others, timing, maps, evidence);
}

}  // namespace interlace::core
