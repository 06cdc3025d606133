#include "common/app/config/clearance_check.hpp"

#include <fmt/format.h>

#include "common/model/bodies.hpp"
#include "common/model/fixture_distance.hpp"
#include "common/model/segment_distance.hpp"

namespace interlace::app {

namespace {

using model::Capsule;

double clearance(const Capsule& a, const Capsule& b) {
  return model::segment_distance(a.a, a.b, b.a, b.b) - a.radius - b.radius;
}

/// One robot standing somewhere.
struct Standing {
  model::Robot robot;
  const Field* field;
  std::vector<Capsule> capsules;

  [[nodiscard]] std::string link(std::size_t capsule) const { return robot.name.str() + "." + robot.model.capsules[capsule].name; }
};

Standing stand(const model::Robot& robot, const model::Joints& q, const Field& field) {
  Standing standing{robot, &field, {}};
  model::place_capsules(robot.model, robot.X_WB, q, standing.capsules);
  return standing;
}

/// These tell whether there was nothing to complain about.
bool check_self(const Standing& s, const Units& units) {
  for (const auto& [i, j] : s.robot.model.self_pairs) {
    const double d = clearance(s.capsules[i], s.capsules[j]);
    if (d > 0) continue;
    s.field->refuse(fmt::format("collides with itself: clearance of {} and {} would be {}, expected > 0", s.link(i), s.link(j),
                                show(d, coordinate(units))));
    return false;
  }
  return true;
}

bool check_pair(const Standing& a, const Standing& b, double margin, const Units& units) {
  std::size_t worst_i = 0;
  std::size_t worst_j = 0;
  double least = margin + 1;
  for (std::size_t i = 0; i < a.capsules.size(); ++i) {
    for (std::size_t j = 0; j < b.capsules.size(); ++j) {
      const double d = clearance(a.capsules[i], b.capsules[j]);
      if (d >= least) continue;
      least = d;
      worst_i = i;
      worst_j = j;
    }
  }
  if (least > margin) return true;
  b.field->refuse(fmt::format("in collision with {}: clearance of {} and {} would be {}, expected > {}", a.field->key(), b.link(worst_j),
                              a.link(worst_i), show(least, coordinate(units)), show(margin, coordinate(units))));
  return false;
}

bool check_fixture(const Standing& s, const model::Fixture& fixture, double margin, const Units& units) {
  for (std::size_t i = 0; i < s.capsules.size(); ++i) {
    if (s.robot.model.capsules[i].link == 0) continue;  // it stands on some of them
    const double d = model::clearance(s.capsules[i], fixture);
    if (d > margin) continue;
    s.field->refuse(fmt::format("in collision with fixture {}: clearance of {} would be {}, expected > {}", fixture.name, s.link(i),
                                show(d, coordinate(units)), show(margin, coordinate(units))));
    return false;
  }
  return true;
}

bool check_all(const std::vector<Standing>& standing, const std::vector<model::Fixture>& fixtures, double margin, const Units& units) {
  bool clear = true;
  for (const auto& s : standing) {
    clear = check_self(s, units) && clear;
    for (const auto& fixture : fixtures) clear = check_fixture(s, fixture, margin + s.robot.controller.path_error, units) && clear;
  }
  for (std::size_t i = 0; i < standing.size(); ++i) {
    for (std::size_t j = i + 1; j < standing.size(); ++j) {
      const double both = standing[i].robot.controller.path_error + standing[j].robot.controller.path_error;
      clear = check_pair(standing[i], standing[j], margin + both, units) && clear;
    }
  }
  return clear;
}

}  // namespace

void check_clearances(const std::vector<PlacedRobot>& robots, const std::vector<model::Tool>& tools,
                      const std::vector<model::Fixture>& fixtures, double margin, const Units& units) {
  model::Cell known;  // the tools alone
  known.tools = tools;
  std::vector<Standing> starts;
  std::vector<Standing> homes;
  for (const auto& placed : robots) {
    const model::Robot body = model::with_tools(placed.robot, tools, known.set_of(placed.robot.holds));
    starts.push_back(stand(body, body.start, placed.start));
    homes.push_back(stand(body, body.home, placed.home));
  }
  // Homes are starts by default: do not complain twice.
  if (check_all(starts, fixtures, margin, units)) check_all(homes, fixtures, margin, units);
}

}  // namespace interlace::app
