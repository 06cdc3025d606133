#include "recording/replay.hpp"

#include <fmt/format.h>

#include "planner/core/journal.hpp"

namespace interlace::recording {
namespace {

/// What the planner was told, in a few words.
struct Told {
  std::string operator()(const model::ClientRequest& request) const {
    return std::visit([](const auto& r) { return fmt::format("request {} for {}", r.id.str(), r.robot.str()); }, request);
  }
  std::string operator()(const model::PostureReported& p) const { return fmt::format("posture of {}", p.robot.str()); }
  std::string operator()(const model::ExecutionReported& e) const {
    return fmt::format("{} {} by {}", e.id.str(), to_string(e.state), e.robot.str());
  }
  std::string operator()(const model::TimePassed& /*nothing*/) const { return "time passed"; }
};

std::string decided(const core::Decisions& d) {
  std::string text;
  const auto add = [&](const std::string& part) { text += (text.empty() ? "" : "; ") + part; };
  for (const auto& w : d.withdrawals) add(fmt::format("withdraw {} from {}", w.id.str(), w.robot.str()));
  for (const auto& x : d.dispatches) add(fmt::format("dispatch {} to {} for {:.6f} s", x.id.str(), x.robot.str(), to_seconds(x.earliest)));
  for (const auto& s : d.statuses) add(fmt::format("{} {} {}", s.id.str(), to_string(s.state), s.text));
  return text.empty() ? "nothing" : text;
}

}  // namespace

Replay replay(const std::shared_ptr<const model::Cell>& cell, const PlannerLife& life) {
  core::Planner planner{cell, core::options_of(life.settings)};
  Replay result;
  for (const model::PlannerCall& call : life.calls) {
    const core::Decisions decisions = core::apply(planner, call.event, call.now);
    const model::DecisionDigest digest = core::digest_of(decisions);
    if (digest != call.decided) {
      result.difference = Difference{result.calls, call.now, std::visit(Told{}, call.event), call.decided, digest, decided(decisions)};
      return result;
    }
    ++result.calls;
    result.decisions += std::uint64_t{digest.dispatches} + digest.withdrawals + digest.statuses;
  }
  return result;
}

}  // namespace interlace::recording
