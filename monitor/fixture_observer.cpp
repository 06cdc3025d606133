#include "monitor/fixture_observer.hpp"

#include <algorithm>
#include <limits>

#include "common/model/fixture_distance.hpp"

namespace interlace::monitor {

FixtureObserver::FixtureObserver(const model::Cell& cell) : cell_(cell) {
  for (model::RobotIndex robot = 0; robot < cell.robots.size(); ++robot) {
    for (std::size_t fixture = 0; fixture < cell.fixtures.size(); ++fixture) {
      FixtureClearance pair;
      pair.robot = robot;
      pair.fixture = fixture;
      pair.least = std::numeric_limits<double>::infinity();
      pairs_.push_back(pair);
    }
  }
  states_.resize(pairs_.size());
}

bool FixtureObserver::measure(model::RobotIndex robot, const model::RobotModel& model, const std::vector<model::Capsule>& bodies,
                              double travelled, double t, double step) {
  const std::size_t count = cell_.fixtures.size();
  bool any = false;
  for (std::size_t k = robot * count; k < (robot + 1) * count; ++k) {
    const bool contact = measure(pairs_[k], states_[k], model, bodies, travelled, t);
    if (contact) {
      pairs_[k].below_zero += step;
      if (!states_[k].touching) ++pairs_[k].contacts;
    }
    states_[k].touching = contact;
    any = any || contact;
  }
  return any;
}

void FixtureObserver::forget(model::RobotIndex robot) {
  const std::size_t count = cell_.fixtures.size();
  for (std::size_t k = robot * count; k < (robot + 1) * count; ++k) states_[k].current = false;
}

/// Whether the pair touches.
bool FixtureObserver::measure(FixtureClearance& pair, State& state, const model::RobotModel& model,
                              const std::vector<model::Capsule>& bodies, double travelled, double t) {
  const auto irrelevant = [&](double lower_bound) { return lower_bound > 0 && lower_bound > pair.least; };
  if (state.current) {
    const double moved = travelled - state.travelled;
    if (moved == 0) return state.touching;
    if (irrelevant(state.clearance - moved)) return false;
  }
  state.current = true;
  state.travelled = travelled;
  state.clearance = std::numeric_limits<double>::infinity();
  const model::Fixture& fixture = cell_.fixtures[pair.fixture];
  bool contact = false;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (model.capsules[i].link == 0) continue;
    const double apart = model::clearance_lower_bound(bodies[i], fixture);
    const double d = irrelevant(apart) ? apart : model::clearance(bodies[i], fixture);
    state.clearance = std::min(state.clearance, d);
    contact = contact || d <= 0;
    if (d >= pair.least) continue;
    pair.least = d;
    pair.at = t;
    pair.link = model.capsules[i].name;
  }
  return contact;
}

const FixtureClearance* FixtureObserver::least() const {
  const FixtureClearance* best = nullptr;
  for (const FixtureClearance& pair : pairs_) {
    if (!pair.link.empty() && (!best || pair.least < best->least)) best = &pair;
  }
  return best;
}

std::size_t FixtureObserver::contacts() const {
  std::size_t n = 0;
  for (const FixtureClearance& pair : pairs_) n += pair.contacts;
  return n;
}

std::vector<app::FixtureContact> FixtureObserver::report() const {
  std::vector<app::FixtureContact> contacts;
  for (const FixtureClearance& pair : pairs_) {
    if (pair.contacts == 0) continue;
    contacts.push_back({cell_.robots[pair.robot].name, pair.link, cell_.fixtures[pair.fixture].name, pair.contacts, pair.least, pair.at});
  }
  return contacts;
}

}  // namespace interlace::monitor
