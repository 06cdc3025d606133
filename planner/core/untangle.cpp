#include "planner/core/untangle.hpp"

#include <algorithm>
#include <queue>
#include <set>

namespace interlace::core {

using model::EscapeWay;
using model::RobotIndex;

namespace {

constexpr int kAssessments = 3000;  // of single steps before the search gives up: bounds the time of a decision
constexpr double kSameStop = 1e-9;  // [rad]

/// A way from one place of a robot to another.
struct Way {
  UntangleStep step;
  SampledMotionPtr motion;
  std::size_t to = 0;
};

/// Somewhere a robot can stand.
struct Place {
  model::Joints q;
  SampledMotionPtr standing;
  std::size_t came_back = 0;  // steps along the trail that led here
  bool on_trail = false;
  bool home = false;
  std::optional<std::vector<Way>> ways;    // from here
  std::optional<SampledMotionPtr> served;  // of the commanded robot: its command from here; null: impossible
};

/// Where every robot stands: an index of a place for each.
using State = std::vector<std::size_t>;

struct Node {
  State state;
  std::size_t parent = 0;
  UntangleStep step;
  int steps = 0;
};

class Untangling {
 public:
  Untangling(const model::Cell& cell, const Neighbourhood& neighbourhood, const std::vector<EscapeView>& views,
             const std::vector<RobotIndex>& around, const Candidate& served, const model::MotionRequest& request, const Strategy& strategy,
             const Timing& timing, MapStore& maps)
      : cell_(cell),
        neighbourhood_(neighbourhood),
        views_(views),
        around_(around),
        served_(served),
        request_(request),
        strategy_(strategy),
        timing_(timing),
        maps_(maps),
        places_(views.size()) {
    for (const RobotIndex i : around_) (void)place(i, views_[i].motion()->motion().to(), true, 0);
  }

  /// Plain places only, or the six directions of an escape too.
  std::optional<std::vector<UntangleStep>> search(bool six_directions) {
    six_directions_ = six_directions;
    budget_ = kAssessments;
    for (auto& of_robot : places_) {
      for (Place& p : of_robot) p.ways.reset();
    }
    nodes_ = {{State(views_.size(), 0), 0, {}, 0}};
    std::set<State> known{nodes_.front().state};
    // Lowest first; ties in the order they were found.
    std::priority_queue<std::pair<int, std::size_t>, std::vector<std::pair<int, std::size_t>>, std::greater<>> open;
    open.emplace(0, 0);
    while (!open.empty() && budget_ > 0) {
      const std::size_t parent = open.top().second;
      open.pop();
      for (const RobotIndex i : around_) {
        if (!views_[i].immovable.empty() || views_[i].committed()) continue;
        const std::size_t from = nodes_[parent].state[i];
        for (const Way& way : ways_from(i, from)) {
          State next = nodes_[parent].state;
          next[i] = way.to;
          if (known.count(next) > 0 || !has_start({i, way.motion, views_[i].tolerance}, nodes_[parent].state)) continue;
          known.insert(next);
          nodes_.push_back({std::move(next), parent, way.step, nodes_[parent].steps + 1});
          if (can_serve(nodes_.back().state)) return steps_to(nodes_.size() - 1);
          open.emplace(cost(nodes_.back()), nodes_.size() - 1);
        }
      }
    }
    return std::nullopt;
  }

 private:
  std::size_t place(RobotIndex robot, const model::Joints& q, bool on_trail, std::size_t came_back) {
    std::vector<Place>& known = places_[robot];
    for (std::size_t k = 0; k < known.size(); ++k) {
      if ((known[k].q - q).cwiseAbs().maxCoeff() <= kSameStop) return k;
    }
    Place p;
    p.q = q;
    const model::Robot& r = views_[robot].body();
    p.standing =
        known.empty() ? views_[robot].motion() : std::make_shared<SampledMotion>(model::Motion::rest(r, q), cell_.planning.resolution);
    p.on_trail = on_trail;
    p.came_back = came_back;
    const model::Pose X_WHome = r.X_WB * model::tcp_pose(r.model, r.home);
    p.home = (r.X_WB * model::tcp_pose(r.model, q)).isApprox(X_WHome, 1e-6);
    known.push_back(std::move(p));
    return known.size() - 1;
  }

