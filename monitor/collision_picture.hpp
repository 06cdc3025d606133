#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "planner/core/collision_map.hpp"
#include "planner/core/sampled_motion.hpp"

namespace interlace::monitor {

/// One thing a neighbour did, does or is going to do: it stands before the first and after each until the next. Times [s] on the
/// observer's line.
struct NeighbourPart {
  std::string command;  ///< empty: it stands
  core::SampledMotionPtr motion;
  double start = 0;
};
struct PictureNeighbour {
  std::string robot;
  std::vector<NeighbourPart> parts;  ///< in order of their start; never empty
};

/// What a picture of a collision map is about.
struct PictureSubject {
  std::string command, robot;
  core::SampledMotionPtr motion;
  double ready = 0;             ///< when it could have started
  double earliest = 0;          ///< when the planner judged it as shown: no window before
  std::optional<double> start;  ///< when it does; empty: nobody knows
  std::vector<PictureNeighbour> neighbours;
  std::vector<PictureNeighbour> before;  ///< as they were when it was held up first; empty: no different
};

/// A part of the map in which `own` and `other`, capsules of the two, could touch.
struct PictureArea {
  double t0 = 0, t1 = 0;            ///< on the observer's line; −∞ and +∞ where a neighbour stands
  double length0 = 0, length1 = 0;  ///< travelling length of the commanded TCP [m]
  std::size_t own = 0, other = 0;   ///< capsules
  double clearance = 0;             ///< [m]
};

/// The dissertation's collision map of one command against all its neighbours at once, over the time everybody shares.
struct CollisionPicture {
  struct Neighbour {
    std::string robot;
    std::vector<std::string> links;  ///< names of its capsules
    std::vector<PictureArea> areas;
  };
  std::vector<std::string> links;  ///< of the commanded robot's capsules
  std::vector<Neighbour> neighbours;
  std::vector<Neighbour> before;                   ///< as it looked when it was held up first
  std::vector<std::pair<double, double>> windows;  ///< starts that meet nothing, as known at the time; +∞ where there is no end
  bool complete = true;                            ///< false: there are more areas than anybody could look at
};

inline constexpr std::size_t kMaxAreas = 12'000;  ///< of one picture

/// Builds the maps with the planner's own code, without the allowances it makes for late starts: its windows lie inside these.
[[nodiscard]] CollisionPicture draw(const PictureSubject& subject, double margin);

/// The picture as a frame (docs/monitor.md).
[[nodiscard]] nlohmann::json to_json(const PictureSubject& subject, const CollisionPicture& picture);

}  // namespace interlace::monitor
