#include "planner/core/timing_map.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <vector>

#include "common/model/segment_distance.hpp"
#include "planner/core/shift_cover.hpp"
#include "planner/core/start_windows.hpp"
#include "tests/support/motions.hpp"

/// The collision timing map against a dense grid, a tenth of its resolution apart: no collision missed, little blocked for nothing.
namespace interlace::test {
namespace {

using core::BlockedCell;
using core::kNever;
using core::SampledMotion;
using core::TimingMap;
using model::Capsule;

constexpr std::size_t kPairs = 1000;
constexpr double kResolution = 0.01;        // [s]
constexpr double kStep = kResolution / 10;  // [s] of the dense grid
constexpr double kLongest = 2.5;            // [s] of a motion
constexpr double kTouch = 0.0;              // [m] clearance at or below which bodies collide

/// Postures of one motion at equal steps, with one before its start and one after its end, as binary blocks: each with its middle sample
/// and how far the samples of the block are from that. Exact for the samples, and independent of the certified bounds.
class DenseMotion {
 public:
  explicit DenseMotion(const model::Motion& motion, double phase) {
    times_.push_back(-kStep);
    for (double t = phase * kStep; t < motion.duration(); t += kStep) times_.push_back(t);
    times_.push_back(motion.duration() + kStep);
    const auto& robot = motion.robot();
    bodies_.resize(times_.size());
    for (std::size_t i = 0; i < times_.size(); ++i) model::place_capsules(robot.model, robot.X_WB, motion.joints(times_[i]), bodies_[i]);
  }

  [[nodiscard]] std::size_t size() const { return times_.size(); }
  [[nodiscard]] double time(std::size_t i) const { return times_[i]; }
  [[nodiscard]] const std::vector<Capsule>& bodies(std::size_t i) const { return bodies_[i]; }

  /// How far each body is, at any sample of [first, last), from where it is at the middle one [m]. Kept for blocks that come again.
  [[nodiscard]] const std::vector<double>& reach(std::size_t first, std::size_t last) {
    auto& kept = reach_[std::make_pair(first, last)];
    if (!kept.empty()) return kept;
    const auto& middle = bodies_[first + (last - first) / 2];
    kept.assign(middle.size(), 0.0);
    for (std::size_t i = first; i < last; ++i) {
      for (std::size_t k = 0; k < middle.size(); ++k) {
        kept[k] = std::max({kept[k], (bodies_[i][k].a - middle[k].a).norm(), (bodies_[i][k].b - middle[k].b).norm()});
      }
    }
    return kept;
  }

  /// Indices of the samples with times in [t0, t1].
  [[nodiscard]] std::pair<std::size_t, std::size_t> inside(double t0, double t1) const {
    const auto first = std::lower_bound(times_.begin(), times_.end(), t0);
    const auto last = std::upper_bound(first, times_.end(), t1);
    return {static_cast<std::size_t>(first - times_.begin()), static_cast<std::size_t>(last - times_.begin())};
  }

 private:
  std::vector<double> times_;
  std::vector<std::vector<Capsule>> bodies_;
  std::map<std::pair<std::size_t, std::size_t>, std::vector<double>> reach_;
};

double clearance_of(const Capsule& a, const Capsule& b) {
  return model::segment_distance(a.a, a.b, b.a, b.b) - a.radius - b.radius;
}

/// One bit for each point of the dense grid: rows are samples of the commanded robot, columns of the moving one.
class Grid {
 public:
  Grid(const DenseMotion& own, const DenseMotion& other) : rows_(own.size()), columns_(other.size()), bits_(rows_ * columns_) {}
  void mark(std::size_t i0, std::size_t i1, std::size_t j0, std::size_t j1) {
    for (std::size_t i = i0; i < i1; ++i) {
      std::fill(bits_.begin() + static_cast<long>(i * columns_ + j0), bits_.begin() + static_cast<long>(i * columns_ + j1),
                std::uint8_t{1});
    }
  }
  [[nodiscard]] bool at(std::size_t i, std::size_t j) const { return bits_[i * columns_ + j] != 0; }
  [[nodiscard]] bool any(std::size_t i0, std::size_t i1, std::size_t j0, std::size_t j1) const {
    for (std::size_t i = i0; i < i1; ++i) {
      for (std::size_t j = j0; j < j1; ++j) {
        if (at(i, j)) return true;
      }
    }
    return false;
  }
  [[nodiscard]] std::size_t rows() const { return rows_; }
  [[nodiscard]] std::size_t columns() const { return columns_; }

