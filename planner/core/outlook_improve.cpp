// Local search: the starts of a plan in another order.
#include <algorithm>
#include <limits>
#include <random>

#include "planner/core/outlook.hpp"
#include "planner/core/outlook_work.hpp"

namespace interlace::core {

using model::RobotIndex;

/// Whether nobody's commands take longer than until `end`, even if nobody is in the way any more.
bool Outlook::can_end_by(std::size_t node, Instant end) const {
  const Instant next = nodes_[node].last - timing_.promise.value_or(Duration{});
  for (RobotIndex i = 0; i < robots_.size(); ++i) {
    const RobotState& s = state(node, i);
    const Instant from = s.place->next ? std::max(s.free, next) : s.free - lead_;
    if (from + s.place->rest > end) return false;
  }
  return true;
}

std::optional<OutlookPlan> Outlook::improve(const OutlookPlan& plan, std::size_t budget, MapStore& maps) {
  maps_ = &maps;
  work_ = 0;
  budget_ = std::numeric_limits<std::size_t>::max();
  if (!begin()) return std::nullopt;
  std::vector<const PlannedStart*> order, changed;
  for (const PlannedStart& p : plan.starts) {  // node k + 1 follows from start k
    order.push_back(&p);
    if (after(nodes_.size() - 1, p) != order.size()) return std::nullopt;
  }
  std::mt19937_64 random{looks_};
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
  const std::size_t n_robots = robots_.size();
  bool found = false;
  while (work_ <= budget && order.size() > 1) {
    work_ += kNodeWork;
    const std::size_t from = below(order.size());
    const RobotIndex robot = order[from]->robot;
    changed = order;
    std::size_t first = from;  // that is not as before
    const auto at = [&](std::size_t k) { return changed.begin() + static_cast<std::ptrdiff_t>(k); };
    if (order[from]->detour && below(4) == 0) {
      changed.erase(at(from));
    } else {
      std::size_t low = from, high = from;
      while (low > 0 && order[low - 1]->robot != robot) --low;
      while (high + 1 < order.size() && order[high + 1]->robot != robot) ++high;
      if (low == high) continue;
      std::size_t to = low + below(high - low);
      if (to >= from) ++to;
      if (to < from) {
        std::rotate(at(to), at(from), at(from + 1));
      } else {
        std::rotate(at(from), at(from + 1), at(to + 1));
      }
      first = std::min(from, to);
    }
    const std::size_t kept_nodes = nodes_.size();
    std::optional<std::size_t> node = first;
    const Node before = nodes_[order.size()];
    for (std::size_t k = first; node && k < changed.size(); ++k) {
      node = after(*node, *changed[k]);
      if (node && !can_end_by(*node, before.end)) node.reset();
    }
    const bool accepted = node && complete(*node) &&
                          (nodes_[*node].end < before.end || (nodes_[*node].end == before.end && nodes_[*node].flow <= before.flow));
    if (accepted) {
      found = found || nodes_[*node].end < before.end || nodes_[*node].flow < before.flow;
      const std::size_t fresh = nodes_.size() - kept_nodes;
      for (std::size_t k = 0; k < fresh; ++k) {
        nodes_[first + 1 + k] = nodes_[kept_nodes + k];
        nodes_[first + 1 + k].parent = first + k;
        std::copy_n(states_.begin() + static_cast<std::ptrdiff_t>((kept_nodes + k) * n_robots), n_robots,
                    states_.begin() + static_cast<std::ptrdiff_t>((first + 1 + k) * n_robots));
      }
      order.swap(changed);
    }
    nodes_.resize(order.size() + 1);
    states_.resize(nodes_.size() * n_robots);
  }
  if (!found) return std::nullopt;
  return plan_to(order.size());
}

}  // namespace interlace::core
