#include "monitor/clearance_observer.hpp"

#include <algorithm>
#include <limits>

#include "common/model/segment_distance.hpp"

namespace interlace::monitor {

namespace {
constexpr double kRounding = 1e-9;  // [m] of distances and ways, on the safe side
}

ClearanceObserver::ClearanceObserver(const model::Cell& cell, double step, double patience)
    : held_(cell), step_(step), patience_(patience), tracks_(cell.robots.size()), fixtures_(cell) {
  for (model::RobotIndex a = 0; a < tracks_.size(); ++a) {
    for (model::RobotIndex b = a + 1; b < tracks_.size(); ++b) {
      PairClearance pair;
      pair.a = a;
      pair.b = b;
      pair.least = std::numeric_limits<double>::infinity();
      pairs_.push_back(pair);
    }
  }
  states_.resize(pairs_.size());
}

void ClearanceObserver::on_posture(model::RobotIndex robot, double t, const model::Joints& joints, model::ToolSet tools) {
  auto& samples = tracks_[robot].samples;
  if (!samples.empty() && t <= samples.back().t) return;
  samples.push_back({t, joints, tools});
  double newest = t;
  for (const Track& track : tracks_) {
    if (!track.samples.empty()) newest = std::max(newest, track.samples.back().t);
  }
  examine_up_to(newest);
}

void ClearanceObserver::examine_up_to(double newest) {
  // Examined is what all robots have reached that still talk.
  double reached = newest;
  std::size_t talking = 0;
  double begin = -std::numeric_limits<double>::infinity();
  for (const Track& track : tracks_) {
    if (track.samples.empty() || track.samples.back().t < newest - patience_) continue;
    ++talking;
    reached = std::min(reached, track.samples.back().t);
    begin = std::max(begin, track.samples.front().t);
  }
  if (talking < (fixtures_.pairs().empty() ? 2U : 1U)) return;
  if (!next_) next_ = begin;
  while (*next_ <= reached) {
    place_at(*next_);
    measure(*next_);
    ++steps_;
    *next_ += step_;
  }
}

void ClearanceObserver::place_at(double t) {
  for (model::RobotIndex i = 0; i < tracks_.size(); ++i) {
    Track& track = tracks_[i];
    while (track.samples.size() >= 2 && track.samples[1].t <= t) track.samples.pop_front();
    track.placed = false;
    if (track.samples.empty() || track.samples.front().t > t) continue;
    const Sample& before = track.samples.front();
    model::Joints q = before.q;
    model::ToolSet tools = before.tools;
    if (track.samples.size() >= 2) {
      const Sample& after = track.samples[1];
      if (t > before.t) tools = tools | after.tools;
      q += (t - before.t) / (after.t - before.t) * (after.q - before.q);
    } else if (t - before.t > patience_) {
      continue;
    }
    place(i, q, tools);
  }
}

void ClearanceObserver::place(model::RobotIndex robot, const model::Joints& q, model::ToolSet tools) {
  Track& track = tracks_[robot];
  track.placed = true;
  if (!track.body || track.body->tools != tools) {
    track.body = &held_.of(robot, tools);
    model::place_capsules(track.body->model, track.body->X_WB, q, track.bodies);
    for (std::size_t k = 0; k < pairs_.size(); ++k) {
      if (pairs_[k].a == robot || pairs_[k].b == robot) states_[k].current = false;
    }
    fixtures_.forget(robot);
  } else if (track.q != q) {
    const std::vector<model::Capsule> before = track.bodies;
    model::place_capsules(track.body->model, track.body->X_WB, q, track.bodies);
    double farthest = 0;  // no point of an axis moves farther than one of its ends
    for (std::size_t k = 0; k < before.size(); ++k) {
      farthest = std::max({farthest, (track.bodies[k].a - before[k].a).norm(), (track.bodies[k].b - before[k].b).norm()});
    }
    track.travelled += farthest + kRounding;
  }
  track.q = q;
}

void ClearanceObserver::measure(double t) {
  bool any_contact = false;
  for (std::size_t k = 0; k < pairs_.size(); ++k) {
    PairClearance& pair = pairs_[k];
    PairState& state = states_[k];
    if (!tracks_[pair.a].placed || !tracks_[pair.b].placed) continue;
    const bool contact = measure_pair(t, pair, state);
    if (contact) {
      pair.below_zero += step_;
      if (!state.touching) ++pair.contacts;
    }
    state.touching = contact;
    any_contact = any_contact || contact;
  }
  for (model::RobotIndex i = 0; i < tracks_.size(); ++i) {
    const Track& track = tracks_[i];
    if (track.placed && fixtures_.measure(i, track.body->model, track.bodies, track.travelled, t, step_)) any_contact = true;
  }
  if (any_contact) below_zero_ += step_;
}

/// Whether the pair touches. Measures only what could touch or come nearer than ever, given how far both moved since they were measured.
bool ClearanceObserver::measure_pair(double t, PairClearance& pair, PairState& state) {
  const Track& a = tracks_[pair.a];
  const Track& b = tracks_[pair.b];
  const auto irrelevant = [&](double lower_bound) { return lower_bound > 0 && lower_bound > pair.least; };
  if (state.current) {
    const double moved = a.travelled - state.travelled_a + b.travelled - state.travelled_b;
    if (moved == 0) return state.touching;
    if (irrelevant(state.clearance - moved)) return false;
  }
  state.seen = state.current = true;
  state.travelled_a = a.travelled;
  state.travelled_b = b.travelled;
  state.clearance = std::numeric_limits<double>::infinity();
  bool contact = false;
  for (std::size_t i = 0; i < a.bodies.size(); ++i) {
    for (std::size_t j = 0; j < b.bodies.size(); ++j) {
      const auto& x = a.bodies[i];
      const auto& y = b.bodies[j];
      // Spheres around both: half of the distance of the middles' doubles, less half of the lengths.
      const double apart = ((x.a + x.b - y.a - y.b).norm() - (x.b - x.a).norm() - (y.b - y.a).norm()) / 2 - x.radius - y.radius - kRounding;
      if (irrelevant(apart)) {
        state.clearance = std::min(state.clearance, apart);
        continue;
      }
      const double d = model::segment_distance(x.a, x.b, y.a, y.b) - x.radius - y.radius;
      state.clearance = std::min(state.clearance, d);
      contact = contact || d <= 0;
      if (d < pair.least) {
        pair.least = d;
        pair.at = t;
        pair.link_a = a.body->model.capsules[i].name;
        pair.link_b = b.body->model.capsules[j].name;
      }
    }
  }
  return contact;
}

std::optional<PairClearance> ClearanceObserver::least() const {
  const PairClearance* best = nullptr;
  for (std::size_t k = 0; k < pairs_.size(); ++k) {
    if (states_[k].seen && (!best || pairs_[k].least < best->least)) best = &pairs_[k];
  }
  return best ? std::optional{*best} : std::nullopt;
}

std::optional<double> ClearanceObserver::least_clearance() const {
  std::optional<double> least;
  if (const auto pair = this->least()) least = pair->least;
  if (const FixtureClearance* pair = fixtures_.least(); pair && (!least || pair->least < *least)) least = pair->least;
  return least;
}

std::size_t ClearanceObserver::contacts() const {
  std::size_t n = fixtures_.contacts();
  for (const PairClearance& pair : pairs_) n += pair.contacts;
  return n;
}

}  // namespace interlace::monitor
