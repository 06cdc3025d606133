#pragma once

#include <utility>
#include <vector>

#include "common/model/kinematics.hpp"
#include "tests/support/shapes.hpp"

/// A small industrial arm as its data sheet draws it: the published axis distances of a 3 kg machine (290, 270, 302, 72 mm, elbow offset
/// 70 mm), its links made of cylinders and boxes of about the size of its castings.
namespace interlace::test {

inline model::OpwParameters small_arm_parameters() {
  model::OpwParameters p;
  p.a2 = -0.070;
  p.c1 = 0.290;
  p.c2 = 0.270;
  p.c3 = 0.302;
  p.c4 = 0.072;
  p.offsets = {0, 0, -model::kPi / 2, 0, 0, 0};
  return p;
}

/// A box from `low` to `high` [m].
inline Mesh block(const Vector3& low, const Vector3& high) {
  return moved(box(high - low), model::make_pose((low + high) / 2, model::Quaternion::Identity()));
}

/// A cylinder about z that stands on z = `low` [m].
inline Mesh upright(double radius, double low, double high) {
  return moved(cylinder(radius, high - low), model::make_pose({0, 0, low}, model::Quaternion::Identity()));
}

/// A cylinder about the joint's axis, the y through (0, 0, z), `width` long [m].
inline Mesh hinge(double radius, double width, double z) {
  return moved(cylinder(radius, width), model::make_pose({0, width / 2, z}, model::rotation_from_rpy({model::kPi / 2, 0, 0})));
}

/// Links 0 … 6 and their shapes, each in its link's frame.
inline std::vector<std::pair<int, Mesh>> small_arm_shapes() {
  return {{0, together(block({-0.09, -0.09, 0}, {0.09, 0.09, 0.04}), upright(0.085, 0.04, 0.166))},
          {1, together(upright(0.085, 0.166, 0.215), hinge(0.075, 0.19, 0.290))},
          {2, together(together(hinge(0.07, 0.11, 0), block({-0.05, -0.055, 0.07}, {0.05, 0.055, 0.205})), hinge(0.065, 0.11, 0.270))},
          {3, block({-0.13, -0.055, -0.055}, {0.05, 0.055, 0.10})},
          {4, together(upright(0.045, -0.2, -0.07), together(block({-0.035, -0.055, -0.07}, {0.035, -0.035, 0.02}),
                                                             block({-0.035, 0.035, -0.07}, {0.035, 0.055, 0.02})))},
          {5, together(hinge(0.034, 0.066, 0), upright(0.03, 0.034, 0.055))},
          {6, upright(0.025, -0.015, 0)}};
}

}  // namespace interlace::test
