#include "planner/core/map_store.hpp"

#include <algorithm>

namespace interlace::core {

namespace {

KeptMap shifts_of(SampledMotion& commanded, SampledMotion& moving, double margin) {
  KeptMap kept;
  kept.map = build_shift_map(commanded, moving, margin);
  kept.map.blocked.shrink_to_fit();
  const double commanded_stretch = commanded.robot().controller.speed_error, moving_stretch = moving.robot().controller.speed_error;
  kept.forbidden = forbidden_shifts(kept.map, commanded_stretch, moving_stretch);
  kept.passing = forbidden_while_moving(kept.map, commanded_stretch, moving_stretch);
  kept.at_end = times_at_end(kept.map, commanded_stretch);
  const auto& blocked = kept.map.blocked;
  const auto before = std::find_if(blocked.begin(), blocked.end(), [](const BlockedCell& c) { return c.t0 == -kNever; });
  if (before != blocked.end()) kept.blocked_before_start = static_cast<std::size_t>(before - blocked.begin());
  return kept;
}

std::size_t bytes_of(const TimingMap& map) {
  return sizeof(TimingMap) + map.blocked.capacity() * sizeof(BlockedCell);
}

std::size_t bytes_of(const KeptMap& kept) {
  return sizeof(KeptMap) - sizeof(TimingMap) + bytes_of(kept.map) +
         (kept.forbidden.capacity() + kept.passing.capacity() + kept.at_end.capacity()) * sizeof(ForbiddenShift);
}

}  // namespace

MapStore::Kept& MapStore::entry(const SampledMotionPtr& commanded, const SampledMotionPtr& moving) {
  const auto key = std::make_pair(commanded->id(), moving->id());
  ++uses_;
  auto found = maps_.find(key);
  if (found == maps_.end()) {
    if (maps_.size() >= forget_at_) forget_the_gone();
    if (full()) make_room();
    found = maps_.emplace(key, Kept{commanded, moving, nullptr, nullptr, 0, uses_}).first;
  }
  found->second.last_use = uses_;
  return found->second;
}

template <typename Build>
void MapStore::build(Kept& kept, const SampledMotionPtr& commanded, const SampledMotionPtr& moving, Build&& one) {
  if (on_build_) on_build_(commanded, moving);
  const double before = stopwatch_ ? stopwatch_() : 0;
  const std::size_t bytes = one(*commanded, *moving);
  if (stopwatch_) build_times_.push_back(stopwatch_() - before);
  ++built_;
  kept.bytes += bytes;
  bytes_ += bytes;
}

const std::shared_ptr<const KeptMap>& MapStore::share(const SampledMotionPtr& commanded, const SampledMotionPtr& moving) {
  Kept& kept = entry(commanded, moving);
  if (!kept.map) {
    build(kept, commanded, moving, [&](SampledMotion& a, SampledMotion& b) {
      kept.map = std::make_shared<const KeptMap>(shifts_of(a, b, margin_));
      return bytes_of(*kept.map);
    });
  }
  return kept.map;
}

const TimesInTheWay& MapStore::in_the_way(const SampledMotionPtr& commanded, const SampledMotionPtr& moving) {
  Kept& kept = entry(commanded, moving);
  if (!kept.in_way) {
    build(kept, commanded, moving, [&](SampledMotion& a, SampledMotion& b) {
      kept.in_way = std::make_shared<const TimesInTheWay>(times_in_the_way(a, b, margin_));
      return sizeof(TimesInTheWay) + kept.in_way->times.capacity() * sizeof(kept.in_way->times.front());
    });
  }
  return *kept.in_way;
}

/// Those that nobody can ask for any more.
void MapStore::forget_the_gone() {
  for (auto it = maps_.begin(); it != maps_.end();) {
    it = it->second.commanded.expired() || it->second.moving.expired() ? drop(it) : std::next(it);
  }
  forget_at_ = std::max(kForgetAt, 2 * maps_.size());
}

/// If it is not enough to forget those of motions that are gone, the half that was not used for longest goes.
void MapStore::make_room() {
  forget_the_gone();
  if (maps_.size() < limits_.maps / 2 && bytes_ < limits_.bytes / 2) return;
  std::vector<std::uint64_t> uses;
  for (const auto& [key, kept] : maps_) uses.push_back(kept.last_use);
  const auto middle = uses.begin() + static_cast<std::ptrdiff_t>(uses.size() / 2);
  std::nth_element(uses.begin(), middle, uses.end());
  const std::uint64_t oldest_kept = *middle;
  for (auto it = maps_.begin(); it != maps_.end();) {
    const bool goes = it->second.last_use <= oldest_kept;
    evicted_ += goes ? 1 : 0;
    it = goes ? drop(it) : std::next(it);
  }
}

MapStore::Maps::iterator MapStore::drop(Maps::iterator kept) {
  bytes_ -= kept->second.bytes;
  return maps_.erase(kept);
}

MapStatistics MapStore::statistics() const {
  MapStatistics s;
  s.built = built_;
  s.reused = static_cast<std::size_t>(uses_) - built_;
  s.evicted = evicted_;
  s.kept = maps_.size();
  s.bytes = bytes_;
  return s;
}

}  // namespace interlace::core
