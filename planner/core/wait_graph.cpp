#include "planner/core/wait_graph.hpp"

#include <algorithm>
#include <deque>

namespace interlace::core {

using model::RobotIndex;

bool WaitGraph::moves_by_itself(RobotIndex robot) const {
  enum class Answer { unasked, asking, yes, no };
  std::vector<Answer> answers(nodes_.size(), Answer::unasked);
  const auto moves = [&](const auto& self, RobotIndex r) -> bool {
    Answer& answer = answers[r];
    if (answer != Answer::unasked) return answer == Answer::yes;  // what is still being asked is a circle, and that moves nobody
    const WaitNode& n = nodes_[r];
    answer = Answer::asking;
    const bool yes = n.state == WaitNode::State::moves ||
                     (n.state == WaitNode::State::waits && !n.blockers.empty() &&
                      std::all_of(n.blockers.begin(), n.blockers.end(), [&](RobotIndex b) { return self(self, b); }));
    answer = yes ? Answer::yes : Answer::no;
    return yes;
  };
  return moves(moves, robot);
}

std::vector<RobotIndex> WaitGraph::circle(RobotIndex robot) const {
  std::vector<RobotIndex> came_from(nodes_.size(), nodes_.size());
  std::deque<RobotIndex> open{robot};
  while (!open.empty()) {
    const RobotIndex r = open.front();
    open.pop_front();
    if (nodes_[r].state != WaitNode::State::waits) continue;
    for (const RobotIndex b : nodes_[r].blockers) {
      if (b == robot) {
        std::vector<RobotIndex> path{r};
        while (path.back() != robot) path.push_back(came_from[path.back()]);
        std::reverse(path.begin(), path.end());
        return path;
      }
      if (came_from[b] != nodes_.size()) continue;
      came_from[b] = r;
      open.push_back(b);
    }
  }
  return {};
}

bool WaitGraph::deadlocked(RobotIndex robot) const {
  const WaitNode& n = nodes_[robot];
  if (n.state != WaitNode::State::waits || n.blockers.empty()) return false;
  return std::none_of(n.blockers.begin(), n.blockers.end(), [&](RobotIndex b) { return moves_by_itself(b); });
}

}  // namespace interlace::core
