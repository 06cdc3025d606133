#pragma once

#include "tests/support/motions.hpp"

namespace interlace::test {

/// The arms of the experiments, r3 far from the two others. r2 is a turnstile: it can turn about its base, and its other joints leave it
/// `slack` [deg] around where they are. So it gets out of r1's way by a joint move alone: no straight line along an axis goes far enough.
/// r2 starts aside. Its home is in the way: who is sent there stays in it, and the cell is not well-formed.
struct Turnstile {
  explicit Turnstile(double slack) : cell(experiment_cell(true)) {
    model::Robot& r2 = cell->robots[1];
    give_joint_rates(r2, 1.0, 2.0);
    aside = r2.start;
    aside[0] = -40 * kPi / 180;
    in_the_way = aside;
    in_the_way[0] = 40 * kPi / 180;
    r2.model.joints.min = r2.start - model::Joints::Constant(slack * kPi / 180);
    r2.model.joints.max = r2.start + model::Joints::Constant(slack * kPi / 180);
    r2.model.joints.min[0] = -kPi;
    r2.model.joints.max[0] = kPi;
    r2.start = aside;
    r2.home = in_the_way;
  }
  /// r1's command, for which r2 must not stand in the way.
  [[nodiscard]] static model::MotionRequest across() { return line_to(pose_mm(400, 0, 300)); }

  std::shared_ptr<model::Cell> cell;
  model::Joints aside, in_the_way;  ///< of r2 [rad]
};

}  // namespace interlace::test
