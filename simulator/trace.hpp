#pragma once

#include <iosfwd>
#include <string>

#include "common/model/cell.hpp"

namespace interlace::sim {

/// Writes the trace of the contract (DESIGN section 8): one CSV row per robot and instant, SI units, world frame.
class TraceWriter {
 public:
  /// Writes the header to `out`, which must outlive the writer.
  explicit TraceWriter(std::ostream& out);

  /// `t` [s]; `motion` names the running command, empty while standing.
  void row(double t, const model::Robot& robot, const model::Joints& joints, const std::string& motion);

 private:
  std::ostream& out_;
};

}  // namespace interlace::sim
