// What a look ahead sees: robots, the places they come to, and the motions between these.
#include "planner/core/outlook.hpp"

#include <algorithm>

#include "planner/core/admission.hpp"
#include "planner/core/escape_goal.hpp"
#include "planner/core/outlook_work.hpp"

namespace interlace::core {

using model::RobotIndex;

namespace {

constexpr std::uint64_t kLooksKept = 16;  // after which a place nobody came to is forgotten

}  // namespace

Outlook::Outlook(const model::Cell& cell, Neighbourhood neighbourhood)
    : cell_(cell), neighbourhood_(std::move(neighbourhood)), postures_(cell.robots.size()) {}

std::uint64_t Outlook::look(std::vector<OutlookRobot> robots, const Timing& timing, Duration lead, MapStore& maps) {
  robots_ = std::move(robots);
  timing_ = timing;
  lead_ = lead;
  maps_ = &maps;
  ++looks_;
  forget_the_gone();
  forbidden_now_.assign(robots_.size(), {});
  places_.clear();
  roots_.clear();
  next_beam_ = 0;
  settled_.reset();
  for (RobotIndex i = 0; i < robots_.size(); ++i) {
    const OutlookRobot& r = robots_[i];
    const model::MotionRequest* back = r.back ? &*r.back : nullptr;
    const SampledMotion& last = *r.seen.back().motion;
    roots_.push_back(place_at(i, last.motion().to(), *last.bodies().after, 0, back, false));
    if (r.seen.back().committed) roots_.back()->back = undoing(r.seen.back().motion->motion());
  }
  return looks_;
}

SampledMotionPtr Outlook::admitted(RobotIndex robot, const model::MotionBodies& bodies, const model::Joints& from,
                                   const model::MotionRequest& request) {
  map_work_ += kAdmitWork;
  auto motion = admit(cell_, robot, bodies, from, request);
  return motion ? *motion : nullptr;
}

/// Places that nobody came to for long, and what was known of motions that are gone. Wishes are of the last search: they point to places
/// that stay.
void Outlook::forget_the_gone() {
  for (auto& of_robot : postures_) {
    of_robot.remove_if([&](const Posture& p) { return p.looked + kLooksKept < looks_; });
  }
  last_row_ = nullptr;
  for (auto it = forbidden_.begin(); it != forbidden_.end();) it = it->second.motion.expired() ? forbidden_.erase(it) : std::next(it);
}

Outlook::Posture* Outlook::posture_at(RobotIndex robot, const model::Joints& q, const model::Robot& body) {
  auto& known = postures_[robot];
  const auto found = std::find_if(known.begin(), known.end(), [&](const Posture& p) { return p.body == &body && same_place(p.q, q); });
  if (found != known.end()) {
    found->looked = looks_;
    return &*found;
  }
  Posture& fresh = known.emplace_back();
  fresh.looked = looks_;
  fresh.q = q;
  fresh.body = &body;
  return &fresh;
}

/// Where `robot` stands at `q` with `done` of its commands done.
Outlook::Place* Outlook::place_at(RobotIndex robot, const model::Joints& q, const model::Robot& body, std::size_t done,
                                  const model::MotionRequest* back, bool aside) {
  const auto& queue = robots_[robot].queue;
  Place place;
  place.posture = posture_at(robot, q, body);
  place.aside = aside;
  place.done = done;
  if (back != nullptr) place.back = *back;
  if (done < queue.size()) {
    const WaitingMotion& command = queue[done];
    if (same_place(command.motion->motion().from(), q)) {
      place.next = command.motion;
    } else {
      auto [entry, fresh] = place.posture->from_here.try_emplace(command.motion->id());
      if (fresh) {
        entry->second = admitted(robot, command.motion->bodies(), q, command.request);
        if (entry->second && !same_place(entry->second->motion().to(), command.motion->motion().to())) entry->second = nullptr;
      }
      place.next = entry->second;
      place.stuck = !place.next;
    }
    place.rest = duration_of(place.stuck ? command.motion : place.next);
    for (std::size_t k = done + 1; k < queue.size(); ++k) place.rest += duration_of(queue[k].motion);
  }
  place.number = places_.size();
  places_.push_back(std::move(place));
  return &places_.back();
}

Outlook::Place* Outlook::after_command(RobotIndex robot, Place& place) {
  if (!place.after) {
    const model::MotionRequest back = undoing(place.next->motion());
    place.after = place_at(robot, place.next->motion().to(), *place.next->bodies().after, place.done + 1, &back, false);
  }
  return place.after;
}

Outlook::Place* Outlook::after_detour(RobotIndex robot, Place& place, const Detour& detour) {
  auto [entry, fresh] = place.detours.try_emplace(detour.motion.get());
  if (fresh) entry->second = place_at(robot, detour.motion->motion().to(), *place.posture->body, place.done, nullptr, true);
  return entry->second;
}

}  // namespace interlace::core
