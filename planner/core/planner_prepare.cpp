// Between decisions: work that the next ones will ask for is done before anybody waits for it.
#include <algorithm>

#include "planner/core/planner.hpp"

namespace interlace::core {

bool Planner::prepare() {
  if (prepared_ || !strategy_->service().maps) return false;
  for (std::size_t looked = 0; looked < robots_.size(); ++looked) {
    if (prepare_for(robots_[next_prepared_])) return true;
    next_prepared_ = (next_prepared_ + 1) % robots_.size();
  }
  if (ahead_.outlook && ahead_.outlook->prepare(maps_)) return true;
  prepared_ = true;
  return false;
}

/// Builds one map of `r`'s next command against a neighbour: as it stands or moves, as it will stand after that, and in its own next
/// command. False when all of these are there, or there is no room for more.
bool Planner::prepare_for(const RobotRecord& r) {
  const QueuedCommand* next = r.next();
  if (!next) return false;
  const auto build = [&](const SampledMotionPtr& moving) {
    if (maps_.holds(next->motion, moving) || !maps_.has_room()) return false;
    (void)maps_.get(next->motion, moving);
    return true;
  };
  const auto build_all_of = [&](const SampledMotionPtr& moving) {
    return build(moving) || (moving->motion().duration() > 0 && build(moving->standing_at_end()));
  };
  const auto& neighbours = neighbourhood_.of(index_of(r));
  const auto as_they_are = [&](model::RobotIndex i) {
    const RobotRecord& other = robots_[i];
    if (other.following && build_all_of(other.following->command.motion)) return true;
    return other.committed ? build_all_of(other.committed->command.motion) : build(other.standing);
  };
  const auto as_they_will_be = [&](model::RobotIndex i) {
    const QueuedCommand* theirs = robots_[i].next();
    return theirs && build(theirs->motion);
  };
  return std::any_of(neighbours.begin(), neighbours.end(), as_they_are) ||
         std::any_of(neighbours.begin(), neighbours.end(), as_they_will_be);
}

}  // namespace interlace::core
