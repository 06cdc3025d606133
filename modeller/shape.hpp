#pragma once

#include <optional>
#include <string>

#include "common/model/pose.hpp"

namespace interlace::modeller {

/// A mesh that belongs to a link, and how many capsules it may take.
struct Shape {
  std::size_t link = 0;                        ///< 0 base … 6 flange, see model::LinkFrames
  std::string file;                            ///< STL or OBJ
  double scale = 0.001;                        ///< metres in one unit of the file
  model::Pose X_LM = model::Pose::Identity();  ///< the mesh's frame in the link's frame
  std::optional<std::size_t> capsules;         ///< at most; else as for all
};

}  // namespace interlace::modeller
