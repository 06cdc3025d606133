#pragma once

#include <optional>
#include <vector>

#include "planner/core/escape.hpp"

namespace interlace::core {

/// One robot goes somewhere while all around it stand.
struct UntangleStep {
  model::RobotIndex robot = 0;
  model::EscapeWay way = model::EscapeWay::home;
  model::MotionRequest request;
};

/// Steps, one robot after the other, after which `served`, made from `request`, has a start; empty when there are none among the places
/// each robot knows: back along the path it came, home, and out in six directions from where it stands. Robots that are not in `around` or
/// cannot be sent anywhere stay as they are seen. The last resort: best-first over the places of all robots together, so that it finds an
/// order in which a tangle of many comes apart where each by itself is stuck. Deterministic; work is bounded.
/// Pure. Nothing of it is in the dissertation, which gives such a cell up to people.
[[nodiscard]] std::optional<std::vector<UntangleStep>> untangle(const model::Cell& cell, const Neighbourhood& neighbourhood,
                                                                const std::vector<EscapeView>& views,
                                                                const std::vector<model::RobotIndex>& around, const Candidate& served,
                                                                const model::MotionRequest& request, const Strategy& strategy,
                                                                const Timing& timing, MapStore& maps);

}  // namespace interlace::core
