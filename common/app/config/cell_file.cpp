#include "common/app/config/cell_file.hpp"

#include <algorithm>
#include <map>

#include "common/app/config/clearance_check.hpp"
#include "common/app/config/document.hpp"
#include "common/app/config/fingerprint.hpp"
#include "common/app/config/fixture_section.hpp"
#include "common/app/config/mesh_file.hpp"
#include "common/app/config/model_section.hpp"
#include "common/app/config/pose_section.hpp"
#include "common/app/config/preamble.hpp"
#include "common/app/config/tool_section.hpp"

namespace interlace::app {

namespace {

constexpr double kLongestPatience = 1e6;  // [s]
constexpr double kLongestWait = 60;       // [s] of latency, lead and tolerance: beyond it a number is a mistake
constexpr double kLargestSpeedError = 0.5;
constexpr double kFinestResolution = 0.0005;  // [s] not included; finer maps cost much and tell nothing
constexpr double kSlowest = 0.1;              // of its speed: slower than that a robot had better wait
constexpr double kLargestBudget = 10;         // [s] of one decision
constexpr double kLongestPromise = 10;        // [s] relied on before a departure
constexpr double kCoarsestResolution = 1;     // [s]

/// Models by name; without a value where the model is there but wrong, so that its robots are not blamed for it.
using Models = std::map<std::string, std::optional<model::RobotModel>>;

Models read_models(const Field& field, const Units& units) {
  Models models;
  const auto mapping = field.mapping({});
  if (!mapping) return models;
  for (const auto& [name, entry] : mapping->entries()) {
    if (!model::is_valid_name(name)) entry.complain("the name of a model is 1 to 64 letters, digits, '_', '-', '.' or ':'");
    models[name] = read_model(name, entry, units);
  }
  if (models.empty()) field.refuse("expected at least one model");
  return models;
}

/// The number under `key`, or `absent`; a finding leaves `absent` too and is seen by the caller in Findings.
double number_or(const Mapping& mapping, const std::string& key, const Quantity& quantity, double absent) {
  const auto field = mapping.find(key);
  return field ? field->number(quantity).value_or(absent) : absent;
}

std::optional<double> optional_number(const Mapping& mapping, const std::string& key, const Quantity& quantity) {
  const auto field = mapping.find(key);
  return field ? field->number(quantity) : std::nullopt;
}

model::TcpLimits read_tcp(const Field& field, const Units& units) {
  model::TcpLimits limits;
  const auto mapping = field.mapping({"velocity", "acceleration", "angular_velocity", "angular_acceleration", "slowest"});
  if (!mapping) return limits;
  Quantity part = ratio(1);
  part.least = kSlowest;
  part.positive = true;
  limits.slowest = number_or(*mapping, "slowest", part, limits.slowest);
  if (const auto velocity = mapping->require("velocity")) limits.velocity = velocity->number(speed(units)).value_or(0);
  if (const auto value = mapping->require("acceleration")) limits.acceleration = value->number(acceleration(units)).value_or(0);
  limits.angular_velocity = optional_number(*mapping, "angular_velocity", angular_speed(units));
  limits.angular_acceleration = optional_number(*mapping, "angular_acceleration", angular_acceleration(units));
  const bool velocity = mapping->find("angular_velocity").has_value();
  const bool both_or_none = velocity == mapping->find("angular_acceleration").has_value();
  if (!both_or_none) field.complain_missing(velocity ? "angular_acceleration" : "angular_velocity");  // one alone gives no time law
  return limits;
}

model::ControllerTraits read_controller(const Field& field, const Units& units) {
  model::ControllerTraits traits;
  const auto mapping = field.mapping({"start_latency", "start_jitter", "speed_error", "path_error"});
  if (!mapping) return traits;
  const Quantity time = seconds(kLongestWait);
  const auto latency = mapping->find("start_latency") ? optional_number(*mapping, "start_latency", time) : 0.0;
  traits.start_latency = latency.value_or(0);
  traits.start_jitter = number_or(*mapping, "start_jitter", time, 0);
  traits.speed_error = number_or(*mapping, "speed_error", ratio(kLargestSpeedError), 0);
  traits.path_error = number_or(*mapping, "path_error", length(units), 0);
  if (latency && traits.start_jitter > *latency) {
    mapping->find("start_jitter")
        ->refuse("expected at most start_latency (" + show(*latency, time) + "): nothing starts before its command");
  }
  return traits;
}

std::optional<model::Box> read_box(const Field& field, const Units& units) {
  const auto mapping = field.mapping({"min", "max"});
  if (!mapping) return std::nullopt;
  const auto min_field = mapping->require("min");
  const auto max_field = mapping->require("max");
  const Quantity place = coordinate(units);
  const auto min = min_field ? min_field->vector(place) : std::nullopt;
  const auto max = max_field ? max_field->vector(place) : std::nullopt;
  if (!min || !max) return std::nullopt;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    if ((*min)[axis] < (*max)[axis]) continue;
    max_field->refuse(std::string{"expected min < max, but "} + "xyz"[axis] + " has " + show((*min)[axis], place) + " and " +
                      show((*max)[axis], place));
    return std::nullopt;
  }
  return model::Box{*min, *max};
}

model::PlanningOptions read_planning(const Field& field, const Units& units) {
  model::PlanningOptions options;
  const auto mapping =
      field.mapping({"resolution", "margin", "strategy", "escapes", "lead", "start_tolerance", "patience", "zone", "budget", "promise"});
  if (!mapping) return options;
  options.margin = number_or(*mapping, "margin", length(units), options.margin);
  options.lead = optional_number(*mapping, "lead", seconds(kLongestWait));
  options.start_tolerance = optional_number(*mapping, "start_tolerance", seconds(kLongestWait));
  options.patience = number_or(*mapping, "patience", seconds(kLongestPatience), options.patience);
  if (const auto resolution = mapping->find("resolution")) {
    const auto value = resolution->number(seconds(kCoarsestResolution));
    if (value && *value <= kFinestResolution) resolution->refuse("expected more than 0.0005 s");
    options.resolution = value.value_or(options.resolution);
  }
  if (const auto strategy = mapping->find("strategy")) {
    const auto index = strategy->one_of(strategy_names());
    if (index) options.strategy = strategy_names()[*index];
  }
  if (const auto escapes = mapping->find("escapes")) options.escapes = escapes->one_of({"true", "false"}).value_or(0) == 0;
  options.budget = number_or(*mapping, "budget", seconds(kLargestBudget), options.budget);
  options.promise = number_or(*mapping, "promise", seconds(kLongestPromise), options.promise);
  if (const auto zone = mapping->find("zone")) options.zone = read_box(*zone, units);
  return options;
}

const model::RobotModel* model_of(const Mapping& mapping, const Models& models) {
  const auto field = mapping.require("model");
  const auto name = field ? field->text() : std::nullopt;
  if (!name) return nullptr;
  const auto found = models.find(*name);
  if (found != models.end()) return found->second ? &*found->second : nullptr;
  std::vector<std::string> names;
  for (const auto& entry : models) names.push_back(entry.first);
  field->refuse("unknown model, expected one of those under models" + did_you_mean(*name, names));
  return nullptr;
}

/// Robots' names read so far and the keys of the robots that have them.
using Names = std::map<std::string, std::string>;

model::RobotName read_name(const Field& field, const std::string& robot_key, Names& names) {
  const auto text = field.name();
  if (!text) return {};
  const auto [entry, fresh] = names.emplace(*text, robot_key);
  if (!fresh) field.refuse("expected a name of its own: " + entry->second + " has it already");
  return model::RobotName{*text};
}

using Tools = std::vector<model::Tool>;

std::optional<PlacedRobot> read_robot(const Field& field, const Models& models, const Tools& tools, const Units& units, Names& names) {
  const auto mapping = field.mapping({"name", "model", "base", "start", "home", "tcp", "controller", "holds"});
  if (!mapping) return std::nullopt;
  model::Robot robot;
  if (const auto name = mapping->require("name")) robot.name = read_name(*name, field.key(), names);
  if (const auto tcp = mapping->require("tcp")) robot.tcp = read_tcp(*tcp, units);
  if (const auto controller = mapping->find("controller")) robot.controller = read_controller(*controller, units);
  if (const auto holds = mapping->find("holds")) robot.holds = read_held(*holds, tools);
  const auto base = mapping->require("base");
  const auto start = mapping->require("start");
  const auto X_WB = base ? read_pose(*base, units) : std::nullopt;
  const auto* model = model_of(*mapping, models);
  if (!X_WB || !model || !start) return std::nullopt;
  robot.model = *model;
  robot.X_WB = *X_WB;
  const auto q_start = read_posture(*start, *model, *X_WB, units);
  const auto home = mapping->find("home");
  const auto q_home = home ? read_posture(*home, *model, *X_WB, units) : q_start;
  if (!q_start || !q_home) return std::nullopt;
  robot.start = *q_start;
  robot.home = *q_home;
  return PlacedRobot{std::move(robot), *start, home.value_or(*start)};
}

std::vector<PlacedRobot> read_robots(const Field& field, const Models& models, const Tools& tools, const Units& units) {
  std::vector<PlacedRobot> robots;
  const auto items = field.items("robots");
  if (!items) return robots;
  if (items->empty() || items->size() > kMaxRobots) {
    field.refuse("expected 1 to " + std::to_string(kMaxRobots) + " robots");
    return robots;
  }
  Names names;
  for (const auto& item : *items) {
    auto robot = read_robot(item, models, tools, units, names);
    if (robot) robots.push_back(std::move(*robot));
  }
  return robots;
}

model::Cell read_cell(const YAML::Node& document, const std::string& file_name, const MeshReader& meshes, Findings& findings) {
  model::Cell cell;
  const auto file =
      Field{document, "", findings}.mapping({"interlace", "units", "cell", "models", "tools", "robots", "fixtures", "planning"});
  if (!file) return cell;
  const Units units = read_preamble(*file);
  if (const auto name = file->require("cell")) cell.name = name->name().value_or("");
  const auto models_field = file->require("models");
  const Models models = models_field ? read_models(*models_field, units) : Models{};
  if (const auto tools = file->find("tools")) cell.tools = read_tools(*tools, units);
  const auto robots_field = file->require("robots");
  const auto robots = robots_field ? read_robots(*robots_field, models, cell.tools, units) : std::vector<PlacedRobot>{};
  if (const auto fixtures = file->find("fixtures")) cell.fixtures = read_fixtures(*fixtures, units, file_name, meshes);
  if (const auto planning = file->find("planning")) cell.planning = read_planning(*planning, units);
  // With anything else in doubt, units above all, collisions found now could mislead.
  if (findings.none()) check_clearances(robots, cell.tools, cell.fixtures, cell.planning.margin, units);
  for (const auto& placed : robots) cell.robots.push_back(placed.robot);
  return cell;
}

}  // namespace

const std::vector<std::string>& strategy_names() {
  static const std::vector<std::string> names{"direct", "zone", "eef-map", "acm", "event", "lookahead"};
  return names;
}

model::Result<LoadedCell, ConfigError> parse_cell(const std::string& text, const std::string& file_name, const MeshReader& meshes) {
  Findings findings{file_name};
  const auto document = parse_document(text, findings);
  if (!document) return model::unexpected{findings.error()};
  LoadedCell loaded;
  loaded.cell = read_cell(*document, file_name, meshes, findings);
  if (!findings.none()) return model::unexpected{findings.error()};
  loaded.fingerprint = fingerprint(loaded.cell);
  return loaded;
}

model::Result<LoadedCell, ConfigError> load_cell(const std::string& path) {
  Findings findings{path};
  const auto text = read_file(path, findings);
  if (!text) return model::unexpected{findings.error()};
  return parse_cell(*text, path, read_mesh_file);
}

}  // namespace interlace::app
