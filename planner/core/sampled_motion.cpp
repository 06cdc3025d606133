#include "planner/core/sampled_motion.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>

namespace interlace::core {

namespace {

constexpr int kLeastDepth = 4;

std::uint64_t next_id() {
  static std::atomic<std::uint64_t> last{0};
  return ++last;
}

int depth_for(double duration, double resolution) {
  if (duration <= 0) return 0;
  return std::max(kLeastDepth, static_cast<int>(std::ceil(std::log2(duration / resolution) - 1e-9)));
}

}  // namespace

SampledMotion::SampledMotion(model::Motion motion, double resolution)
    : motion_(std::move(motion)),
      id_(next_id()),
      depth_(depth_for(motion_.duration(), resolution)),
      finest_(depth_ > 0 ? depth_ + kFiner : 0),
      shapes_(motion_.robot().model),
      pieces_((std::size_t{2} << finest_) - 1) {}

const SampledMotion::Piece& SampledMotion::piece(int level, std::size_t index) {
  auto& slot = pieces_[(std::size_t{1} << level) - 1 + index];
  if (!slot) {
    auto made = std::make_unique<Piece>();
    const double length = motion_.duration() / static_cast<double>(std::size_t{1} << level);
    made->t0 = length * static_cast<double>(index);
    made->t1 = made->t0 + length;
    made->centre = made->t0 + length / 2;
    std::vector<model::Capsule> capsules;
    model::place_capsules(robot().model, robot().X_WB, motion_.joints(made->centre), capsules);
    shapes_.place(capsules, made->bodies);
    motion_.displacement(made->t0, made->centre, made->t1, made->reach);
    made->largest_reach = made->reach.empty() ? 0 : *std::max_element(made->reach.begin(), made->reach.end());
    slot = std::move(made);
  }
  return *slot;
}

SampledMotion& SampledMotion::at_start() {
  if (motion_.duration() <= 0) return *this;
  if (!at_start_) at_start_ = std::make_unique<SampledMotion>(model::Motion::rest(robot(), motion_.from()), 1.0);
  return *at_start_;
}

SampledMotion& SampledMotion::at_end() {
  if (motion_.duration() <= 0) return *this;
  if (!at_end_) at_end_ = std::make_unique<SampledMotion>(model::Motion::rest(robot(), motion_.to()), 1.0);
  return *at_end_;
}

}  // namespace interlace::core
