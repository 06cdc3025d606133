#include "common/app/config/program_text.hpp"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <sstream>

#include "common/app/config/quantity.hpp"

namespace interlace::app {

namespace {

using Text = fmt::memory_buffer;

template <typename... Args>
void append(Text& out, fmt::format_string<Args...> format, Args&&... args) {
  fmt::format_to(std::back_inserter(out), format, std::forward<Args>(args)...);
}

/// A number in the file's units: what twelve digits cannot tell from zero is zero, and zero has no sign.
std::string number(double value, double per_si) {
  constexpr double kNothing = 1e-10;
  const double shown = value * per_si;
  return fmt::format("{:.12g}", std::abs(shown) < kNothing ? 0.0 : shown);
}

template <typename Values>
std::string list(const Values& values, double per_si) {
  std::string text;
  for (Eigen::Index i = 0; i < values.size(); ++i) text += (i > 0 ? ", " : "") + number(values[i], per_si);
  return text;
}

void write_step(Text& out, const model::ProgramStep& step, const Units& units) {
  if (const auto* line = std::get_if<model::LinearTarget>(&step.motion.target)) {
    append(out, "    - {{move: linear, to: {{xyz: [{}], rpy: [{}]}}", list(line->X_WT.translation(), units.per_metre),
           list(model::rpy_of(line->X_WT.linear()), units.per_radian));
  } else {
    append(out, "    - {{move: joint, to: {{joints: [{}]}}", list(std::get<model::JointTarget>(step.motion.target).q, units.per_radian));
  }
  if (step.motion.velocity) append(out, ", velocity: {}", number(*step.motion.velocity, units.per_metre));
  if (step.motion.acceleration) append(out, ", acceleration: {}", number(*step.motion.acceleration, units.per_metre));
  if (const auto& tools = step.motion.tools) {
    if (!tools->attach.empty()) append(out, ", attach: {}", tools->attach.str());
    if (!tools->detach.empty()) append(out, ", detach: {}", tools->detach.str());
    if (tools->when == model::ToolTime::start) append(out, ", when: start");
  }
  if (step.priority != 0) append(out, ", priority: {}", step.priority);
  if (step.at > 0) append(out, ", at: {}", number(step.at, 1));
  append(out, "}}\n");
}

}  // namespace

std::string program_text(const model::Program& program, const std::string& comment) {
  const Units units;  // mm and deg
  Text out;
  std::istringstream lines{comment};
  for (std::string line; std::getline(lines, line);) append(out, "# {}\n", line);
  append(out, "interlace: 1\nunits: {{length: {}, angle: {}}}\nprogram:\n", units.length, units.angle);
  for (const auto& [robot, steps] : program.robots) {
    if (steps.empty()) continue;
    append(out, "  {}:\n", robot.str());
    for (const model::ProgramStep& step : steps) write_step(out, step, units);
  }
  return fmt::to_string(out);
}

}  // namespace interlace::app
