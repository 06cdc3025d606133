#pragma once

#include <string>
#include <vector>

#include "common/model/cell.hpp"

namespace interlace::reproduce {

/// Where all robots of a cell were at one instant of a run.
struct Frame {
  double t = 0;                       ///< [s]
  std::vector<model::Joints> joints;  ///< of each robot, in the order of the cell [rad]
};

/// The frames of a trace (the CSV that sim::TraceWriter writes), in order. Throws std::runtime_error with the line number when a line is
/// not one of such a trace.
[[nodiscard]] std::vector<Frame> parse_trace(const std::string& csv, const model::Cell& cell);

/// The last frame not after `t` [s], the first when all are; `frames` must not be empty.
[[nodiscard]] const Frame& frame_at(const std::vector<Frame>& frames, double t);

}  // namespace interlace::reproduce
