#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "common/model/bodies.hpp"
#include "common/model/motion.hpp"
#include "planner/core/clearance.hpp"

namespace interlace::core {

/// Consecutive values that lie elsewhere for as long as they are looked at.
template <typename T>
class View {
 public:
  View() = default;
  View(const T* first, std::size_t size) : first_(first), size_(size) {}
  [[nodiscard]] const T& operator[](std::size_t i) const { return first_[i]; }
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] const T* begin() const { return first_; }
  [[nodiscard]] const T* end() const { return first_ + size_; }

 private:
  const T* first_ = nullptr;
  std::size_t size_ = 0;
};

/// A motion as the collision maps see it: its duration halved again and again, each piece with the bodies at its centre and how far they
/// may be from there anywhere in the piece. Pieces, and of each the bodies that matter, are computed when first asked for and kept.
/// Not thread-safe.
class SampledMotion {
 public:
  struct Piece {
    double t0 = 0, centre = 0, t1 = 0;  ///< local time [s]
    View<Body> bodies;                  ///< at the centre, in the order of the model's capsules
    View<double> reach;                 ///< displacement bound of each body within the piece [m]
    model::CapsuleSet made = 0;         ///< of which bodies these are known
  };

  /// Halvings beyond depth() that a map may ask for: next to a collision, where a smaller piece can still be proven free.
  static constexpr int kFiner = 2;

  /// Pieces of the level depth() are no longer than `resolution` [s], and short motions still have 16 of them.
  /// `bodies`: what the robot holds before and after where that is not what it holds on the way. A motion that takes no time has all of it.
  SampledMotion(model::Motion motion, double resolution, const std::optional<model::MotionBodies>& bodies = std::nullopt);

  SampledMotion(const SampledMotion&) = delete;
  SampledMotion& operator=(const SampledMotion&) = delete;

  [[nodiscard]] const model::Motion& motion() const { return motion_; }
  [[nodiscard]] const model::Robot& robot() const { return motion_.robot(); }  ///< with what it holds on the way
  [[nodiscard]] const model::MotionBodies& bodies() const { return bodies_; }
  [[nodiscard]] std::uint64_t id() const { return id_; }  ///< unique in this process: the key of kept maps
  [[nodiscard]] int depth() const { return depth_; }      ///< halvings down to the resolution; 0 for standing
  [[nodiscard]] int finest() const { return finest_; }    ///< deepest level there is

  /// Piece `index` of the 2^level pieces of `level`, with at least the bodies of `wanted`.
  [[nodiscard]] const Piece& piece(int level, std::size_t index, model::CapsuleSet wanted = model::kAllCapsules) {
    const Room* kept = pieces_[(std::size_t{1} << level) - 1 + index];
    return kept != nullptr && (wanted & ~kept->piece.made) == 0 ? kept->piece : make(level, index, wanted);
  }

  /// Standing at the motion's first and last posture, with all that the robot may hold there.
  [[nodiscard]] SampledMotion& at_start();
  [[nodiscard]] SampledMotion& at_end();

  /// Standing where the motion, which takes time, ends: for whoever stands there afterwards, who then finds the maps that know it.
  [[nodiscard]] const std::shared_ptr<SampledMotion>& standing_at_end();

  /// What the piece [t0, t1] [s] of a map is about: the motion, or standing before or after it, where the piece has no end that way.
  [[nodiscard]] SampledMotion& part(double t0, double t1);

 private:
  /// Room for pieces that come one by one and stay where they are: never filled beyond what was reserved.
  struct Room {
    Piece piece;
    Body* bodies = nullptr;
    double* reach = nullptr;
  };
  struct Block {
    std::vector<Room> pieces;
    std::vector<Body> bodies;
    std::vector<double> reaches;
  };

  Room& room_for(int level, std::size_t index);
  const Piece& make(int level, std::size_t index, model::CapsuleSet wanted);

  model::Motion motion_;
  model::MotionBodies bodies_;
  std::uint64_t id_;
  int depth_ = 0;
  int finest_ = 0;
  std::vector<double> half_lengths_;  // of the capsules' axes [m]
  std::vector<Vector3> ends_;         // of the capsules' axes in the piece being made, in the base frame [m]
  std::vector<Room*> pieces_;         // binary tree in heap order; null: not asked for yet
  std::vector<Block> blocks_;
  std::unique_ptr<SampledMotion> at_start_;
  std::shared_ptr<SampledMotion> at_end_;
};

using SampledMotionPtr = std::shared_ptr<SampledMotion>;

}  // namespace interlace::core
