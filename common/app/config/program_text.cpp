#include "common/app/config/program_text.hpp"

#include <fmt/format.h>

#include <sstream>

#include "common/app/config/number_text.hpp"
#include "common/app/config/quantity.hpp"
#include "common/app/config/text_buffer.hpp"

namespace interlace::app {

namespace {

void write_step(TextBuffer& out, const model::ProgramStep& step, const Units& units, const char* indent = "    ") {
  if (const auto* line = std::get_if<model::LinearTarget>(&step.motion.target)) {
    append(out, "{}- {{move: linear, to: {{xyz: [{}], rpy: [{}]}}", indent, numbers_text(line->X_WT.translation(), units.per_metre),
           numbers_text(model::rpy_of(line->X_WT.linear()), units.per_radian));
  } else {
    append(out, "{}- {{move: joint, to: {{joints: [{}]}}", indent,
           numbers_text(std::get<model::JointTarget>(step.motion.target).q, units.per_radian));
  }
  if (step.motion.velocity) append(out, ", velocity: {}", number_text(*step.motion.velocity, units.per_metre));
  if (step.motion.acceleration) append(out, ", acceleration: {}", number_text(*step.motion.acceleration, units.per_metre));
  if (const auto& tools = step.motion.tools) {
    if (!tools->attach.empty()) append(out, ", attach: {}", tools->attach.str());
    if (!tools->detach.empty()) append(out, ", detach: {}", tools->detach.str());
    if (tools->when == model::ToolTime::start) append(out, ", when: start");
  }
  if (step.priority != 0) append(out, ", priority: {}", step.priority);
  if (step.deadline) append(out, ", deadline: {}", number_text(*step.deadline, 1));
  if (step.at > 0) append(out, ", at: {}", number_text(step.at, 1));
  append(out, "}}\n");
}

void write_event(TextBuffer& out, const model::ProgramEvent& event, const Units& units) {
  const char* what = event.what == model::ProgramEvent::What::hold     ? "hold"
                     : event.what == model::ProgramEvent::What::resume ? "resume"
                     : event.what == model::ProgramEvent::What::cancel ? "cancel"
                                                                       : "replace";
  append(out, "  - at: {}\n    {}: {}\n", number_text(event.at, 1), what, event.robot.str());
  if (event.what == model::ProgramEvent::What::cancel) append(out, "    command: {}\n", event.command);
  if (event.what != model::ProgramEvent::What::replace) return;
  append(out, "    by:{}\n", event.commands.empty() ? " []" : "");
  for (const model::ProgramStep& step : event.commands) write_step(out, step, units, "      ");
}

}  // namespace

std::string program_text(const model::Program& program, const std::string& comment) {
  const Units units;  // mm and deg
  TextBuffer out;
  std::istringstream lines{comment};
  for (std::string line; std::getline(lines, line);) append(out, "# {}\n", line);
  append(out, "interlace: 1\nunits: {{length: {}, angle: {}}}\nprogram:\n", units.length, units.angle);
  for (const auto& [robot, steps] : program.robots) {
    if (steps.empty()) continue;
    append(out, "  {}:\n", robot.str());
    for (const model::ProgramStep& step : steps) write_step(out, step, units);
  }
  if (!program.events.empty()) append(out, "events:\n");
  for (const model::ProgramEvent& event : program.events) write_event(out, event, units);
  return fmt::to_string(out);
}

}  // namespace interlace::app
