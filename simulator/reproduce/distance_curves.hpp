#pragma once

#include <string>
#include <vector>

#include "simulator/reproduce/postures.hpp"

namespace interlace::reproduce {

/// Least distance between the axes of two links over the frames of a run.
struct LinkDistance {
  std::size_t link_a = 0, link_b = 0;  ///< capsules of the models
  double prohibited = 0;               ///< sum of their radii [m]; at or below it they touch
  std::vector<double> distance;        ///< per frame [m]
};

/// Of every pair of links of robots `a` and `b`, links of `a` first. From the postures alone, with none of the planner's code.
[[nodiscard]] std::vector<LinkDistance> link_distances(const model::Cell& cell, const std::vector<Frame>& frames, model::RobotIndex a,
                                                       model::RobotIndex b);

/// Least clearance of all of those pairs of links, per frame [m].
[[nodiscard]] std::vector<double> least_clearance(const std::vector<LinkDistance>& distances);

/// One run of a picture.
struct CurveRun {
  std::string name;
  const std::vector<Frame>* frames = nullptr;
};

/// Distance curves (dissertation tables 4.2 to 5.6). Two robots: one small graph per pair of links with the prohibited distance dashed.
/// More robots: one per pair of robots with the least clearance of all their links, zero dashed. Parts in collision are drawn thick.
[[nodiscard]] std::string distance_picture(const std::string& title, const model::Cell& cell, const std::vector<CurveRun>& runs);

}  // namespace interlace::reproduce