 private:
  std::size_t rows_, columns_;
  std::vector<std::uint8_t> bits_;
};

/// The points of the grid that `map` blocks.
Grid blocked_points(const TimingMap& map, const DenseMotion& own, const DenseMotion& other) {
  Grid grid{own, other};
  for (const BlockedCell& c : map.blocked) {
    const auto [i0, i1] = own.inside(c.tau0, c.tau1);
    const auto [j0, j1] = other.inside(c.t0, c.t1);
    grid.mark(i0, i1, j0, j1);
  }
  return grid;
}

/// The points of the grid where bodies collide: every point is decided, blocks at a time where all their samples are alike.
class Oracle {
 public:
  Oracle(DenseMotion& own, DenseMotion& other) : own_(own), other_(other), grid_(own, other) {
    walk(1, own.size(), 0, other.size());  // τ < 0, the commanded robot's wait at its start, is not part of a map
  }
  [[nodiscard]] const Grid& grid() const { return grid_; }

 private:
  void walk(std::size_t i0, std::size_t i1, std::size_t j0, std::size_t j1) {
    if (i0 >= i1 || j0 >= j1) return;
    const auto& a = own_.bodies(i0 + (i1 - i0) / 2);
    const auto& b = other_.bodies(j0 + (j1 - j0) / 2);
    const auto& ra = own_.reach(i0, i1);
    const auto& rb = other_.reach(j0, j1);
    bool clear = true;
    for (std::size_t k = 0; k < a.size(); ++k) {
      for (std::size_t l = 0; l < b.size(); ++l) {
        const double far = ((a[k].a + a[k].b) - (b[l].a + b[l].b)).norm() / 2 - ((a[k].b - a[k].a).norm() + (b[l].b - b[l].a).norm()) / 2 -
                           a[k].radius - b[l].radius;
        if (far > ra[k] + rb[l]) continue;
        const double d = clearance_of(a[k], b[l]);
        if (d + ra[k] + rb[l] <= kTouch) return grid_.mark(i0, i1, j0, j1);
        clear = clear && d - ra[k] - rb[l] > kTouch;
      }
    }
    if (clear) return;
    if (i1 - i0 >= j1 - j0) {
      const std::size_t middle = i0 + (i1 - i0) / 2;
      walk(i0, middle, j0, j1);
      walk(middle, i1, j0, j1);
    } else {
      const std::size_t middle = j0 + (j1 - j0) / 2;
      walk(i0, i1, j0, middle);
      walk(i0, i1, middle, j1);
    }
  }

