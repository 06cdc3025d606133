#include "planner/core/sampled_motion.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>

namespace interlace::core {

namespace {

constexpr int kLeastDepth = 4;
constexpr std::size_t kPiecesPerBlock = 64;

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
      pieces_((std::size_t{2} << finest_) - 1) {
  for (const model::LinkCapsule& c : motion_.robot().model.capsules) half_lengths_.push_back((c.b - c.a).norm() / 2);
}

const SampledMotion::Piece& SampledMotion::make(int level, std::size_t index) {
  const std::size_t bodies = half_lengths_.size();
  if (blocks_.empty() || blocks_.back()->used == blocks_.back()->piece.size()) {
    blocks_.push_back(std::make_unique<Block>(depth_ > 0 ? kPiecesPerBlock : 1, bodies));
  }
  Block& block = *blocks_.back();
  Piece& made = block.piece[block.used];
  Body* body = block.body.data() + block.used * bodies;
  double* reach = block.reach.data() + block.used * bodies;
  ++block.used;

  const double length = motion_.duration() / static_cast<double>(std::size_t{1} << level);
  made.t0 = length * static_cast<double>(index);
  made.t1 = made.t0 + length;
  made.centre = made.t0 + length / 2;
  const model::LinkFrames X = motion_.frames(made.centre);
  motion_.displacement(made.t0, made.centre, made.t1, X, reach);
  for (std::size_t i = 0; i < bodies; ++i) {
    const model::LinkCapsule& c = robot().model.capsules[i];
    body[i] = Body{robot().X_WB * (X[c.link] * c.a), robot().X_WB * (X[c.link] * c.b), half_lengths_[i], c.radius};
    made.largest_reach = std::max(made.largest_reach, reach[i]);
  }
  made.bodies = {body, bodies};
  made.reach = {reach, bodies};
  pieces_[(std::size_t{1} << level) - 1 + index] = &made;
  return made;
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
