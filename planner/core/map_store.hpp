#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "planner/core/start_windows.hpp"

namespace interlace::core {

/// What a pair of motions forbids, as the search for start windows asks for it again and again, and the cells that show why.
struct KeptMap {
  TimingMap map;                                    ///< a shift map
  std::vector<ForbiddenShift> forbidden;            ///< united, widened by both robots' speed errors
  std::optional<std::size_t> blocked_before_start;  ///< a blocked cell in which the moving robot has not started yet
  std::vector<ForbiddenShift> passing;              ///< as `forbidden`, of the cells in which the moving robot moves
  std::vector<ForbiddenShift> at_end;               ///< times of the commanded robot at which it would meet the other at its end, united
};

/// What a store has done so far and holds now.
struct MapStatistics {
  std::size_t built = 0, reused = 0, evicted = 0;
  std::size_t kept = 0, bytes = 0;  ///< of the maps themselves
};

/// How much a store may hold.
struct MapLimits {
  std::size_t maps = 16384;
  std::size_t bytes = 64U << 20U;
};

/// Timing maps of pairs of motions, built when first asked for and kept while both motions live, within limits: beyond them the half that
/// was not used for longest goes. Copies share the maps. Not thread-safe.
class MapStore {
 public:
  /// `stopwatch` tells elapsed seconds for the statistics, and nothing depends on it; may be empty.
  MapStore(double margin, std::function<double()> stopwatch, MapLimits limits = {})
      : margin_(margin), stopwatch_(std::move(stopwatch)), limits_(limits) {}

  /// The map of `commanded` against `moving`; it and times in the way are valid until the next call of any of these.
  const KeptMap& get(const SampledMotionPtr& commanded, const SampledMotionPtr& moving) { return *share(commanded, moving); }

  /// The same for as long as it is wanted.
  const std::shared_ptr<const KeptMap>& share(const SampledMotionPtr& commanded, const SampledMotionPtr& moving);

  /// When `moving` is in the way of all that `commanded` sweeps.
  const TimesInTheWay& in_the_way(const SampledMotionPtr& commanded, const SampledMotionPtr& moving);

  [[nodiscard]] bool holds(const SampledMotionPtr& commanded, const SampledMotionPtr& moving) const {
    const auto found = maps_.find({commanded->id(), moving->id()});
    return found != maps_.end() && found->second.map;
  }

  /// Whether a map can be built without another one having to go.
  [[nodiscard]] bool has_room() const { return !full(); }

  [[nodiscard]] MapStatistics statistics() const;

  /// Seconds each map took to build since the last call; empty without a stopwatch.
  [[nodiscard]] std::vector<double> take_build_times() { return std::exchange(build_times_, {}); }

  /// Calls `listener` for each map that is built from now on, before it is: for judges and benchmarks.
  using Listener = std::function<void(const SampledMotionPtr& commanded, const SampledMotionPtr& moving)>;
  void on_build(Listener listener) { on_build_ = std::move(listener); }

 private:
  struct Kept {
    std::weak_ptr<SampledMotion> commanded, moving;
    std::shared_ptr<const KeptMap> map;           // null: not asked for yet
    std::shared_ptr<const TimesInTheWay> in_way;  // null: not asked for yet
    std::size_t bytes = 0;
    std::uint64_t last_use = 0;
  };
  static constexpr std::size_t kForgetAt = 256;  // least number of maps among which those of motions that are gone are looked for
  using Maps = std::map<std::pair<std::uint64_t, std::uint64_t>, Kept>;

  [[nodiscard]] bool full() const { return maps_.size() >= limits_.maps || bytes_ >= limits_.bytes; }
  Kept& entry(const SampledMotionPtr& commanded, const SampledMotionPtr& moving);
  template <typename Build>
  void build(Kept& kept, const SampledMotionPtr& commanded, const SampledMotionPtr& moving, Build&& one);
  void forget_the_gone();
  void make_room();
  Maps::iterator drop(Maps::iterator kept);

  double margin_;
  std::function<double()> stopwatch_;
  MapLimits limits_;
  Listener on_build_;
  Maps maps_;
  std::size_t forget_at_ = kForgetAt;  // so many maps
  std::size_t bytes_ = 0;
  std::uint64_t uses_ = 0;
  std::size_t built_ = 0, evicted_ = 0;
  std::vector<double> build_times_;
};

}  // namespace interlace::core
