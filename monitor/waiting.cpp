#include "monitor/waiting.hpp"

#include <fmt/format.h>

#include "common/app/evidence.hpp"

namespace interlace::monitor {

std::string waiting_sentence(const CommandRecord& record, double zero, double now) {
  const model::CommandStatus& s = record.status;
  const std::string& robot = s.robot.str();
  std::string why;
  for (const model::Conflict& c : s.conflicts) {
    why += (why.empty() ? "" : "; and ") + app::describe(c, model::at_seconds(now - zero));
  }
  if (why.empty()) why = s.text.empty() ? "the planner gives no further explanation" : s.text;
  if (s.state == model::CommandState::scheduled && record.start) {
    return fmt::format("{} starts in {:.1f} s, {:.1f} s later than it could: {}", robot, *record.start - now, s.delay, why);
  }
  const std::string so_far = record.waiting_since ? fmt::format(" for {:.1f} s so far", now - *record.waiting_since) : "";
  if (s.reason == model::Reason::deadlock) {
    return fmt::format("{} waits{} and needs a person: nobody in its way will move by itself and no way out helps: {}", robot, so_far, why);
  }
  if (s.reason == model::Reason::not_ready)
    return fmt::format("{} waits{}: it is not heard from or its controller is not ready", robot, so_far);
  return fmt::format("{} waits{}: {}", robot, so_far, why);
}

}  // namespace interlace::monitor
