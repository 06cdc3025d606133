// What a search had no budget to find out, for the next one: found out in between, and known to it by its grants alone.
#include <algorithm>
#include <limits>

#include "planner/core/outlook.hpp"
#include "planner/core/outlook_work.hpp"

namespace interlace::core {

namespace {

constexpr std::size_t kMostWishes = 4000;  // of one search
constexpr std::size_t kDetourGrants = 10;  // that detours cost: they take as long to find as so many pairs

}  // namespace

void Outlook::find_out_everything() {
  map_budget_ = std::numeric_limits<std::size_t>::max();
}

void Outlook::wish(Wish wish) {
  if (wishes_.size() < kMostWishes) wishes_.push_back(std::move(wish));
}

void Outlook::fulfil(Wish& wish) {
  const std::size_t before = map_work_;
  if (auto* w = std::get_if<PairWish>(&wish)) {
    if (!w->pair) w->pair = make_pair(w->robot, w->motion, w->other, w->moving);
  } else {
    auto& d = std::get<DetourWish>(wish);
    if (!d.detours) {
      // Not at the posture itself, which would keep the ways: what a search knows may not depend on how much was found out in time.
      Posture there;
      there.q = d.posture->q;
      there.body = d.posture->body;
      d.detours = find_detours(d.robot, there, d.back, d.served);
    }
  }
  map_work_ = before;
}

bool Outlook::prepare(MapStore& maps) {
  if (next_wish_ >= wishes_.size()) return false;
  maps_ = &maps;
  fulfil(wishes_[next_wish_++]);
  return true;
}

/// Makes known what the last search wished to know, the first things first, and forgets the rest: who still wants it wishes again.
void Outlook::grant(std::size_t grants) {
  for (Wish& wish : wishes_) {
    const bool is_pair = std::holds_alternative<PairWish>(wish);
    const std::size_t cost = is_pair ? 1 : kDetourGrants;
    if (cost > grants) break;
    grants -= cost;
    fulfil(wish);
    work_ += kGrantWork;
    if (is_pair) {
      auto& w = std::get<PairWish>(wish);
      row_of(w.motion).with.try_emplace(w.moving->id(), std::move(*w.pair));
    } else {
      auto& d = std::get<DetourWish>(wish);
      d.posture->detours.try_emplace(d.served->id(), std::move(*d.detours));
    }
  }
  wishes_.clear();
  wished_.clear();
  next_wish_ = 0;
}

}  // namespace interlace::core
