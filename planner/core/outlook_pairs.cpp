// What pairs of robots have before them together: by this the search tells good beginnings from bad ones.
#include <algorithm>
#include <limits>

#include "planner/core/outlook.hpp"
#include "planner/core/outlook_work.hpp"

namespace interlace::core {

using model::RobotIndex;

namespace {

constexpr std::size_t kAhead = 16;        // of the motions that wait for each of two
constexpr std::size_t kAheadAtLeast = 8;  // of them left before more are taken in

double shift(Instant t) {
  if (t == model::kEarliest) return -std::numeric_limits<double>::infinity();
  if (t == model::kForever) return std::numeric_limits<double>::infinity();
  return model::to_seconds(t);
}

/// How many of `ids` have gone since; empty when what waits now is something else, or too little of it is among them.
std::optional<std::size_t> gone(const std::vector<std::uint64_t>& ids, const std::vector<WaitingMotion>& queue) {
  if (queue.empty()) return ids.size();
  const auto first = std::find(ids.begin(), ids.end(), queue.front().motion->id());
  const auto left = static_cast<std::size_t>(ids.end() - first);
  if (left > queue.size() || (left < kAheadAtLeast && left < queue.size())) return std::nullopt;
  const bool same =
      std::equal(first, ids.end(), queue.begin(), [](std::uint64_t id, const WaitingMotion& w) { return id == w.motion->id(); });
  if (!same) return std::nullopt;
  return static_cast<std::size_t>(first - ids.begin());
}

}  // namespace

/// What `robot` has before it beside `other`. Of pairs of motions that nobody has looked at and that there is no budget for, it is taken
/// that they go well together.
PairRest::Side Outlook::beside(RobotIndex robot, RobotIndex other, std::size_t& unknown) {
  const auto takes = [&](const SampledMotionPtr& m) { return model::to_seconds(duration_of(m) + robots_[robot].tolerance + lead_); };
  const auto& queue = robots_[robot].queue;
  const auto& others = robots_[other].queue;
  PairRest::Side side;
  side.takes.push_back(takes(robots_[robot].seen.back().motion));
  for (std::size_t i = 0; i < std::min(queue.size(), kAhead); ++i) {
    const SampledMotionPtr& motion = queue[i].motion;
    side.takes.push_back(takes(motion));
    auto& forbidden = side.forbidden.emplace_back();
    for (std::size_t k = 0; k <= std::min(others.size(), kAhead); ++k) {
      auto& by_this = forbidden.emplace_back();
      const SampledMotionPtr& moving = k == 0 ? robots_[other].seen.back().motion : others[k - 1].motion;
      work_ += 1;
      auto& known = row_of(motion).with;
      auto entry = known.find(moving->id());
      if (entry == known.end() && map_work_ * 2 < map_budget_) {
        entry = known.emplace(moving->id(), make_pair(robot, motion, other, moving)).first;
      }
      if (entry == known.end()) {
        ++unknown;
        continue;
      }
      for (const StartInterval& f : entry->second.forbidden) by_this.push_back({shift(f.from), shift(f.until)});
    }
  }
  return side;
}

void Outlook::look_at(Together& t) {
  const auto ids = [&](RobotIndex robot) {
    std::vector<std::uint64_t> of_robot;
    const auto& queue = robots_[robot].queue;
    for (std::size_t k = 0; k < std::min(queue.size(), kAhead); ++k) of_robot.push_back(queue[k].motion->id());
    return of_robot;
  };
  t.ids = {ids(t.robots[0]), ids(t.robots[1])};
  t.gone = {0, 0};
  t.unknown = 0;
  const PairRest::Side first = beside(t.robots[0], t.robots[1], t.unknown);
  const PairRest::Side second = beside(t.robots[1], t.robots[0], t.unknown);
  t.rest.emplace(first, second);
  work_ += t.rest->steps();
}

/// Once for all that waits; again when that is something else, or when more may be known of it.
void Outlook::look_at_pairs() {
  if (together_.empty()) {
    for (RobotIndex a = 0; a < robots_.size(); ++a) {
      for (const RobotIndex b : neighbourhood_.of(a)) {
        if (b > a) together_.emplace_back().robots = {a, b};
      }
    }
  }
  for (Together& t : together_) {
    const std::array now{gone(t.ids[0], robots_[t.robots[0]].queue), gone(t.ids[1], robots_[t.robots[1]].queue)};
    const bool holds = t.rest && now[0] && now[1] && (t.unknown == 0 || (*now[0] == t.gone[0] && *now[1] == t.gone[1]));
    if (!holds) t.rest.reset();
    if (holds) {
      t.gone = {*now[0], *now[1]};
    } else if (2 * (work_ + map_work_) < budget_) {
      look_at(t);
    } else {
      continue;
    }
    for (const std::size_t side : {0, 1}) {
      const auto& queue = robots_[t.robots[side]].queue;
      t.beyond[side] = 0;
      for (std::size_t k = t.ids[side].size() - t.gone[side]; k < queue.size(); ++k) {
        t.beyond[side] += model::to_seconds(duration_of(queue[k].motion));
      }
    }
  }
}

/// When all ends, as it looks: the latest of what each robot and each pair need, and `mean` of the mean, so that of beginnings that look
/// the same to one robot the better one for the others goes first.
double Outlook::outlook_of(std::size_t node, double mean) {
  work_ += together_.size();
  ends_.resize(robots_.size());
  const auto rest_of = [](const RobotState& s) { return model::to_seconds(s.place->rest); };
  for (RobotIndex i = 0; i < robots_.size(); ++i) ends_[i] = model::to_seconds(state(node, i).free - lead_) + rest_of(state(node, i));
  for (const Together& t : together_) {
    if (!t.rest) continue;
    const std::array states{&state(node, t.robots[0]), &state(node, t.robots[1])};
    const std::array free{std::max(states[0]->free, nodes_[node].last), std::max(states[1]->free, nodes_[node].last)};
    const auto done = [&](std::size_t side) { return std::min(states[side]->place->done + t.gone[side], t.ids[side].size()); };
    const double end =
        model::to_seconds(std::min(free[0], free[1]) - lead_) + (*t.rest)(done(0), done(1), model::to_seconds(free[1] - free[0]));
    for (const std::size_t side : {0, 1}) {
      double& own = ends_[t.robots[side]];
      own = std::max(own, end + std::min(t.beyond[side], rest_of(*states[side])));
    }
  }
  double most = 0, sum = 0;
  for (const double end : ends_) {
    most = std::max(most, end);
    sum += end;
  }
  return most + mean * sum / static_cast<double>(ends_.size());
}

}  // namespace interlace::core
