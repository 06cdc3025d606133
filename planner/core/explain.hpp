#pragma once

#include <optional>
#include <string>

#include "planner/core/shared_zone.hpp"
#include "planner/core/strategy.hpp"

namespace interlace::core {

/// The evidence of one neighbour against starts inside `span`: which links meet, where, how deep, and from when until when starts are
/// forbidden without a gap. Empty when the neighbour forbids nothing there.
[[nodiscard]] std::optional<model::Conflict> explain_conflict(const Candidate& candidate, const Neighbour& neighbour, const TimingMap& map,
                                                              const std::vector<ForbiddenStart>& forbidden, const StartInterval& span);

/// The evidence of a neighbour that holds the shared zone's token against starts inside `span`: the body that would be in the zone first
/// and where, and from when until when. No link of the neighbour is named: it need not be near. Empty when it forbids nothing there.
[[nodiscard]] std::optional<model::Conflict> zone_conflict(const Candidate& candidate, const ZoneVisit& visit, const Neighbour& holder,
                                                           const std::vector<ForbiddenStart>& forbidden, const StartInterval& span);

/// The conflict with a robot that could be anywhere.
[[nodiscard]] model::Conflict lost_conflict(const Candidate& candidate, const Neighbour& neighbour, Instant from);

/// One sentence for people: who waits for whom, which links would meet, until when.
[[nodiscard]] std::string sentence(const model::RobotName& robot, const Assessment& assessment, double delay);

}  // namespace interlace::core
