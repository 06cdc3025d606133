#include "planner/core/clearance.hpp"

#include <fcl/narrowphase/distance.h>

namespace interlace::core {

BodyShapes::BodyShapes(const model::RobotModel& model) {
  for (const model::LinkCapsule& c : model.capsules) axes_.emplace_back(0.0, (c.b - c.a).norm());
}

void BodyShapes::place(const std::vector<model::Capsule>& capsules, std::vector<Body>& out) const {
  out.resize(capsules.size());
  for (std::size_t i = 0; i < capsules.size(); ++i) {
    const model::Capsule& c = capsules[i];
    Body& body = out[i];
    body.axis = &axes_[i];
    body.radius = c.radius;
    body.X_WC.linear() = Eigen::Quaterniond::FromTwoVectors(Vector3::UnitZ(), c.b - c.a).toRotationMatrix();
    body.X_WC.translation() = (c.a + c.b) / 2;
  }
}

double clearance(const Body& a, const Body& b) {
  const fcl::DistanceRequestd request;
  fcl::DistanceResultd result;
  return fcl::distance(a.axis, a.X_WC, b.axis, b.X_WC, request, result) - a.radius - b.radius;
}

double clearance_lower_bound(const Body& a, const Body& b) {
  return (a.X_WC.translation() - b.X_WC.translation()).norm() - (a.axis->lz + b.axis->lz) / 2 - a.radius - b.radius;
}

Vector3 meeting_point(const Body& a, const Body& b) {
  fcl::DistanceRequestd request;
  request.enable_nearest_points = true;
  fcl::DistanceResultd result;
  fcl::distance(a.axis, a.X_WC, b.axis, b.X_WC, request, result);
  return (result.nearest_points[0] + result.nearest_points[1]) / 2;
}

}  // namespace interlace::core
