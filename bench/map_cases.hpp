#pragma once

#include <memory>
#include <string>
#include <vector>

#include "common/model/cell.hpp"
#include "common/model/motion.hpp"

namespace interlace::bench {

/// Two motions that a map is built of.
struct MapCase {
  model::Motion commanded, moving;
};

/// Maps of one cell, which the motions refer to.
struct MapCases {
  std::string name;
  std::shared_ptr<const model::Cell> cell;
  std::vector<MapCase> maps;
};

/// Motions C12 and C22 of experiment 4.2: both arms reach for the same place from either side.
[[nodiscard]] MapCases c12_c22();

/// Every map that a planner builds for the program CELLS/FOLDER/PROGRAM.yaml in virtual time.
/// Throws std::runtime_error with the finding when a file is wrong.
[[nodiscard]] MapCases maps_of(const std::string& cells, const std::string& folder, const std::string& program);

}  // namespace interlace::bench
