#include "monitor/clearance_observer.hpp"

#include <algorithm>
#include <limits>

#include "common/model/segment_distance.hpp"

namespace interlace::monitor {

ClearanceObserver::ClearanceObserver(const model::Cell& cell, double step, double patience)
    : cell_(cell), step_(step), patience_(patience), tracks_(cell.robots.size()) {
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

void ClearanceObserver::on_posture(model::RobotIndex robot, double t, const model::Joints& joints) {
  auto& samples = tracks_[robot].samples;
  if (!samples.empty() && t <= samples.back().t) return;
  samples.push_back({t, joints});
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
  if (talking < 2) return;
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
    if (track.samples.size() >= 2) {
      const Sample& after = track.samples[1];
      q += (t - before.t) / (after.t - before.t) * (after.q - before.q);
    } else if (t - before.t > patience_) {
      continue;
    }
    model::place_capsules(cell_.robots[i].model, cell_.robots[i].X_WB, q, track.bodies);
    track.placed = true;
  }
}

void ClearanceObserver::measure(double t) {
  bool any_contact = false;
  for (std::size_t k = 0; k < pairs_.size(); ++k) {
    PairClearance& pair = pairs_[k];
    const Track& a = tracks_[pair.a];
    const Track& b = tracks_[pair.b];
    if (!a.placed || !b.placed) continue;
    states_[k].seen = true;
    bool contact = false;
    for (std::size_t i = 0; i < a.bodies.size(); ++i) {
      for (std::size_t j = 0; j < b.bodies.size(); ++j) {
        const auto& x = a.bodies[i];
        const auto& y = b.bodies[j];
        const double d = model::segment_distance(x.a, x.b, y.a, y.b) - x.radius - y.radius;
        contact = contact || d <= 0;
        if (d < pair.least) {
          pair.least = d;
          pair.at = t;
          pair.link_a = cell_.robots[pair.a].model.capsules[i].name;
          pair.link_b = cell_.robots[pair.b].model.capsules[j].name;
        }
      }
    }
    if (contact) {
      pair.below_zero += step_;
      if (!states_[k].touching) ++pair.contacts;
    }
    states_[k].touching = contact;
    any_contact = any_contact || contact;
  }
  if (any_contact) below_zero_ += step_;
}

std::optional<PairClearance> ClearanceObserver::least() const {
  const PairClearance* best = nullptr;
  for (std::size_t k = 0; k < pairs_.size(); ++k) {
    if (states_[k].seen && (!best || pairs_[k].least < best->least)) best = &pairs_[k];
  }
  return best ? std::optional{*best} : std::nullopt;
}

std::size_t ClearanceObserver::contacts() const {
  std::size_t n = 0;
  for (const PairClearance& pair : pairs_) n += pair.contacts;
  return n;
}

}  // namespace interlace::monitor
