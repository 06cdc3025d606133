#include "simulator/trace.hpp"

#include <fmt/format.h>

#include <iterator>
#include <ostream>

namespace interlace::sim {

TraceWriter::TraceWriter(std::ostream& out) : out_(out) {
  out_ << "t,robot,x,y,z,qw,qx,qy,qz,j1,j2,j3,j4,j5,j6,motion\n";
}

void TraceWriter::row(double t, const model::Robot& robot, const model::Joints& q, const std::string& motion) {
  const model::Pose X_WT = robot.X_WB * model::tcp_pose(robot.model, q);
  const auto p = X_WT.translation();
  model::Quaternion r{X_WT.linear()};
  if (r.w() < 0) r.coeffs() *= -1;  // one of the two quaternions of a rotation, always the same
  fmt::memory_buffer line;
  fmt::format_to(std::back_inserter(line), "{:.4f},{},{:.9f},{:.9f},{:.9f},{:.9f},{:.9f},{:.9f},{:.9f}", t, robot.name.str(), p.x(), p.y(),
                 p.z(), r.w(), r.x(), r.y(), r.z());
  for (std::size_t i = 0; i < model::kJoints; ++i) fmt::format_to(std::back_inserter(line), ",{:.9f}", q[i]);
  fmt::format_to(std::back_inserter(line), ",{}\n", motion);
  out_.write(line.data(), static_cast<std::streamsize>(line.size()));
}

}  // namespace interlace::sim