  const std::vector<Way>& ways_from(RobotIndex robot, std::size_t at) {
    if (places_[robot][at].ways) return *places_[robot][at].ways;
    std::vector<Way> ways;
    const Place here = places_[robot][at];  // a copy: places are added below
    const EscapeView& view = views_[robot];
    const auto add = [&](EscapeWay way, const model::MotionRequest& request, SampledMotionPtr motion, bool on_trail, std::size_t back) {
      if (motion->motion().duration() <= 0) return;
      const std::size_t to = place(robot, motion->motion().to(), on_trail, back);
      if (to != at) ways.push_back({{robot, way, request}, std::move(motion), to});
    };
    const auto add_if_admitted = [&](EscapeWay way, const model::MotionRequest& request, bool on_trail, std::size_t back) {
      if (auto motion = admit(cell_, robot, view.body(), here.q, request)) add(way, request, std::move(*motion), on_trail, back);
    };
    if (!here.home) {
      for (const model::MotionRequest& home : view.home) add_if_admitted(EscapeWay::home, home, false, 0);
    }
    if (here.on_trail && here.came_back < view.trail.size()) {
      add_if_admitted(EscapeWay::retreat, view.trail[here.came_back], true, here.came_back + 1);
    }
    if (six_directions_ && at == 0) {
      const Vector3 tcp = (cell_.robots[robot].X_WB * model::tcp_pose(cell_.robots[robot].model, here.q)).translation();
      for (const EscapeDirection& d : escape_directions(swept_cuboid(served_.motion->motion()), tcp)) {
        RequestedMotion out = to_reachable_goal(cell_, robot, view.body(), here.q, d.unit);
        if (!out.motion) continue;
        add_if_admitted(d.way, shortened(out.motion->motion(), out.motion->motion().length(out.motion->motion().duration()) / 2), false, 0);
        add(d.way, out.request, std::move(out.motion), false, 0);
      }
    }
    return places_[robot][at].ways.emplace(std::move(ways));
  }

  /// Whether `candidate` could start with all others standing where `state` has them.
  bool has_start(const Candidate& candidate, const State& state) {
    --budget_;
    std::vector<Neighbour> neighbours;
    for (const RobotIndex other : neighbourhood_.of(candidate.robot)) {
      if (places_[other].empty() || state[other] == 0) {
        neighbours.insert(neighbours.end(), views_[other].seen.begin(), views_[other].seen.end());
      } else {
        Neighbour n = views_[other].seen.back();
        n.motion = places_[other][state[other]].standing;
        neighbours.push_back(std::move(n));
      }
    }
    return strategy_.assess(candidate, neighbours, timing_, maps_, Evidence::no).start.has_value();
  }

  bool can_serve(const State& state) {
    Place& from = places_[served_.robot][state[served_.robot]];
    if (!from.served) {
      if (state[served_.robot] == 0) {
        from.served = served_.motion;
      } else {
        auto motion = admit(cell_, served_.robot, served_.motion->bodies(), from.q, request_);
        from.served = motion ? *motion : nullptr;
      }
    }
    return *from.served && has_start({served_.robot, *from.served, served_.tolerance}, state);
  }

  /// Few steps, and few robots away from home, where by the promise of a well-formed program they are in nobody's way.
  [[nodiscard]] int cost(const Node& node) const {
    int away = 0;
    for (const RobotIndex i : around_) {
      if (i != served_.robot && !places_[i][node.state[i]].home) ++away;
    }
    return node.steps + 2 * away;
  }

  [[nodiscard]] std::vector<UntangleStep> steps_to(std::size_t node) const {
    std::vector<UntangleStep> steps;
    for (; node != 0; node = nodes_[node].parent) steps.push_back(nodes_[node].step);
    std::reverse(steps.begin(), steps.end());
    return steps;
  }

  const model::Cell& cell_;
  const Neighbourhood& neighbourhood_;
  const std::vector<EscapeView>& views_;
  const std::vector<RobotIndex>& around_;
  const Candidate& served_;
  const model::MotionRequest& request_;
  const Strategy& strategy_;
  const Timing& timing_;
  MapStore& maps_;
  std::vector<std::vector<Place>> places_;  // of each robot; the first is where it stands now
  std::vector<Node> nodes_;
  bool six_directions_ = false;
  int budget_ = 0;
};

}  // namespace

std::optional<std::vector<UntangleStep>> untangle(const model::Cell& cell, const Neighbourhood& neighbourhood,
                                                  const std::vector<EscapeView>& views, const std::vector<RobotIndex>& around,
                                                  const Candidate& served, const model::MotionRequest& request, const Strategy& strategy,
                                                  const Timing& timing, MapStore& maps) {
  Untangling search{cell, neighbourhood, views, around, served, request, strategy, timing, maps};
  auto steps = search.search(false);
  return steps ? steps : search.search(true);
}

}  // namespace interlace::core
