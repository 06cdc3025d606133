#include "common/app/config/fingerprint.hpp"

#include <cmath>
#include <string>
#include <string_view>

namespace interlace::app {

namespace {

using model::Joints;
using model::Pose;

/// Writes values as text, one after the other, so that no two different cells write the same.
class Canonical {
 public:
  void text(std::string_view value) { text_ += std::to_string(value.size()).append(":").append(value).append(";"); }
  void number(double value) { text_ += std::to_string(std::llround(value * 1e9)).append(";"); }
  void count(std::size_t value) { text_ += std::to_string(value).append(";"); }
  void maybe(const std::optional<double>& value) {
    count(value ? 1 : 0);
    if (value) number(*value);
  }
  template <typename Vector>
  void numbers(const Vector& values) {
    for (Eigen::Index i = 0; i < values.size(); ++i) number(values[i]);
  }
  void maybe(const std::optional<Joints>& value) {
    count(value ? 1 : 0);
    if (value) numbers(*value);
  }
  void pose(const Pose& X) {
    numbers(model::Vector3{X.translation()});
    for (Eigen::Index i = 0; i < 3; ++i) numbers(model::Vector3{X.linear().col(i)});
  }

  [[nodiscard]] const std::string& str() const { return text_; }

 private:
  std::string text_;
};

void write(const std::vector<model::LinkCapsule>& capsules, Canonical& out) {
  out.count(capsules.size());
  for (const auto& capsule : capsules) {
    out.text(capsule.name);
    out.count(capsule.link);
    out.numbers(capsule.a);
    out.numbers(capsule.b);
    out.number(capsule.radius);
  }
}

void write(const model::RobotModel& model, Canonical& out) {
  const auto& p = model.kinematics.parameters();
  for (const double value : {p.a1, p.a2, p.b, p.c1, p.c2, p.c3, p.c4}) out.number(value);
  for (const double offset : p.offsets) out.number(offset);
  for (const int sign : p.signs) out.number(sign);
  out.numbers(model.joints.min);
  out.numbers(model.joints.max);
  out.maybe(model.joints.velocity);
  out.maybe(model.joints.acceleration);
  out.pose(model.X_FT);
  write(model.capsules, out);
  out.count(model.self_pairs.size());
  for (const auto& [i, j] : model.self_pairs) {
    out.count(i);
    out.count(j);
  }
}

void write(const model::Robot& robot, Canonical& out) {
  out.text(robot.name.str());
  write(robot.model, out);
  out.pose(robot.X_WB);
  out.numbers(robot.start);
  out.numbers(robot.home);
  out.number(robot.tcp.velocity);
  out.number(robot.tcp.acceleration);
  out.maybe(robot.tcp.angular_velocity);
  out.maybe(robot.tcp.angular_acceleration);
  out.number(robot.tcp.slowest);
  out.number(robot.controller.start_latency);
  out.number(robot.controller.start_jitter);
  out.number(robot.controller.speed_error);
  out.number(robot.controller.path_error);
  out.count(robot.holds.size());
  for (const auto& tool : robot.holds) out.text(tool.str());
}

/// After the number of the shape's type.
struct WriteShape {
  Canonical& out;

  void operator()(const model::SphereShape& s) const { out.number(s.radius); }
  void operator()(const model::BoxShape& s) const { out.numbers(s.half); }
  void operator()(const model::CylinderShape& s) const {
    out.number(s.radius);
    out.number(s.half_length);
  }
  void operator()(const model::PlaneShape& s) const {
    out.numbers(s.normal);
    out.number(s.offset);
  }
  void operator()(const model::MeshShape& s) const {
    out.count(s.mesh->solid() ? 1 : 0);
    out.count(s.mesh->triangles().size());
    for (std::size_t i = 0; i < s.mesh->triangles().size(); ++i) {
      for (const model::Vector3& corner : s.mesh->corners(i)) out.numbers(corner);
    }
  }
};

void write(const model::Fixture& fixture, Canonical& out) {
  out.text(fixture.name);
  out.pose(fixture.X_WO);
  out.count(fixture.shape.index());
  std::visit(WriteShape{out}, fixture.shape);
}

std::uint64_t fnv1a(std::string_view text) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const char c : text) {
    hash ^= static_cast<unsigned char>(c);
    hash *= 0x100000001b3U;
  }
  return hash;
}

}  // namespace

std::uint64_t fingerprint(const model::Cell& cell) {
  Canonical out;
  out.text(cell.name);
  out.count(cell.robots.size());
  for (const auto& robot : cell.robots) write(robot, out);
  out.count(cell.fixtures.size());
  for (const auto& fixture : cell.fixtures) write(fixture, out);
  out.count(cell.tools.size());
  for (const auto& tool : cell.tools) {
    out.text(tool.name.str());
    write(tool.capsules, out);
  }
  out.number(cell.planning.resolution);
  out.number(cell.planning.margin);
  out.text(cell.planning.strategy);
  out.count(cell.planning.escapes ? 1 : 0);
  out.maybe(cell.planning.lead);
  out.maybe(cell.planning.start_tolerance);
  out.number(cell.planning.patience);
  out.number(cell.planning.budget);
  out.number(cell.planning.promise);
  out.count(cell.planning.zone ? 1 : 0);
  if (cell.planning.zone) {
    out.numbers(cell.planning.zone->min);
    out.numbers(cell.planning.zone->max);
  }
  return fnv1a(out.str());
}

}  // namespace interlace::app
