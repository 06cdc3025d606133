// Distances to fixtures, and what admission makes of them. See docs/adr/0004-distances-to-fixtures.md.
#include <fcl/fcl.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "common/model/fixture_distance.hpp"
#include "planner/core/fixture_clearance.hpp"
#include "tests/support/fixtures.hpp"
#include "tests/support/motions.hpp"

namespace interlace::test {
namespace {

using core::Body;
using model::Capsule;
using model::Fixture;
using model::Vector3;

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr double kAgree = 1e-7;  // [m] between the two computations: FCL loses digits between nearly parallel segments

/// Points all over the shape's surface, none of which has any other place of the surface farther than `apart` [m] from all of them.
struct Samples {
  std::vector<Vector3> points;
  double apart = 0;
};

class Sampler {
 public:
  explicit Sampler(int steps) : steps_(steps) {}

  void patch(const Vector3& corner, const Vector3& u, const Vector3& v) {
    for (int i = 0; i <= steps_; ++i) {
      for (int k = 0; k <= steps_; ++k) samples_.points.emplace_back(corner + u * i / steps_ + v * k / steps_);
    }
    samples_.apart = std::max(samples_.apart, (u.norm() + v.norm()) / steps_);
  }
  void triangle(const Vector3& a, const Vector3& b, const Vector3& c) {
    for (int i = 0; i <= steps_; ++i) {
      for (int k = 0; k <= steps_ - i; ++k) samples_.points.emplace_back(a + (b - a) * i / steps_ + (c - a) * k / steps_);
    }
    samples_.apart = std::max(samples_.apart, ((b - a).norm() + (c - a).norm()) / steps_);
  }
  void ring(double radius, double z, double apart) {
    for (int k = 0; k < 4 * steps_; ++k) {
      const double turn = 2 * kPi * k / (4 * steps_);
      samples_.points.emplace_back(radius * std::cos(turn), radius * std::sin(turn), z);
    }
    samples_.apart = std::max(samples_.apart, apart + 2 * kPi * radius / (4 * steps_));
  }
  [[nodiscard]] int steps() const { return steps_; }
  [[nodiscard]] Samples take() { return std::move(samples_); }

 private:
  int steps_;
  Samples samples_;
};

struct Surface {
  Sampler& out;

