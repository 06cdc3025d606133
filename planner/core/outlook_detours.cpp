// Ways out for robots that stand where others have to pass.
#include "planner/core/outlook.hpp"

#include <algorithm>
#include <array>

#include "planner/core/escape_goal.hpp"
#include "planner/core/outlook_work.hpp"

namespace interlace::core {

using model::EscapeWay;
using model::RobotIndex;

namespace {

constexpr double kDetourBeyond = 1e-3;  // [m] a detour goes on after the last place that is in the way
constexpr std::size_t kDetours = 3;     // of one robot for one command

}  // namespace

/// Back where it came from, and home.
const std::vector<Outlook::Way>& Outlook::ways_known(RobotIndex robot, Posture& posture, const std::optional<model::MotionRequest>& back) {
  auto& ways = posture.known;
  if (ways) return *ways;
  ways.emplace();
  const auto body = model::MotionBodies::unchanged(*posture.body);
  const auto add = [&](EscapeWay way, const model::MotionRequest& request) {
    auto motion = admitted(robot, body, posture.q, request);
    if (motion && motion->motion().duration() > 0) ways->push_back({way, request, std::move(motion)});
  };
  const model::Robot& r = cell_.robots[robot];
  if (back) add(EscapeWay::retreat, *back);
  model::MotionRequest home;
  home.target = model::LinearTarget{r.X_WB * model::tcp_pose(r.model, r.home)};
  add(EscapeWay::home, home);
  if (r.model.joints.velocity && r.model.joints.acceleration) {
    home.target = model::JointTarget{r.home};
    add(EscapeWay::home, home);
  }
  return *ways;
}

/// To the border of the workspace: it takes much longer to find out how far that is.
const std::vector<Outlook::Way>& Outlook::ways_sought(RobotIndex robot, Posture& posture) {
  auto& ways = posture.sought;
  if (ways) return *ways;
  ways.emplace();
  const std::array<std::pair<EscapeWay, Vector3>, 6> directions{{{EscapeWay::plus_x, Vector3::UnitX()},
                                                                 {EscapeWay::minus_x, -Vector3::UnitX()},
                                                                 {EscapeWay::plus_y, Vector3::UnitY()},
                                                                 {EscapeWay::minus_y, -Vector3::UnitY()},
                                                                 {EscapeWay::plus_z, Vector3::UnitZ()},
                                                                 {EscapeWay::minus_z, -Vector3::UnitZ()}}};
  for (const auto& [way, unit] : directions) {
    map_work_ += kReachWork;
    auto full = to_reachable_goal(cell_, robot, *posture.body, posture.q, unit);
    if (full.motion) ways->push_back({way, full.request, std::move(full.motion)});
  }
  return *ways;
}

/// Ways for `robot` from where it stands to the first place clear of all that `served` sweeps, the shortest first.
const std::vector<Detour>& Outlook::detours_of(RobotIndex robot, Place& place, const SampledMotionPtr& served) {
  auto& known = place.posture->detours;
  if (const auto found = known.find(served->id()); found != known.end()) return found->second;
  if (may_find_out()) return known.emplace(served->id(), find_detours(robot, *place.posture, place.back, served)).first->second;
  static const std::vector<Detour> none;
  if (wished_.insert({served->id(), place.posture}).second) wish(DetourWish{robot, place.posture, place.back, served, std::nullopt});
  return none;
}

std::vector<Detour> Outlook::find_detours(RobotIndex robot, Posture& posture, const std::optional<model::MotionRequest>& back,
                                          const SampledMotionPtr& served) {
  std::vector<Detour> detours;
  const auto add = [&](const std::vector<Way>& ways) {
    for (const Way& way : ways) {
      const model::Motion& full = way.full->motion();
      const auto clear = first_clear(served, way.full);
      if (!clear) continue;
      const double whole = full.length(full.duration());
      const double length = full.length(*clear) + kDetourBeyond;
      Detour d{way.way, way.request, way.full};
      if (full.is_linear() && length < whole - kDetourBeyond) {
        d.request = shortened(full, length);
        d.motion = admitted(robot, model::MotionBodies::unchanged(*posture.body), posture.q, d.request);
      }
      if (d.motion) detours.push_back(std::move(d));
    }
  };
  add(ways_known(robot, posture, back));
  if (detours.empty()) add(ways_sought(robot, posture));
  std::stable_sort(detours.begin(), detours.end(),
                   [](const Detour& a, const Detour& b) { return duration_of(a.motion) < duration_of(b.motion); });
  if (detours.size() > kDetours) detours.resize(kDetours);
  return detours;
}

}  // namespace interlace::core
