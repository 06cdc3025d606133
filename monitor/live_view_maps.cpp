#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "monitor/live_view.hpp"
#include "monitor/numbers.hpp"

/// The collision maps of LiveView.
namespace interlace::monitor {

namespace {

constexpr double kSameMoment = 0.2;  // a command is judged so soon after its robot is free [s]

Frame map_frame(double t, nlohmann::json content) {
  content["type"] = "map";
  content["t"] = seconds(t);
  return {FrameKind::event, std::make_shared<const std::string>(content.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace))};
}

}  // namespace

/// What `robot` does from `from` on, as far as it is known now.
PictureNeighbour LiveView::neighbour_of(model::RobotIndex robot, double from) {
  PictureNeighbour neighbour;
  neighbour.robot = cell_.cell.robots[robot].name.str();
  const KnownMotion* before = nullptr;  // the last one that was over by then: where it stands
  for (const KnownMotion& known : motions_.of(robot)) {
    if (known.end() < from) {
      if (before == nullptr || known.end() > before->end()) before = &known;
      continue;
    }
    neighbour.parts.push_back({known.id.str(), known.motion, known.start()});
  }
  std::stable_sort(neighbour.parts.begin(), neighbour.parts.end(), [](const auto& a, const auto& b) { return a.start < b.start; });
  if (!neighbour.parts.empty()) return neighbour;
  if (before != nullptr) {
    neighbour.parts.push_back({"", motions_.rest(robot, before->motion->motion().to(), before->motion->bodies().after->tools), from});
  } else if (seen_[robot].posture) {
    neighbour.parts.push_back({"", motions_.rest(robot, seen_[robot].posture->joints, seen_[robot].held), from});
  }
  return neighbour;
}

std::vector<PictureNeighbour> LiveView::neighbours_of(model::RobotIndex robot, double from) {
  std::vector<PictureNeighbour> neighbours;
  for (const auto& [a, b] : pairs_) {
    if (a != robot && b != robot) continue;
    PictureNeighbour neighbour = neighbour_of(a == robot ? b : a, from);
    if (!neighbour.parts.empty()) neighbours.push_back(std::move(neighbour));
  }
  return neighbours;
}

void LiveView::note_judgements() {
  for (const model::CommandId& id : std::exchange(judged_, {})) {
    const CommandRecord* record = commands_.find(id);
    const auto robot = record != nullptr ? cell_.cell.find(record->status.robot) : std::nullopt;
    if (!robot) continue;
    Judgements& judgements = judgements_[id];
    const double ready = record->start ? *record->start - record->status.delay : record->waiting_since.value_or(now_);
    judgements.last = Judgement{now_, neighbours_of(*robot, std::min(ready, now_))};
    if (!judgements.first) judgements.first = judgements.last;
  }
  for (auto it = judgements_.begin(); it != judgements_.end();)
    it = commands_.find(it->first) != nullptr ? std::next(it) : judgements_.erase(it);
}

model::Result<PictureSubject, std::string> LiveView::subject_of(const model::CommandId& command) {
  const auto why = [](const char* text) { return model::unexpected(std::string{text}); };
  const CommandRecord* record = commands_.find(command);
  if (record == nullptr) return why("nothing is known of this command");
  const model::CommandStatus& status = record->status;
  const auto robot = cell_.cell.find(status.robot);
  if (!robot) return why("the cell has no such robot");
  PictureSubject subject;
  subject.command = command.str();
  subject.robot = status.robot.str();
  subject.start = record->start;
  if (const KnownMotion* known = motions_.find(*robot, command)) {
    subject.motion = known->motion;
    subject.start = known->start();
  } else if (status.state == model::CommandState::waiting && commands_.request(command) != nullptr && seen_[*robot].posture) {
    subject.motion = motions_.plan(*robot, seen_[*robot].posture->joints, seen_[*robot].held, *commands_.request(command));
    subject.start.reset();
  } else if (status.state == model::CommandState::queued) {
    return why("it is not its turn yet: its map is made once its robot is free");
  } else if (status.state == model::CommandState::rejected) {
    return why("it was rejected and never had a map");
  }
  if (!subject.motion) return why("its motion is not known here any more");
  subject.ready = subject.start ? *subject.start - status.delay : record->waiting_since.value_or(now_);
  subject.earliest = subject.ready;
  const auto judged = judgements_.find(command);
  if (judged == judgements_.end() || !judged->second.last) {
    subject.neighbours = neighbours_of(*robot, subject.ready);
    return subject;
  }
  const auto& [first, last] = judged->second;
  subject.neighbours = last->neighbours;
  if (!subject.start || last->at <= subject.ready + kSameMoment) return subject;
  subject.earliest = last->at;
  subject.before = first->neighbours;
  return subject;
}

Frame LiveView::map(const model::CommandId& command) {
  const auto subject = subject_of(command);
  if (!subject) return map_frame(now_, {{"command", command.str()}, {"why_not", subject.error()}});
  return map_frame(now_, to_json(*subject, draw(*subject, cell_.cell.planning.margin)));
}

}  // namespace interlace::monitor