  void operator()(const model::SphereShape& s) const {
    for (int i = 0; i <= 2 * out.steps(); ++i) {
      const double up = kPi * i / (2 * out.steps());
      out.ring(s.radius * std::sin(up), s.radius * std::cos(up), kPi * s.radius / (2 * out.steps()));
    }
  }
  void operator()(const model::BoxShape& s) const {
    for (int axis = 0; axis < 3; ++axis) {
      const Vector3 u = 2 * s.half[(axis + 1) % 3] * Vector3::Unit((axis + 1) % 3);
      const Vector3 v = 2 * s.half[(axis + 2) % 3] * Vector3::Unit((axis + 2) % 3);
      const Vector3 w = s.half[axis] * Vector3::Unit(axis);
      out.patch(w - u / 2 - v / 2, u, v);
      out.patch(-w - u / 2 - v / 2, u, v);
    }
  }
  void operator()(const model::CylinderShape& s) const {
    for (int i = 0; i <= out.steps(); ++i) {
      out.ring(s.radius, s.half_length * (2.0 * i / out.steps() - 1), 2 * s.half_length / out.steps());
      for (const double z : {-s.half_length, s.half_length}) out.ring(s.radius * i / out.steps(), z, s.radius / out.steps());
    }
  }
  void operator()(const model::PlaneShape&) const {}
  void operator()(const model::MeshShape& s) const {
    for (std::size_t i = 0; i < s.mesh->triangles().size(); ++i) {
      const auto t = s.mesh->corners(i);
      out.triangle(t[0], t[1], t[2]);
    }
  }
};

double distance_to(const Vector3& p, const Vector3& a, const Vector3& b) {
  const double length = (b - a).squaredNorm();
  const double s = length > 0 ? std::clamp((b - a).dot(p - a) / length, 0.0, 1.0) : 0.0;
  return (p - a - s * (b - a)).norm();
}

Capsule random_capsule(Seed& seed, const Fixture& fixture) {
  Capsule c{random_point(seed, 0.6), random_point(seed, 0.6), seed.uniform(0.0, 0.1)};
  if (seed.chance(0.1)) c.b = c.a;
  if (seed.chance(0.2))
    c.b = c.a + fixture.X_WO.linear().col(static_cast<Eigen::Index>(seed.below(3))) * seed.uniform(-0.4, 0.4);  // along it
  if (seed.chance(0.1)) c.a = fixture.X_WO.translation();
  return c;
}

/// Whether the samples would tell of contact although the surface is not near: the axis may be inside.
bool is_surface(const Fixture& f) {
  const auto* s = std::get_if<model::MeshShape>(&f.shape);
  return s != nullptr && !s->mesh->solid();
}

TEST(FixtureDistance, TwoComputationsAndTheSampledSurfaceAgree) {
  Seed seed{71};
  for (int type = 0; type < kFixtureTypes; ++type) {
    double worst = 0;
    std::size_t contacts = 0;
    std::size_t inside = 0;
    for (std::size_t n = 0; n < scaled(300) && !HasFailure(); ++n) {
      const Fixture f = random_fixture(seed, type, 0.3);
      Sampler sampler{type >= 4 ? 8 : 24};
      std::visit(Surface{sampler}, f.shape);
      const Samples samples = sampler.take();
      for (int k = 0; k < 20 && !HasFailure(); ++k) {
        const Capsule c = random_capsule(seed, f);
        const Body body{c};
        const double planner = std::max(core::clearance(body, f, kNever), -c.radius);  // of some shapes it tells the depth too
        const double ours = model::clearance(c, f);
        const bool apart = planner > -c.radius + kAgree;
        EXPECT_NEAR(planner, ours, kAgree) << "type " << type;
        if (apart) worst = std::max(worst, std::abs(planner - ours));
        if (planner <= 0) ++contacts;
        EXPECT_LE(model::clearance_lower_bound(c, f), ours + kAgree);
        // Asked only whether it is nearer than something, it says the same.
        const double enough = seed.uniform(0.0, 0.3);
        const double quick = core::clearance(body, f, enough);
        EXPECT_TRUE(planner > enough ? quick > enough : std::abs(std::max(quick, -c.radius) - planner) <= 1e-12)
            << planner << " and " << quick << " of " << enough;
        if (samples.points.empty()) continue;
        double least = kNever;
        for (const Vector3& p : samples.points) least = std::min(least, distance_to(f.X_WO * p, c.a, c.b) - c.radius);
        EXPECT_LE(planner, least + kAgree) << "type " << type << ": longer than to a point of the surface";
        if (planner < least - samples.apart && !is_surface(f)) {
          ++inside;
          EXPECT_LE(planner, -c.radius + kAgree) << "type " << type;
          EXPECT_LE(model::clearance({c.a, c.a, 0}, f) * model::clearance({c.b, c.b, 0}, f), kAgree) << "an end would have to be inside";
        } else {
          EXPECT_GE(planner, least - samples.apart) << "type " << type << ": no point of the surface is as near";
        }
      }
    }
    std::printf("type %d: worst difference %.3g m, %zu contacts, %zu axes inside\n", type, worst, contacts, inside);
    EXPECT_GT(contacts, 0U);
  }
}

/// FCL's general solver, as the second peer: it is what most would have used. With its default tolerance it is off by millimetres.
TEST(FixtureDistance, FclsGeneralSolverAgreesToItsOwnAccuracy) {
  constexpr double kFcl = 2e-5;  // [m] with a tolerance of 1e-9: measured 1.1e-5 at worst
  Seed seed{72};
  double worst = 0;
  for (std::size_t n = 0; n < scaled(3000) && !HasFailure(); ++n) {
    const Fixture f = random_fixture(seed, 1 + static_cast<int>(n % 2), 0.3);
    const Capsule c = random_capsule(seed, f);
    const fcl::Capsuled axis{0.0, (c.b - c.a).norm()};
    fcl::Transform3d X_WC = fcl::Transform3d::Identity();
    X_WC.linear() = Eigen::Quaterniond::FromTwoVectors(Vector3::UnitZ(), c.b - c.a).toRotationMatrix();
    X_WC.translation() = (c.a + c.b) / 2;
    std::unique_ptr<fcl::CollisionGeometryd> shape;
    if (const auto* box = std::get_if<model::BoxShape>(&f.shape)) shape = std::make_unique<fcl::Boxd>(2 * box->half);
    if (const auto* cylinder = std::get_if<model::CylinderShape>(&f.shape)) {
      shape = std::make_unique<fcl::Cylinderd>(cylinder->radius, 2 * cylinder->half_length);
    }
    const fcl::DistanceRequestd request{false, false, 0, 0, 1e-9};
    fcl::DistanceResultd result;
    const double fcl = std::max(fcl::distance(&axis, X_WC, shape.get(), f.X_WO, request, result), 0.0);
    const double ours = std::max(core::clearance(Body{c}, f, kNever) + c.radius, 0.0);
    worst = std::max(worst, std::abs(fcl - ours));
    EXPECT_NEAR(fcl, ours, kFcl);
  }
  std::printf("worst difference from FCL's general solver %.3g m\n", worst);
}

TEST(FixtureDistance, ABodyWhollyInsideASolidMeshIsInContact) {
  Seed seed{73};
  for (std::size_t n = 0; n < scaled(2000) && !HasFailure(); ++n) {
    const bool solid = seed.chance(0.5);
    const auto mesh = bumpy_mesh(seed, 0.3, 6, solid);
    EXPECT_EQ(mesh->open_edges(), 0U);
    const model::Pose X_WO = model::make_pose(random_point(seed, 1), random_rotation(seed));
    const Fixture f = fixture("f", model::MeshShape{mesh}, X_WO);
    // From the centre every place of the surface is at least 0.4 of the radius away: patches are flat between bumps of 0.5 to 1.
    const Capsule in{X_WO * random_point(seed, 0.03), X_WO * random_point(seed, 0.03), 0.01};
    EXPECT_EQ(core::clearance(Body{in}, f, kNever) <= 0, solid);
    EXPECT_EQ(model::clearance(in, f) <= 0, solid);
    const Vector3 p = random_point(seed, 0.35);
    const Capsule anywhere{X_WO * p, X_WO * p, 0};
    if (model::clearance({anywhere.a, anywhere.a, 0},
                         fixture("g", model::MeshShape{mesh_of(mesh->vertices(), mesh->triangles(), false)}, X_WO)) > 1e-6) {
      EXPECT_EQ(core::clearance(Body{anywhere}, f, kNever) <= 0, solid && model::surrounds(*mesh, p)) << p.transpose();
    }
  }
}

/// The certificate: no posture of a path that is found clear touches anything, and what is refused comes near indeed.
TEST(FixtureContact, NoPlaceOfAClearPathTouchesAFixture) {
  constexpr double kStep = 0.001;  // [s] of the samples
  Seed seed{74};
  std::size_t clear = 0;
  std::size_t refused = 0;
  double nearest = kNever;
  double farthest = 0;  // that a refused path stayed away
  for (std::size_t n = 0; n < scaled(1000) && !HasFailure(); ++n) {
    model::Robot robot = robot_at("r", arm4(), random_point(seed, 0.1), seed.uniform(-kPi, kPi));
    robot.tcp.velocity = seed.uniform(0.1, 1.0);
    robot.tcp.acceleration = 2;
    give_joint_rates(robot);
    const double margin = seed.chance(0.3) ? 0.01 : 0.0;
    std::vector<Fixture> fixtures;
    for (int i = 0; i < 3; ++i) {
      Fixture f = random_fixture(seed, static_cast<int>(seed.below(kFixtureTypes)), 0.9);
      if (std::holds_alternative<model::PlaneShape>(f.shape)) f.shape = model::PlaneShape{Vector3::UnitZ(), seed.uniform(-0.2, 0.1)};
      fixtures.push_back(std::move(f));
    }
    core::SampledMotion motion{seed.chance(0.5) ? random_linear(seed, robot) : random_joint_move(seed, robot, 1.0), 0.01};
    const auto contact = core::first_contact(motion, fixtures, margin);
    const double end = contact ? contact->t : motion.motion().duration();
    std::vector<Capsule> bodies;
    const auto least_at = [&](double t) {
      double least = kNever;
      model::place_capsules(robot.model, robot.X_WB, motion.motion().joints(t), bodies);
      for (std::size_t b = 0; b < bodies.size(); ++b) {
        if (robot.model.capsules[b].link == 0) continue;
        for (const Fixture& f : fixtures) {
          if (model::clearance_lower_bound(bodies[b], f) < least) least = std::min(least, model::clearance(bodies[b], f));
        }
      }
      return least;
    };
    for (double t = 0; t < end; t += kStep) {
      const double least = least_at(t);
      EXPECT_GT(least, margin) << "at " << t << " s of " << motion.motion().duration() << ", found clear before " << end << " s";
      nearest = std::min(nearest, least - margin);
    }
    if (!contact) {
      ++clear;
      continue;
    }
    ++refused;
    // What made it undecided to the last is one finest piece: the body is as near as it can move in it.
    const auto& piece = motion.piece(
        motion.finest(), motion.depth() > 0
                             ? std::min((std::size_t{1} << motion.finest()) - 1,
                                        static_cast<std::size_t>(std::lround(contact->t / motion.motion().duration() *
                                                                             static_cast<double>(std::size_t{1} << motion.finest()))))
                             : 0);
    const double away = core::clearance(piece.bodies[contact->body], fixtures[contact->fixture], kNever) - margin;
    EXPECT_LE(away, piece.reach[contact->body] + 2 * core::kFixtureRounding);
    farthest = std::max(farthest, away);
  }
  std::printf("%zu clear, %zu refused; clear paths came within %.3g m of the margin, refused ones stayed at most %.3g m away\n", clear,
              refused, nearest, farthest);
  EXPECT_GT(clear, scaled(1000) / 20);
  EXPECT_GT(refused, scaled(1000) / 20);
}

}  // namespace
}  // namespace interlace::test
