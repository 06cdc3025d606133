#include "simulator/fixture_check.hpp"

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/distance.h>

#include <algorithm>

#include "common/model/fixture_distance.hpp"

namespace interlace::sim {

namespace {

using model::Vector3;
using GeometryPtr = std::shared_ptr<fcl::CollisionGeometryd>;

struct GeometryOf {
  GeometryPtr operator()(const model::SphereShape& s) const { return std::make_shared<fcl::Sphered>(s.radius); }
  GeometryPtr operator()(const model::BoxShape& s) const { return std::make_shared<fcl::Boxd>(2 * s.half); }
  GeometryPtr operator()(const model::CylinderShape& s) const { return std::make_shared<fcl::Cylinderd>(s.radius, 2 * s.half_length); }
  GeometryPtr operator()(const model::PlaneShape& /*unmeasured*/) const { return nullptr; }
  GeometryPtr operator()(const model::MeshShape& s) const {
    auto surface = std::make_shared<fcl::BVHModel<fcl::OBBRSSd>>();
    std::vector<fcl::Triangle> triangles;
    for (const auto& t : s.mesh->triangles()) triangles.emplace_back(t[0], t[1], t[2]);
    surface->beginModel();
    surface->addSubModel(s.mesh->vertices(), triangles);
    surface->endModel();
    return surface;
  }
};

/// The axis of a capsule.
fcl::CollisionObjectd axis_of(const model::Capsule& c) {
  const double length = (c.b - c.a).norm();
  model::Pose X_WC = model::Pose::Identity();
  X_WC.translation() = (c.a + c.b) / 2;
  if (length <= 0) return {std::make_shared<fcl::Sphered>(0.0), X_WC};
  X_WC.linear() = Eigen::Quaterniond::FromTwoVectors(Vector3::UnitZ(), c.b - c.a).toRotationMatrix();
  return {std::make_shared<fcl::Capsuled>(0.0, length), X_WC};
}

}  // namespace

FixtureCheck::FixtureCheck(const std::vector<model::Fixture>& fixtures) : fixtures_(fixtures) {
  for (const model::Fixture& f : fixtures) {
    const GeometryPtr geometry = std::visit(GeometryOf{}, f.shape);
    objects_.push_back(geometry ? std::make_unique<fcl::CollisionObjectd>(geometry, f.X_WO) : nullptr);
  }
}

double FixtureCheck::clearance(const model::Capsule& capsule, std::size_t fixture, double enough) const {
  const model::Fixture& f = fixtures_[fixture];
  if (const auto* plane = std::get_if<model::PlaneShape>(&f.shape)) {
    const Vector3 normal = f.X_WO.linear() * plane->normal;
    const double offset = plane->offset + normal.dot(f.X_WO.translation());
    return std::max(std::min(normal.dot(capsule.a), normal.dot(capsule.b)) - offset, 0.0) - capsule.radius;
  }
  const fcl::CollisionObjectd axis = axis_of(capsule);
  const double boxes = axis.getAABB().distance(objects_[fixture]->getAABB()) - capsule.radius;
  if (boxes > enough) return boxes;
  const fcl::DistanceRequestd request{false, false, 0, 0, 1e-9};
  fcl::DistanceResultd result;
  fcl::distance(&axis, objects_[fixture].get(), request, result);
  const auto* mesh = std::get_if<model::MeshShape>(&f.shape);
  const bool inside = mesh != nullptr && mesh->mesh->solid() && model::surrounds(*mesh->mesh, f.X_WO.inverse() * capsule.a);
  return (inside ? 0 : std::max(result.min_distance, 0.0)) - capsule.radius;
}

}  // namespace interlace::sim
