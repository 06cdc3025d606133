#include "monitor/collision_picture.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <tuple>
#include <utility>

#include "monitor/numbers.hpp"

namespace interlace::monitor {

namespace {

constexpr double kForever = std::numeric_limits<double>::infinity();
constexpr int kLinePoints = 48;

using Interval = std::pair<double, double>;

std::vector<std::string> names(const model::RobotModel& model) {
  std::vector<std::string> links;
  for (const auto& capsule : model.capsules) links.push_back(capsule.name);
  return links;
}

/// Areas of the same bodies that lie side by side as one, so that the frame stays short.
std::vector<PictureArea> joined(std::vector<PictureArea> areas) {
  const auto row = [](const PictureArea& a) { return std::tie(a.own, a.other, a.length0, a.length1); };
  std::sort(areas.begin(), areas.end(),
            [&](const auto& a, const auto& b) { return std::tuple_cat(row(a), std::tie(a.t0)) < std::tuple_cat(row(b), std::tie(b.t0)); });
  std::vector<PictureArea> result;
  for (const PictureArea& a : areas) {
    if (!result.empty() && row(result.back()) == row(a) && a.t0 <= result.back().t1) {
      result.back().t1 = std::max(result.back().t1, a.t1);
      result.back().clearance = std::min(result.back().clearance, a.clearance);
    } else {
      result.push_back(a);
    }
  }
  return result;
}

/// What is left from `from` on.
std::vector<Interval> free_starts(std::vector<Interval> forbidden, double from) {
  std::sort(forbidden.begin(), forbidden.end());
  std::vector<Interval> windows;
  for (const auto& [first, last] : forbidden) {
    if (first > from) windows.emplace_back(from, first);
    from = std::max(from, last);
  }
  if (from < kForever) windows.emplace_back(from, kForever);
  return windows;
}

}  // namespace

namespace {

/// The areas of `neighbours`, at most `room` of them, and the starts they forbid.
std::vector<CollisionPicture::Neighbour> draw(const PictureSubject& subject, const std::vector<PictureNeighbour>& neighbours, double margin,
                                              std::size_t& room, std::vector<Interval>& forbidden) {
  std::vector<CollisionPicture::Neighbour> all;
  for (const PictureNeighbour& neighbour : neighbours) {
    auto& drawn = all.emplace_back();
    drawn.robot = neighbour.robot;
    drawn.links = names(neighbour.parts.front().motion->robot().model);
    for (std::size_t k = 0; k < neighbour.parts.size(); ++k) {
      const NeighbourPart& part = neighbour.parts[k];
      const double from = k == 0 ? -kForever : part.start;
      const double until = k + 1 < neighbour.parts.size() ? neighbour.parts[k + 1].start : kForever;
      const core::TimingMap map = core::build_timing_map(*subject.motion, *part.motion, margin);
      const auto lengths = core::collision_map(map, subject.motion->motion());
      for (std::size_t i = 0; i < map.blocked.size(); ++i) {
        const core::BlockedCell& cell = map.blocked[i];
        const double t0 = std::max(cell.t0 + part.start, from), t1 = std::min(cell.t1 + part.start, until);
        if (t0 >= t1) continue;
        forbidden.emplace_back(t0 - cell.tau1, t1 - cell.tau0);
        drawn.areas.push_back({t0, t1, lengths[i].length0, lengths[i].length1, cell.own_body, cell.other_body, cell.clearance});
      }
    }
    drawn.areas = joined(std::move(drawn.areas));
    if (drawn.areas.size() > room) drawn.areas.resize(room);
    room -= drawn.areas.size();
  }
  return all;
}

nlohmann::json areas_json(const std::vector<PictureArea>& areas) {
  nlohmann::json json = nlohmann::json::array();
  for (const PictureArea& a : areas) {
    json.push_back({seconds(a.t0), seconds(a.t1), metres(a.length0), metres(a.length1), a.own, a.other, metres(a.clearance)});
  }
  return json;
}

}  // namespace

CollisionPicture draw(const PictureSubject& subject, double margin) {
  CollisionPicture picture;
  picture.links = names(subject.motion->robot().model);
  std::size_t room = kMaxAreas;
  std::vector<Interval> forbidden;
  if (!subject.before.empty()) {
    picture.before = draw(subject, subject.before, margin, room, forbidden);
    for (const auto& [from, until] : free_starts(std::exchange(forbidden, {}), subject.ready)) {
      if (from < subject.earliest) picture.windows.emplace_back(from, std::min(until, subject.earliest));
    }
  }
  picture.neighbours = draw(subject, subject.neighbours, margin, room, forbidden);
  for (const auto& window : free_starts(std::move(forbidden), subject.earliest)) {
    if (!picture.windows.empty() && picture.windows.back().second >= window.first) {
      picture.windows.back().second = window.second;
    } else {
      picture.windows.push_back(window);
    }
  }
  picture.complete = room > 0;
  return picture;
}

nlohmann::json to_json(const PictureSubject& subject, const CollisionPicture& picture) {
  const model::Motion& motion = subject.motion->motion();
  nlohmann::json line = nlohmann::json::array(), neighbours = nlohmann::json::array(), windows = nlohmann::json::array();
  for (int i = 0; i <= kLinePoints; ++i) {
    const double t = motion.duration() * i / kLinePoints;
    line.push_back({seconds(t), metres(motion.length(t))});
  }
  for (std::size_t n = 0; n < picture.neighbours.size(); ++n) {
    nlohmann::json parts = nlohmann::json::array();
    for (const NeighbourPart& part : subject.neighbours[n].parts) {
      if (part.command.empty()) continue;
      parts.push_back(
          {{"command", part.command}, {"start", seconds(part.start)}, {"end", seconds(part.start + part.motion->motion().duration())}});
    }
    neighbours.push_back({{"robot", picture.neighbours[n].robot},
                          {"links", picture.neighbours[n].links},
                          {"parts", std::move(parts)},
                          {"areas", areas_json(picture.neighbours[n].areas)}});
  }
  nlohmann::json before = nlohmann::json::array();
  for (const auto& neighbour : picture.before) {
    before.push_back({{"robot", neighbour.robot}, {"links", neighbour.links}, {"areas", areas_json(neighbour.areas)}});
  }
  for (const auto& [from, until] : picture.windows) windows.push_back({seconds(from), seconds(until)});
  return {{"command", subject.command},
          {"robot", subject.robot},
          {"ready", seconds(subject.ready)},
          {"judged", seconds(subject.earliest)},
          {"start", seconds(subject.start)},
          {"duration", seconds(motion.duration())},
          {"length_m", metres(motion.length(motion.duration()))},
          {"line", std::move(line)},
          {"links", picture.links},
          {"neighbours", std::move(neighbours)},
          {"before", std::move(before)},
          {"windows", std::move(windows)},
          {"complete", picture.complete}};
}

}  // namespace interlace::monitor
