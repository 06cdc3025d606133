// The search: beams over the order in which robots start.
#include "planner/core/outlook.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "planner/core/outlook_work.hpp"

namespace interlace::core {

using model::RobotIndex;

namespace {

constexpr double kSameTime = 1e-6;                  // [s]
constexpr std::uint64_t kMix = 0x9E3779B97F4A7C15;  // 2^64 divided by the golden ratio
constexpr std::size_t kSameKept = 8;                // nodes of a beam in which all robots are at the same places

}  // namespace

bool Outlook::complete(std::size_t node) const {
  for (RobotIndex i = 0; i < robots_.size(); ++i) {
    if (state(node, i).place->next || state(node, i).place->stuck) return false;
  }
  return true;
}

/// `motion` must stay where it is.
std::size_t Outlook::add(std::size_t parent, const Action& action, const SampledMotionPtr& motion, Place* to) {
  const std::size_t n = robots_.size();
  const std::size_t index = nodes_.size();
  work_ += kNodeWork;
  Node node;
  node.parent = parent;
  node.last = std::max(nodes_[parent].last, action.start);
  const Instant end = action.start + robots_[action.robot].tolerance + duration_of(motion);
  node.end = std::max(nodes_[parent].end, end);
  node.flow = nodes_[parent].flow;
  node.detours = nodes_[parent].detours;
  if (action.detour != nullptr) {
    ++node.detours;
  } else {
    node.flow += end - timing_.earliest;
  }
  states_.resize((index + 1) * n);
  std::copy_n(states_.begin() + static_cast<std::ptrdiff_t>(parent * n), n, states_.begin() + static_cast<std::ptrdiff_t>(index * n));
  RobotState& s = states_[index * n + action.robot];
  s.before = s.moving;
  s.before_start = s.start;
  s.moving = &motion;
  s.start = action.start;
  s.free = end + lead_;
  s.place = to;
  node.action = action;
  nodes_.push_back(node);
  return index;
}

/// Everything that can start next: commands, and where somebody is stuck, detours of those in his way.
void Outlook::expand(std::size_t parent, std::size_t most_detours, std::vector<std::size_t>& commands, std::vector<std::size_t>& detours) {
  const auto n = static_cast<RobotIndex>(robots_.size());
  enum class Will : std::uint8_t { idle, go, wait };
  std::vector<Will> will(n, Will::idle);
  for (RobotIndex i = 0; i < n; ++i) {
    const RobotState s = state(parent, i);
    if (!s.place->next) continue;
    const auto start = start_of(parent, i, s.place->next);
    will[i] = start ? Will::go : Will::wait;
    if (!start) continue;
    commands.push_back(add(parent, {i, nullptr, i, *start}, s.place->next, after_command(i, *s.place)));
  }
  if (nodes_[parent].detours >= most_detours) return;
  // Who waits for those that will go is not stuck.
  const auto blocked_by = [&](RobotIndex i, RobotIndex j) { return blocks_for_good(parent, j, i, state(parent, i).place->next); };
  for (bool changed = true; changed;) {
    changed = false;
    for (RobotIndex i = 0; i < n; ++i) {
      if (will[i] != Will::wait) continue;
      const auto& around = neighbourhood_.of(i);
      const bool served = std::all_of(around.begin(), around.end(), [&](RobotIndex j) { return will[j] == Will::go || !blocked_by(i, j); });
      if (!served) continue;
      will[i] = Will::go;
      changed = true;
    }
  }
  for (RobotIndex i = 0; i < n; ++i) {
    if (will[i] != Will::wait) continue;
    const SampledMotionPtr& waiting = state(parent, i).place->next;
    for (const RobotIndex j : neighbourhood_.of(i)) {
      if (will[j] == Will::go || !blocked_by(i, j)) continue;
      const RobotState s = state(parent, j);
      if (s.place->aside || robots_[j].seen.back().lost) continue;
      for (const Detour& d : detours_of(j, *s.place, waiting)) {
        if (work_ + map_work_ > budget_) return;
        const auto start = earliest(parent, j, d.motion, std::max(nodes_[parent].last, s.free));
        if (!start) continue;
        const Forbidden& after = forbidden(i, waiting, j, d.motion);
        if (!after.empty() && after.back().until == model::kForever) continue;
        Place* to = after_detour(j, *s.place, d);
        if (!to->stuck) detours.push_back(add(parent, {j, &d, i, *start}, d.motion, to));
      }
    }
  }
}

OutlookPlan Outlook::plan_to(std::size_t node) const {
  OutlookPlan plan;
  plan.end = nodes_[node].end;
  plan.flow = nodes_[node].flow;
  for (std::size_t k = node; k != 0; k = nodes_[k].parent) {
    const Action& a = nodes_[k].action;
    PlannedStart s;
    s.robot = a.robot;
    s.serves = a.serves;
    s.start = a.start;
    if (a.detour != nullptr) s.detour = *a.detour;
    if (a.slower != nullptr) s.slower = *a.slower;
    plan.starts.push_back(std::move(s));
  }
  std::reverse(plan.starts.begin(), plan.starts.end());
  return plan;
}

Outlook::Beam Outlook::beam(std::size_t index) {
  static constexpr std::array<Beam, kBeams> kAll{{{8, 0.3, 0},
                                                  {64, 0.3, 0},
                                                  {16, 0.3, 12},
                                                  {64, 1.0, 0},
                                                  {64, 0.3, 3},
                                                  {512, 0.3, 0},
                                                  {64, 1.0, 12},
                                                  {512, 1.0, 0},
                                                  {256, 0.3, 4},
                                                  {2048, 0.3, 0},
                                                  {512, 0.3, 12},
                                                  {2048, 0.3, 4}}};
  return kAll.at(index);
}

/// Whether all robots, which are at the same places at both nodes, are free no sooner at `node` than at `other`.
bool Outlook::no_sooner(std::size_t node, std::size_t other) const {
  if (nodes_[node].last < nodes_[other].last) return false;
  for (RobotIndex i = 0; i < robots_.size(); ++i) {
    if (state(node, i).free < state(other, i).free) return false;
  }
  return true;
}

/// The present as the first node; false when there is no saying from where a robot goes on.
bool Outlook::begin() {
  nodes_.assign(1, {});
  nodes_[0].last = timing_.earliest;
  nodes_[0].end = timing_.earliest;
  states_.assign(robots_.size(), {});
  for (RobotIndex i = 0; i < robots_.size(); ++i) {
    if (roots_[i]->stuck) return false;
    states_[i].place = roots_[i];
    states_[i].free = robots_[i].free;
    if (robots_[i].seen.back().committed) nodes_[0].end = std::max(nodes_[0].end, robots_[i].free - lead_);
  }
  return true;
}

/// The next node, in which `p`, which must stay where it is, starts as early as it can; empty when it cannot.
std::optional<std::size_t> Outlook::after(std::size_t node, const PlannedStart& p) {
  const RobotState s = state(node, p.robot);
  // A way back that was planned as a detour waits in the queue once its robot has gone.
  const Detour* detour = p.detour && !(s.place->next && same_way(*s.place->next, *p.detour->motion)) ? &*p.detour : nullptr;
  const SampledMotionPtr* motion = detour != nullptr ? kept(*s.place->posture, detour->motion)
                                   : p.slower        ? kept(*s.place->posture, p.slower->motion)
                                                     : &s.place->next;
  if (motion == nullptr || !*motion) return std::nullopt;
  const auto start = start_of(node, p.robot, *motion);
  if (!start) return std::nullopt;
  Place* to = detour != nullptr ? after_detour(p.robot, *s.place, *detour) : after_command(p.robot, *s.place);
  return add(node, {p.robot, detour, p.serves, *start, p.slower ? &*p.slower : nullptr}, *motion, to);
}

std::optional<OutlookPlan> Outlook::follow(const OutlookPlan& plan) {
  if (!begin()) return std::nullopt;
  budget_ = std::numeric_limits<std::size_t>::max();
  find_out_everything();
  std::size_t node = 0;
  for (const PlannedStart& p : plan.starts) {
    const auto next = after(node, p);
    if (!next) return std::nullopt;
    node = *next;
  }
  std::vector<std::size_t> commands, detours;
  while (!complete(node)) {  // what has come since goes as early as it can
    commands.clear();
    detours.clear();
    expand(node, 1, commands, detours);
    if (commands.empty()) commands.swap(detours);
    if (commands.empty()) return std::nullopt;
    node = *std::min_element(commands.begin(), commands.end(), [&](auto a, auto b) { return nodes_[a].last < nodes_[b].last; });
  }
  return plan_to(node);
}

/// A motion where it stays, to be pointed at; null when it does not start here.
const SampledMotionPtr* Outlook::kept(Posture& posture, const SampledMotionPtr& motion) {
  if (!same_place(posture.q, motion->motion().from())) return nullptr;
  const auto found = std::find(posture.followed.begin(), posture.followed.end(), motion);
  if (found != posture.followed.end()) return &*found;
  posture.followed.push_back(motion);
  return &posture.followed.back();
}

std::optional<OutlookPlan> Outlook::search(const std::optional<Instant>& no_later, const OutlookPlan* best, const Budget& budget,
                                           MapStore& maps) {
  maps_ = &maps;
  work_ = 0;
  grant(budget.grants);
  budget_ = budget.work;
  map_work_ = 0;
  map_budget_ = budget.maps;
  std::optional<OutlookPlan> found;
  look_at_pairs();
  for (; !exhausted(); ++next_beam_) {
    const Beam next = beam(next_beam_);
    if (settled_ && next.detours <= *settled_) continue;
    auto plan = run(next, no_later, found ? &*found : best);
    if (work_ + map_work_ > budget_) break;
    if (plan) found = std::move(plan);
  }
  return found;
}

std::optional<OutlookPlan> Outlook::run(const Beam& beam, std::optional<Instant> no_later, const OutlookPlan* best) {
  const std::size_t n = robots_.size();
  if (!begin()) return std::nullopt;
  if (best != nullptr) no_later = no_later ? std::min(*no_later, best->end) : best->end;
  std::vector<std::size_t> layer{0}, next, commands, detours;
  std::optional<std::size_t> best_node;
  bool cut = false;
  const std::size_t wishes = wishes_.size();
  while (!layer.empty() && !best_node) {
    next.clear();
    for (std::size_t k = 0; k < layer.size(); ++k) {
      if (work_ + map_work_ > budget_) return std::nullopt;
      commands.clear();
      detours.clear();
      expand(layer[k], beam.detours, commands, detours);
      next.insert(next.end(), commands.begin(), commands.end());
      layer.insert(layer.end(), detours.begin(), detours.end());
    }
    const auto judge = [&](std::size_t k) {
      double most = 0;
      for (RobotIndex i = 0; i < n; ++i) {
        const RobotState& s = state(k, i);
        most = std::max(most, model::to_seconds(s.free - lead_ + s.place->rest));
      }
      nodes_[k].score = outlook_of(k, beam.mean);
      return !no_later || most <= model::to_seconds(*no_later) + kSameTime;
    };
    next.erase(std::remove_if(next.begin(), next.end(), [&](std::size_t k) { return !judge(k); }), next.end());
    std::stable_sort(next.begin(), next.end(), [&](std::size_t a, std::size_t b) { return nodes_[a].score < nodes_[b].score; });
    layer.clear();
    std::unordered_map<std::uint64_t, std::vector<std::size_t>> same;
    for (const std::size_t k : next) {
      if (complete(k)) {
        const bool better = !best_node || nodes_[k].end < nodes_[*best_node].end ||
                            (nodes_[k].end == nodes_[*best_node].end && nodes_[k].flow < nodes_[*best_node].flow);
        if (better) best_node = k;
        continue;
      }
      if (layer.size() >= beam.width) {
        cut = true;
        continue;
      }
      std::uint64_t places = 0;  // a number for where all robots are; two that are the same by chance cost a node
      for (RobotIndex i = 0; i < n; ++i) places = (places ^ state(k, i).place->number) * kMix + i;
      auto& there = same[places];
      if (std::any_of(there.begin(), there.end(), [&](std::size_t other) { return no_sooner(k, other); })) continue;
      if (there.size() < kSameKept) {
        there.push_back(k);
        layer.push_back(k);
      } else {
        cut = true;
      }
    }
  }
  if (!cut && wishes_.size() == wishes) settled_ = beam.detours;
  if (!best_node) return std::nullopt;
  OutlookPlan plan = plan_to(*best_node);
  if (best != nullptr && !plan.better_than(*best)) return std::nullopt;
  return plan;
}

}  // namespace interlace::core
