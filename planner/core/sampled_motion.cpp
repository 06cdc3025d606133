#include "planner/core/sampled_motion.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

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

/// X · p column by column, which compilers turn into less than half the instructions of Eigen's product with a block of a 4 × 4 matrix.
Vector3 placed(const model::Pose& X, const Vector3& p) {
  const auto& m = X.matrix();
  const auto column = [&m](int i) { return m.col(i).head<3>(); };
  return column(0) * p.x() + column(1) * p.y() + column(2) * p.z() + column(3);
}

}  // namespace

SampledMotion::SampledMotion(model::Motion motion, double resolution, const std::optional<model::MotionBodies>& bodies)
    : motion_(motion.duration() <= 0 && bodies ? motion.with_bodies_of(*bodies->all) : std::move(motion)),
      bodies_(bodies.value_or(model::MotionBodies::unchanged(motion_.robot()))),
      id_(next_id()),
      depth_(depth_for(motion_.duration(), resolution)),
      finest_(depth_ > 0 ? depth_ + kFiner : 0),
      pieces_((std::size_t{2} << finest_) - 1) {
  for (const model::LinkCapsule& c : motion_.robot().model.capsules) half_lengths_.push_back((c.b - c.a).norm() / 2);
  ends_.resize(2 * half_lengths_.size());
}

SampledMotion::Room& SampledMotion::room_for(int level, std::size_t index) {
  Room*& known = pieces_[(std::size_t{1} << level) - 1 + index];
  if (known != nullptr) return *known;
  const std::size_t bodies = half_lengths_.size();
  if (blocks_.empty() || blocks_.back().pieces.size() == blocks_.back().pieces.capacity()) {
    const std::size_t room = depth_ > 0 ? kPiecesPerBlock : 1;
    Block& next = blocks_.emplace_back();
    next.pieces.reserve(room);
    next.bodies.resize(room * bodies);
    next.reaches.resize(room * bodies);
  }
  Block& block = blocks_.back();
  const std::size_t first = block.pieces.size() * bodies;
  Room& room = block.pieces.emplace_back();
  room.bodies = block.bodies.data() + first;
  room.reach = block.reaches.data() + first;
  Piece& piece = room.piece;
  const double length = motion_.duration() / static_cast<double>(std::size_t{1} << level);
  piece.t0 = length * static_cast<double>(index);
  piece.t1 = piece.t0 + length;
  piece.centre = piece.t0 + length / 2;
  piece.bodies = {room.bodies, bodies};
  piece.reach = {room.reach, bodies};
  known = &room;
  return room;
}

const SampledMotion::Piece& SampledMotion::make(int level, std::size_t index, model::CapsuleSet wanted) {
  Room& room = room_for(level, index);
  Piece& piece = room.piece;
  const model::CapsuleSet missing = wanted & ~piece.made;
  model::LinkFrames X;
  motion_.frames(piece.centre, X);
  const model::Pose& X_WB = robot().X_WB;
  const auto& capsules = robot().model.capsules;
  for (std::size_t i = 0; i < capsules.size(); ++i) {
    if ((missing & model::only_capsule(i)) == 0) continue;
    const model::LinkCapsule& c = capsules[i];
    ends_[2 * i] = placed(X[c.link], c.a);
    ends_[2 * i + 1] = placed(X[c.link], c.b);
    room.bodies[i] = Body{placed(X_WB, ends_[2 * i]), placed(X_WB, ends_[2 * i + 1]), half_lengths_[i], c.radius};
  }
  motion_.displacement(piece.t0, piece.centre, piece.t1, {X, ends_.data(), missing}, room.reach);
  piece.made |= missing;
  return piece;
}

SampledMotion& SampledMotion::at_start() {
  if (motion_.duration() <= 0) return *this;
  if (!at_start_) at_start_ = std::make_unique<SampledMotion>(model::Motion::rest(*bodies_.at_start, motion_.from()), 1.0);
  return *at_start_;
}

SampledMotion& SampledMotion::at_end() {
  return motion_.duration() > 0 ? *standing_at_end() : *this;
}

const std::shared_ptr<SampledMotion>& SampledMotion::standing_at_end() {
  if (!at_end_) at_end_ = std::make_shared<SampledMotion>(model::Motion::rest(*bodies_.at_end, motion_.to()), 1.0);
  return at_end_;
}

SampledMotion& SampledMotion::part(double t0, double t1) {
  constexpr double kOpen = std::numeric_limits<double>::infinity();
  return t0 == -kOpen ? at_start() : t1 == kOpen ? at_end() : *this;
}

}  // namespace interlace::core