  DenseMotion& own_;
  DenseMotion& other_;
  Grid grid_;
};

struct Tally {
  std::size_t maps = 0, colliding = 0, misses = 0;
  std::size_t cells = 0, wrong_cells = 0;
  std::size_t evaluations = 0;
  double worst_wrong = 0;  // largest clearance at the centre of a wrongly blocked cell [m]
};

void expect_nothing_missed(const Grid& truth, const Grid& blocked, const DenseMotion& own, const DenseMotion& other, Tally& tally) {
  for (std::size_t i = 0; i < truth.rows(); ++i) {
    for (std::size_t j = 0; j < truth.columns(); ++j) {
      if (!truth.at(i, j) || blocked.at(i, j)) continue;
      double least = kNever;
      for (const Capsule& x : own.bodies(i)) {
        for (const Capsule& y : other.bodies(j)) least = std::min(least, clearance_of(x, y));
      }
      ++tally.misses;
      ADD_FAILURE() << "missed " << least << " m at tau " << own.time(i) << ", t " << other.time(j);
      return;
    }
  }
}

/// Each blocked cell holds a collision, or is as small as cells get and its bodies are nearer than they may move inside it.
void expect_justified(const TimingMap& map, const Grid& truth, SampledMotion& own, SampledMotion& other, const DenseMotion& dense_own,
                      const DenseMotion& dense_other, double resolution, Tally& tally) {
  const double own_piece = own.motion().duration() / static_cast<double>(std::size_t{1} << own.depth());
  const double other_piece = other.motion().duration() / static_cast<double>(std::size_t{1} << other.depth());
  for (const BlockedCell& c : map.blocked) {
    ++tally.cells;
    const auto [i0, i1] = dense_own.inside(c.tau0, c.tau1);
    const auto [j0, j1] = dense_other.inside(c.t0, c.t1);
    if (c.clearance <= kTouch || truth.any(i0, i1, j0, j1)) continue;
    ++tally.wrong_cells;
    EXPECT_TRUE(c.tau1 == kNever || c.tau1 - c.tau0 <= own_piece + 1e-9) << "given up before the resolution limit";
    EXPECT_TRUE(c.t0 == -kNever || c.t1 == kNever || c.t1 - c.t0 <= other_piece + 1e-9) << "given up before the resolution limit";
    EXPECT_LE(std::max(own_piece, other_piece), resolution + 1e-9);
    EXPECT_LE(c.clearance, c.bound);
    tally.worst_wrong = std::max(tally.worst_wrong, c.clearance);
  }
}

/// Shifts (start of the commanded robot after the moving one's, in steps of the grid, from −rows to +columns) at which they collide.
std::vector<bool> colliding_shifts(const Grid& truth) {
  const auto n = static_cast<long>(truth.rows());
  const auto m = static_cast<long>(truth.columns());
  std::vector<bool> hit(static_cast<std::size_t>(n + m + 1));
  const auto mark = [&](long from, long until) {
    for (long s = std::max(from, -n); s <= std::min(until, m); ++s) hit[static_cast<std::size_t>(s + n)] = true;
  };
  long all_below = -n - 1;
  long all_above = m + 1;
  for (long i = 1; i < n; ++i) {
    for (long j = 0; j < m; ++j) {
      if (!truth.at(static_cast<std::size_t>(i), static_cast<std::size_t>(j))) continue;
      hit[static_cast<std::size_t>(j - i + n)] = true;
      if (j == 0 || i == n - 1) all_below = std::max(all_below, j - i);  // stands there for all time before, or after
      if (j == m - 1) all_above = std::min(all_above, j - i);
      if (j == m - 1 && i == n - 1) mark(-n, m);
    }
  }
  mark(-n, all_below);
  mark(all_above, m);
  return hit;
}

/// A border of a start window.
struct Border {
  double error = kNever;  // to the nearest border of the windows that the dense grid leaves [s]; kNever: it forbids nothing near
  double least = 0;       // clearance of the whole encounter when the commanded robot starts right there [m]
};

/// Least clearance [m] when the commanded robot starts `shift` [s] after the moving one.
double encounter_clearance(const DenseMotion& own, const DenseMotion& other, double shift) {
  double least = kNever;
  const auto steps = std::lround(shift / kStep);
  for (long i = 1; i < static_cast<long>(own.size()); ++i) {
    const long j = std::clamp(i + steps, 0L, static_cast<long>(other.size()) - 1);
    for (const Capsule& x : own.bodies(static_cast<std::size_t>(i))) {
      for (const Capsule& y : other.bodies(static_cast<std::size_t>(j))) least = std::min(least, clearance_of(x, y));
    }
  }
  return least;
}

std::vector<Border> window_borders(const TimingMap& map, const Grid& truth, const DenseMotion& own, const DenseMotion& other) {
  const auto hit = colliding_shifts(truth);
  const auto n = static_cast<double>(truth.rows());
  std::vector<double> true_borders;
  for (std::size_t k = 1; k < hit.size(); ++k) {
    if (hit[k] != hit[k - 1]) true_borders.push_back((static_cast<double>(k) - n) * kStep);
  }
  std::vector<core::StartInterval> forbidden;
  for (const auto& f : core::forbidden_starts(map, {})) forbidden.push_back(f.interval);
  const double first = -n * kStep;
  const double last = first + static_cast<double>(hit.size() - 1) * kStep;
  std::vector<Border> borders;
  for (const auto& window : core::complement(core::united(forbidden), model::at_seconds(first))) {
    for (const model::Instant end : {window.from, window.until}) {
      const double s = end == model::kForever ? kNever : model::to_seconds(end);
      if (s <= first + 2 * kResolution || s >= last - 2 * kResolution) continue;
      Border border;
      for (const double b : true_borders) border.error = std::min(border.error, std::abs(b - s));
      border.least = encounter_clearance(own, other, s);
      borders.push_back(border);
    }
  }
  return borders;
}

struct TwoRobots {
  model::Robot a, b;
};

/// Two arms near each other: half of them the experiments' pair, a quarter with offsets, a quarter of random proportions.
TwoRobots random_robots(Seed& seed, std::size_t k) {
  const bool experiment = k % 4 < 2;
  const model::RobotModel m1 = experiment ? arm4() : k % 4 == 2 ? offset_arm() : random_arm(seed);
  const model::RobotModel m2 = experiment ? arm4() : k % 4 == 2 ? offset_arm() : random_arm(seed);
  const double apart = experiment ? (k % 8 < 4 ? 0.5 : seed.uniform(0.4, 0.9)) : seed.uniform(0.6, 1.8);
  TwoRobots two{robot_at("a", m1, {0, apart / 2, 0}, experiment ? 0 : seed.uniform(-kPi, kPi)),
                robot_at("b", m2, {0, -apart / 2, 0}, experiment ? 0 : seed.uniform(-kPi, kPi))};
  for (model::Robot* r : {&two.a, &two.b}) {
    r->tcp.velocity = seed.uniform(0.1, 1.0);
    r->tcp.acceleration = seed.uniform(0.3, 3.0);
    give_joint_rates(*r, 1.5, 6);
  }
  return two;
}

model::Motion random_motion(Seed& seed, const model::Robot& robot) {
  for (;;) {
    model::Motion motion = seed.chance(0.15)   ? model::Motion::rest(robot, random_joints(seed, robot.model))
                           : seed.chance(0.25) ? random_joint_move(seed, robot, 1.0)
                                               : random_linear(seed, robot, 0.7);
    if (motion.duration() <= kLongest) return motion;
  }
}

/// However coarse the map: that decides how deep it is divided, which robot first, and how much is looked at more closely.
TEST(TimingMap, MissesNoCollisionOfADenseGrid) {
  constexpr std::array<double, 5> resolutions{kResolution, kResolution, 0.003, 0.03, 0.1};  // [s]
  Seed seed{61};
  Tally tally;
  std::size_t pairs = 0;
  for (std::size_t k = 0; pairs < scaled(kPairs) && !HasFailure(); ++k) {
    const TwoRobots two = random_robots(seed, k);
    // Pairs that never come near say nothing: nearly all of those are left out.
    const double resolution = resolutions[k % resolutions.size()];
    SampledMotion own{random_motion(seed, two.a), resolution};
    SampledMotion other{random_motion(seed, two.b), resolution};
    const TimingMap map = core::build_timing_map(own, other, 0.0);
    if (map.blocked.empty() && !seed.chance(0.02)) continue;
    ++pairs;
    const double phase = seed.uniform(0, 1);
    DenseMotion dense_own{own.motion(), phase};
    DenseMotion dense_other{other.motion(), phase};
    const Oracle oracle{dense_own, dense_other};
    ++tally.maps;
    tally.evaluations += map.evaluations;
    tally.colliding += map.blocked.empty() ? 0 : 1;
    SCOPED_TRACE(::testing::Message() << "pair " << k << ", durations " << own.motion().duration() << " and " << other.motion().duration());
    expect_nothing_missed(oracle.grid(), blocked_points(map, dense_own, dense_other), dense_own, dense_other, tally);
    expect_justified(map, oracle.grid(), own, other, dense_own, dense_other, resolution, tally);
  }
  std::printf("%zu maps, %zu with blocked cells, %zu distances each; %zu collisions missed\n", tally.maps, tally.colliding,
              tally.evaluations / std::max<std::size_t>(tally.maps, 1), tally.misses);
  std::printf("%zu cells, %.2f %% blocked without a collision inside, largest clearance there %.2g m\n", tally.cells,
              100.0 * static_cast<double>(tally.wrong_cells) / static_cast<double>(std::max<std::size_t>(tally.cells, 1)),
              tally.worst_wrong);
}

/// A straight move of the experiments' kind: gripper level, between places in front of the robot.
model::Motion experiment_motion(Seed& seed, const model::Robot& robot) {
  const double y = robot.X_WB.translation().y() * 1e3;
  const auto place = [&] {
    return pose_mm(seed.uniform(300, 480), seed.uniform(-80, std::abs(y)) * (y > 0 ? 1 : -1), seed.uniform(150, 380));
  };
  for (;;) {
    const auto from = model::preferred_posture(robot.model, robot.X_WB.inverse() * place());
    if (!from) continue;
    auto motion = model::plan_motion(robot, *from, line_to(place()));
    if (motion && motion->duration() > 1 && motion->duration() < 4) return std::move(*motion);
  }
}

/// Clear in each of the four postures in which one or both stand before or after their motions.
bool clear_when_standing(const model::Motion& a, const model::Motion& b) {
  for (const auto& qa : {a.from(), a.to()}) {
    for (const auto& qb : {b.from(), b.to()}) {
      std::vector<Capsule> bodies_a;
      std::vector<Capsule> bodies_b;
      model::place_capsules(a.robot().model, a.robot().X_WB, qa, bodies_a);
      model::place_capsules(b.robot().model, b.robot().X_WB, qb, bodies_b);
      for (const Capsule& x : bodies_a) {
        for (const Capsule& y : bodies_b) {
          if (clearance_of(x, y) <= 0) return false;
        }
      }
    }
  }
  return true;
}

/// A window ends within two resolution steps of where it truly does, or where bodies pass so near that one cell's displacement cannot tell.
TEST(TimingMap, WindowsEndWhereBodiesMeetOrGraze) {
  constexpr std::size_t kEncounters = 30;
  Seed seed{62};
  const auto cell = experiment_cell();
  // Two TCPs at the experiments' 0.1 m/s move by 1 mm together from a cell's centre to its end; other links move less, their bounds are
  // wider.
  const double graze = 3 * 2 * 0.1 * kResolution / 2;
  Tally tally;
  std::vector<double> errors;
  double worst_graze = 0;
  std::size_t grazing = 0;
  for (std::size_t pairs = 0; pairs < scaled(kEncounters) && !HasFailure();) {
    const model::Motion motion = experiment_motion(seed, cell->robots[0]);
    const model::Motion neighbours = experiment_motion(seed, cell->robots[1]);
    if (!clear_when_standing(motion, neighbours)) continue;
    SampledMotion own{motion, kResolution};
    SampledMotion other{neighbours, kResolution};
    const TimingMap map = core::build_timing_map(own, other, 0.0);
    // Encounters that time can avoid: clear when one goes after the other, either way round.
    const auto stands = [](const BlockedCell& c) { return c.t0 == -kNever || c.t1 == kNever || c.tau1 == kNever; };
    if (map.blocked.empty() || std::any_of(map.blocked.begin(), map.blocked.end(), stands)) continue;
    ++pairs;
    DenseMotion dense_own{own.motion(), 0.5};
    DenseMotion dense_other{other.motion(), 0.5};
    const Oracle oracle{dense_own, dense_other};
    expect_nothing_missed(oracle.grid(), blocked_points(map, dense_own, dense_other), dense_own, dense_other, tally);
    expect_justified(map, oracle.grid(), own, other, dense_own, dense_other, kResolution, tally);
    for (const Border& border : window_borders(map, oracle.grid(), dense_own, dense_other)) {
      errors.push_back(border.error);
      if (border.error <= 2 * kResolution + kStep) continue;
      ++grazing;
      worst_graze = std::max(worst_graze, border.least);
      EXPECT_LE(border.least, graze) << "forbidden although nothing comes near; the true border is " << border.error << " s away";
    }
  }
  ASSERT_FALSE(errors.empty());
  std::sort(errors.begin(), errors.end());
  std::printf("%zu borders: %zu within two resolution steps, median %.1f ms off; at the others bodies pass within %.2f mm\n", errors.size(),
              errors.size() - grazing, 1e3 * errors[errors.size() / 2], 1e3 * worst_graze);
  std::printf("%zu cells, %.1f %% blocked without a collision inside, largest clearance there %.2g m\n", tally.cells,
              100.0 * static_cast<double>(tally.wrong_cells) / static_cast<double>(tally.cells), tally.worst_wrong);
}

/// Motions C12 and C22 of experiment 4.2, where brute force on the plane's 10 ms grid takes 2.4 million distances. Counts, not times: the
/// certificate is cheap because few cells have to be looked at.
TEST(TimingMap, OfTheExperimentTakesFewDistances) {
  constexpr std::size_t kMostDistances = 6000;
  constexpr std::size_t kMostCells = 2000;
  const auto cell = experiment_cell();
  const auto reach_in = [](const model::Robot& robot, double y) {
    const auto there = model::plan_motion(robot, robot.start, line_to(pose_mm(300, y, 330))).value();
    return model::plan_motion(robot, there.to(), line_to(pose_mm(350, 0, 200))).value();
  };
  SampledMotion own{reach_in(cell->robots[0], 250), kResolution};
  SampledMotion other{reach_in(cell->robots[1], -250), kResolution};
  const TimingMap map = core::build_timing_map(own, other, 0.0);
  std::printf("%zu distances, %zu blocked cells\n", map.evaluations, map.blocked.size());
  EXPECT_LE(map.evaluations, kMostDistances);
  EXPECT_LE(map.blocked.size(), kMostCells);
  DenseMotion dense_own{own.motion(), 0.0};
  DenseMotion dense_other{other.motion(), 0.0};
  const Oracle oracle{dense_own, dense_other};
  Tally tally;
  expect_nothing_missed(oracle.grid(), blocked_points(map, dense_own, dense_other), dense_own, dense_other, tally);
  expect_justified(map, oracle.grid(), own, other, dense_own, dense_other, kResolution, tally);
}

/// What a cover of shifts holds is forbidden by what was added, and it knows all of that but for less than a bucket at each end.
TEST(ShiftCover, HoldsWhatWasAddedAndNothingElse) {
  constexpr double kBucket = 0.001;  // [s]
  Seed seed{63};
  for (std::size_t k = 0; k < scaled(2000) && !HasFailure(); ++k) {
    const double first = -seed.uniform(0, 2);
    const double last = seed.uniform(0.1, 2);
    core::ShiftCover cover{first, last, kBucket};
    std::vector<std::pair<double, double>> added;
    for (std::size_t i = 0, n = seed.below(20); i < n; ++i) {
      const double from = seed.chance(0.05) ? -kNever : seed.uniform(first, last);
      const double until = seed.chance(0.05) ? kNever : from + seed.uniform(0, 0.3);
      added.emplace_back(from, until);
      cover.add(from, until);
    }
    std::sort(added.begin(), added.end());
    for (int i = 0; i < 100; ++i) {
      const double from = seed.uniform(first, last);
      const double until = std::min(last, from + seed.uniform(0, 0.05));
      double reached = from;  // forbidden without a gap from `from` to here
      double single = -kNever;
      for (const auto& [a, b] : added) {
        if (a <= reached) reached = std::max(reached, b);
        if (a + kBucket <= from) single = std::max(single, b);
      }
      EXPECT_TRUE(!cover.holds(from, until) || reached >= until) << from << " to " << until << ", but forbidden only to " << reached;
      EXPECT_TRUE(cover.holds(from, until) || single < until + 2 * kBucket) << from << " to " << until;
    }
  }
}

}  // namespace
}  // namespace interlace::test
