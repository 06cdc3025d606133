#include "common/app/config/program_file.hpp"

#include <algorithm>

#include "common/app/config/document.hpp"
#include "common/app/config/pose_section.hpp"
#include "common/app/config/preamble.hpp"
#include "common/app/config/tool_section.hpp"

namespace interlace::app {

namespace {

using Names = std::vector<model::RobotName>;
using Tools = std::vector<model::Tool>;
using model::Program;
using model::ProgramStep;

constexpr int kLargestPriority = 1'000'000;
constexpr double kLatestRelease = 1e6;   // [s]
constexpr double kLatestDeadline = 1e7;  // [s]

std::optional<model::Target> read_target(const Mapping& step, const Units& units) {
  const auto move = step.require("move");
  const auto to = step.require("to");
  const auto kind = move ? move->one_of({"linear", "joint"}) : std::nullopt;
  if (!kind || !to) return std::nullopt;
  if (*kind == 0) {
    const auto X_WT = read_pose(*to, units);
    return X_WT ? std::optional<model::Target>{model::LinearTarget{*X_WT}} : std::nullopt;
  }
  const auto mapping = to->mapping({"joints"});
  const auto joints = mapping ? mapping->require("joints") : std::nullopt;
  const auto q = joints ? joints->joints(angle(units)) : std::nullopt;
  return q ? std::optional<model::Target>{model::JointTarget{*q}} : std::nullopt;
}

/// A step with findings comes back incomplete; the caller sees the findings.
ProgramStep read_step(const Field& field, const Tools* tools, const Units& units) {
  ProgramStep step;
  const auto mapping = field.mapping({"move", "to", "velocity", "acceleration", "priority", "deadline", "at", "attach", "detach", "when"});
  if (!mapping) return step;
  step.motion.target = read_target(*mapping, units).value_or(model::Target{});
  if (const auto velocity = mapping->find("velocity")) step.motion.velocity = velocity->number(speed(units));
  if (const auto value = mapping->find("acceleration")) step.motion.acceleration = value->number(acceleration(units));
  step.motion.tools = read_tool_change(*mapping, tools);
  if (const auto priority = mapping->find("priority")) step.priority = priority->integer(-kLargestPriority, kLargestPriority).value_or(0);
  if (const auto at = mapping->find("at")) step.at = at->number(seconds(kLatestRelease)).value_or(0);
  if (const auto deadline = mapping->find("deadline")) step.deadline = deadline->number(seconds(kLatestDeadline));
  return step;
}

std::vector<ProgramStep> read_replacement(const Field& field, const Tools* tools, const Units& units) {
  std::vector<ProgramStep> steps;
  const auto items = field.items("commands");
  if (!items) return steps;
  for (const auto& item : *items) {
    steps.push_back(read_step(item, tools, units));
    if (steps.back().at > 0) item.complain("a command of a replacement is released with it: `at` is the event's");
  }
  return steps;
}

void check_robot(const std::string& name, const Field& entry, const Names* robots) {
  if (!model::is_valid_name(name)) entry.complain("the name of a robot is 1 to 64 letters, digits, '_', '-', '.' or ':'");
  if (!robots || std::find(robots->begin(), robots->end(), model::RobotName{name}) != robots->end()) return;
  std::vector<std::string> names;
  for (const auto& robot : *robots) names.push_back(robot.str());
  entry.complain("unknown robot \"" + name.substr(0, model::kMaxNameLength) + "\", the cell has " + listed(names) +
                 did_you_mean(name, names));
}

Program read_robots(const Field& field, const Names* robots, const Tools* tools, const Units& units) {
  Program program;
  const auto mapping = field.mapping({});
  if (!mapping) return program;
  for (const auto& [name, entry] : mapping->entries()) {
    check_robot(name, entry, robots);
    auto& steps = program.robots.emplace_back(model::RobotName{name}, std::vector<ProgramStep>{}).second;
    const auto items = entry.items("commands");
    if (!items) continue;
    for (const auto& item : *items) steps.push_back(read_step(item, tools, units));
  }
  return program;
}

using What = model::ProgramEvent::What;

/// What happens is the key that names the robot: `{at: 5, hold: r1}`.
void read_event(const Field& field, const Names* robots, const Tools* tools, const Units& units, Program& program) {
  static const std::vector<std::pair<std::string, What>> kWhat{
      {"hold", What::hold}, {"resume", What::resume}, {"cancel", What::cancel}, {"replace", What::replace}};
  const auto mapping = field.mapping({"at", "hold", "resume", "cancel", "command", "replace", "by"});
  if (!mapping) return;
  model::ProgramEvent event;
  const auto at = mapping->require("at");
  if (at) event.at = at->number(seconds(kLatestRelease)).value_or(0);
  int found = 0;
  for (const auto& [key, what] : kWhat) {
    const auto robot = mapping->find(key);
    if (!robot) continue;
    ++found;
    event.what = what;
    const auto name = robot->name();
    if (!name) continue;
    event.robot = model::RobotName{*name};
    check_robot(*name, *robot, robots);
  }
  if (found != 1) field.complain("expected one of hold, resume, cancel and replace, with the name of a robot");
  const auto command = event.what == What::cancel ? mapping->require("command") : mapping->find("command");
  if (command && event.what != What::cancel) command->complain("only `cancel` has it");
  if (command) event.command = static_cast<std::size_t>(command->integer(1, kMaxProgramSize).value_or(1));
  const auto by = event.what == What::replace ? mapping->require("by") : mapping->find("by");
  if (by && event.what != What::replace) by->complain("only `replace` has it");
  if (by) event.commands = read_replacement(*by, tools, units);
  program.events.push_back(std::move(event));
}

void read_events(const Field& field, const Names* robots, const Tools* tools, const Units& units, Program& program) {
  const auto items = field.items("events");
  if (!items) return;
  for (const auto& item : *items) read_event(item, robots, tools, units, program);
  std::stable_sort(program.events.begin(), program.events.end(), [](const auto& a, const auto& b) { return a.at < b.at; });
}

void unroll(Program& program, int repeat) {
  for (auto& entry : program.robots) {
    auto& steps = entry.second;
    const std::size_t once = steps.size();
    steps.reserve(once * static_cast<std::size_t>(repeat));
    for (std::size_t i = once; i < once * static_cast<std::size_t>(repeat); ++i) steps.push_back(steps[i - once]);
  }
}

Program read_program(const YAML::Node& document, const Names* robots, const Tools* tools, Findings& findings) {
  const auto file = Field{document, "", findings}.mapping({"interlace", "units", "repeat", "program", "events"});
  if (!file) return {};
  const Units units = read_preamble(*file);
  const auto repeat_field = file->find("repeat");
  const int repeat = repeat_field ? repeat_field->integer(1, kMaxProgramSize).value_or(1) : 1;
  const auto field = file->require("program");
  if (!field) return {};
  Program program = read_robots(*field, robots, tools, units);
  if (const auto events = file->find("events")) read_events(*events, robots, tools, units, program);
  if (!findings.none()) return program;
  if (program.size() == 0) field->refuse("empty program: expected at least one command");
  if (program.size() * static_cast<std::size_t>(repeat) > static_cast<std::size_t>(kMaxProgramSize)) {
    repeat_field.value_or(*field).refuse("expected at most " + std::to_string(kMaxProgramSize) + " commands in all");
    return program;
  }
  unroll(program, repeat);
  return program;
}

model::Result<Program, ConfigError> parse(const std::string& text, const std::string& file_name, const Names* robots, const Tools* tools) {
  Findings findings{file_name};
  const auto document = parse_document(text, findings);
  if (!document) return model::unexpected{findings.error()};
  Program program = read_program(*document, robots, tools, findings);
  if (!findings.none()) return model::unexpected{findings.error()};
  return program;
}

Names names_of(const model::Cell& cell) {
  Names names;
  for (const auto& robot : cell.robots) names.push_back(robot.name);
  return names;
}

}  // namespace

model::Result<Program, ConfigError> parse_program(const std::string& text, const std::string& file_name, const Names& robots) {
  return parse(text, file_name, &robots, nullptr);
}

model::Result<Program, ConfigError> parse_program(const std::string& text, const std::string& file_name, const model::Cell* cell) {
  if (!cell) return parse(text, file_name, nullptr, nullptr);
  const Names robots = names_of(*cell);
  return parse(text, file_name, &robots, &cell->tools);
}

model::Result<Program, ConfigError> load_program(const std::string& path, const Names& robots) {
  Findings findings{path};
  const auto text = read_file(path, findings);
  if (!text) return model::unexpected{findings.error()};
  return parse_program(*text, path, robots);
}

model::Result<Program, ConfigError> load_program(const std::string& path, const model::Cell* cell) {
  Findings findings{path};
  const auto text = read_file(path, findings);
  if (!text) return model::unexpected{findings.error()};
  return parse_program(*text, path, cell);
}

}  // namespace interlace::app
