#include "modeller/cover.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "modeller/capsule_fit.hpp"
#include "modeller/cut.hpp"
#include "modeller/hull.hpp"
#include "modeller/volume.hpp"

namespace interlace::modeller {

namespace {

using mesh::Mesh;
using model::Capsule;
using model::Vector3;

constexpr double kPays = 0.01;   // a cut gains this share of the whole volume at least
constexpr int kCoarse = 48;      // lines of volumes that are only compared
constexpr int kPlaces = 8;       // the places of a cut are the eighths of the part's length
constexpr double kSolid = 1e-6;  // a mesh that encloses less than this share of its hull, or that much more, is not one simple body

/// A part of the mesh and its capsule. Throws when the capsule does not hold every vertex: the proof of `cover` rests on it.
struct Part {
  explicit Part(Mesh m) : mesh(std::move(m)), capsule(tightest_capsule(mesh.vertices)) {
    for (const Vector3& p : mesh.vertices) {
      if (!(depth_in(capsule, p) > 0)) throw std::logic_error{"a vertex lies outside its capsule"};
    }
  }
  Mesh mesh;
  Capsule capsule;
};

/// A part in two; empty where no plane cuts it.
using Halves = std::vector<Part>;

/// Directions to cut across: those of the file's frame, in which designers think, and of the capsule.
std::vector<Vector3> directions_of(const Part& part) {
  std::vector<Vector3> directions{Vector3::UnitX(), Vector3::UnitY(), Vector3::UnitZ()};
  const Vector3 axis = part.capsule.b - part.capsule.a;
  if (axis.norm() > 0) directions.push_back(axis.normalized());
  return directions;
}

Halves best_cut(const Part& part) {
  double least = std::numeric_limits<double>::infinity();
  std::pair<Mesh, Mesh> best;
  for (const Vector3& n : directions_of(part)) {
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (const Vector3& p : part.mesh.vertices) {
      low = std::min(low, n.dot(p));
      high = std::max(high, n.dot(p));
    }
    for (int k = 1; k < kPlaces; ++k) {
      auto halves = cut(part.mesh, n, low + (high - low) * k / kPlaces);
      if (halves.first.triangles.empty() || halves.second.triangles.empty()) continue;
      const double volume = union_volume(
          {tightest_capsule(halves.first.vertices, Effort::quick), tightest_capsule(halves.second.vertices, Effort::quick)}, kCoarse);
      if (volume >= least) continue;
      least = volume;
      best = std::move(halves);
    }
  }
  Halves halves;
  if (best.first.triangles.empty()) return halves;
  halves.emplace_back(std::move(best.first));
  halves.emplace_back(std::move(best.second));
  return halves;
}

/// The capsules of `parts`, with those of the halves instead of the one of part `cut`.
std::vector<Capsule> capsules_of(const std::vector<Part>& parts, std::size_t cut, const Halves& halves) {
  std::vector<Capsule> capsules;
  for (std::size_t i = 0; i < parts.size(); ++i) capsules.push_back(i == cut ? halves[0].capsule : parts[i].capsule);
  capsules.push_back(halves[1].capsule);
  return capsules;
}

/// What the capsules are compared with.
void measure_body(const Mesh& mesh, Cover& cover) {
  const auto hull = hull_of(mesh.vertices);
  const auto enclosed = enclosed_volume(mesh);
  cover.body_volume = hull ? hull->volume : 0;
  cover.watertight = enclosed && *enclosed > kSolid * cover.body_volume && *enclosed < (1 + kSolid) * cover.body_volume;
  if (cover.watertight) cover.body_volume = *enclosed;
}

void measure_depths(const Mesh& mesh, Cover& cover) {
  cover.least_depth = std::numeric_limits<double>::infinity();
  for (const Vector3& p : mesh.vertices) {
    double depth = -std::numeric_limits<double>::infinity();
    for (const Capsule& c : cover.capsules) depth = std::max(depth, depth_in(c, p));
    cover.least_depth = std::min(cover.least_depth, depth);
    cover.most_depth = std::max(cover.most_depth, depth);
  }
}

}  // namespace

Cover cover(const Mesh& mesh, const CoverOptions& options) {
  Cover cover;
  measure_body(mesh, cover);
  std::vector<Part> parts;
  std::vector<std::optional<Halves>> halves(1);  // of each part, once asked for
  parts.emplace_back(mesh);
  cover.capsules = {parts[0].capsule};
  cover.volume = volume_of(parts[0].capsule);
  while (parts.size() < options.capsules && !(options.excess && cover.excess() <= *options.excess)) {
    std::optional<std::size_t> best;
    double least = (1 - kPays) * cover.volume;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      if (!halves[i]) halves[i] = best_cut(parts[i]);
      if (halves[i]->empty()) continue;
      const double volume = union_volume(capsules_of(parts, i, *halves[i]));
      if (volume > least) continue;
      least = volume;
      best = i;
    }
    if (!best) break;
    cover.capsules = capsules_of(parts, *best, *halves[*best]);
    cover.volume = least;
    Halves chosen = std::move(*halves[*best]);
    parts[*best] = std::move(chosen[0]);
    parts.push_back(std::move(chosen[1]));
    halves[*best].reset();
    halves.emplace_back();
  }
  measure_depths(mesh, cover);
  return cover;
}

}  // namespace interlace::modeller
