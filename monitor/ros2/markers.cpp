#include "monitor/ros2/markers.hpp"

#include "monitor/ros2/frames.hpp"

namespace interlace::monitor {

namespace {

constexpr double kClose = 0.05;       // [m]
constexpr double kPlaneSide = 4;      // [m]
constexpr double kPlaneSheet = 1e-3;  // thickness [m]

// Okabe and Ito's colours: told apart with every kind of colour blindness.
constexpr ros2::ColorRGBA kFree{0.0F, 0.45F, 0.70F, 0.9F};
constexpr ros2::ColorRGBA kNear{0.90F, 0.62F, 0.0F, 0.9F};
constexpr ros2::ColorRGBA kTouching{0.84F, 0.37F, 0.0F, 1.0F};
constexpr ros2::ColorRGBA kSilent{0.6F, 0.6F, 0.6F, 0.5F};
constexpr ros2::ColorRGBA kFixture{0.8F, 0.8F, 0.75F, 1.0F};

ros2::ColorRGBA colour(const RobotPicture& robot, std::size_t capsule) {
  if (!robot.heard) return kSilent;
  const double clearance = capsule < robot.clearance.size() ? robot.clearance[capsule] : kClose;
  return clearance <= 0 ? kTouching : clearance < kClose ? kNear : kFree;
}

ros2::Marker marker(const std::string& ns, std::size_t id, std::int32_t type, const model::Pose& X, const model::Vector3& size) {
  ros2::Marker m;
  m.ns = ns;
  m.id = static_cast<std::int32_t>(id);
  m.type = type;
  m.pose = to_ros2(X);
  m.scale = {size.x(), size.y(), size.z()};
  return m;
}

void add_capsule(const RobotPicture& robot, std::size_t k, const ros2::Header& header, std::vector<ros2::Marker>& markers) {
  const model::Capsule& c = robot.capsules[k];
  const model::Vector3 ball = model::Vector3::Constant(2 * c.radius);
  const auto add = [&](std::size_t part, std::int32_t type, const model::Pose& X, const model::Vector3& size) {
    ros2::Marker m = marker(robot.body->name.str(), 3 * k + part, type, X, size);
    m.header = header;
    m.color = colour(robot, k);
    m.lifetime.sec = kMarkerLifetime;
    markers.push_back(std::move(m));
  };
  add(0, ros2::Marker::kSphere, model::make_pose(c.a, model::Quaternion::Identity()), ball);
  const model::Vector3 along = c.b - c.a;
  const double length = along.norm();
  if (length <= 0) return;
  add(1, ros2::Marker::kSphere, model::make_pose(c.b, model::Quaternion::Identity()), ball);
  add(2, ros2::Marker::kCylinder, model::make_pose((c.a + c.b) / 2, model::Quaternion::FromTwoVectors(model::Vector3::UnitZ(), along)),
      {2 * c.radius, 2 * c.radius, length});
}

/// The shape of a fixture in its own frame, placed at X.
struct ShapeMarker {
  const std::string& ns;
  const model::Pose& X;

  ros2::Marker operator()(const model::SphereShape& s) const {
    return marker(ns, 0, ros2::Marker::kSphere, X, model::Vector3::Constant(2 * s.radius));
  }
  ros2::Marker operator()(const model::BoxShape& s) const { return marker(ns, 0, ros2::Marker::kCube, X, 2 * s.half); }
  ros2::Marker operator()(const model::CylinderShape& s) const {
    return marker(ns, 0, ros2::Marker::kCylinder, X, {2 * s.radius, 2 * s.radius, 2 * s.half_length});
  }
  /// The sheet lies in the material, its outer face on the plane.
  ros2::Marker operator()(const model::PlaneShape& s) const {
    const model::Pose X_OS =
        model::make_pose(s.normal * (s.offset - kPlaneSheet / 2), model::Quaternion::FromTwoVectors(model::Vector3::UnitZ(), s.normal));
    return marker(ns, 0, ros2::Marker::kCube, X * X_OS, {kPlaneSide, kPlaneSide, kPlaneSheet});
  }
  ros2::Marker operator()(const model::MeshShape& s) const {
    ros2::Marker m = marker(ns, 0, ros2::Marker::kTriangleList, X, model::Vector3::Ones());
    for (std::size_t i = 0; i < s.mesh->triangles().size(); ++i) {
      for (const model::Vector3& p : s.mesh->corners(i)) m.points.push_back({p.x(), p.y(), p.z()});
    }
    return m;
  }
};

}  // namespace

ros2::MarkerArray capsule_markers(const CellPicture& picture, ros2::Time stamp) {
  ros2::MarkerArray message;
  const ros2::Header header = world_header(stamp);
  for (const RobotPicture& robot : picture.robots) {
    for (std::size_t k = 0; k < robot.capsules.size(); ++k) add_capsule(robot, k, header, message.markers);
  }
  return message;
}

ros2::MarkerArray fixture_markers(const model::Cell& cell, ros2::Time stamp) {
  ros2::MarkerArray message;
  for (const model::Fixture& fixture : cell.fixtures) {
    ros2::Marker m = std::visit(ShapeMarker{fixture.name, fixture.X_WO}, fixture.shape);
    m.header = world_header(stamp);
    m.color = kFixture;
    message.markers.push_back(std::move(m));
  }
  return message;
}

}  // namespace interlace::monitor
