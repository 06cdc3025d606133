#include "common/app/config/tool_section.hpp"

#include <algorithm>

#include "common/app/config/capsule_section.hpp"

namespace interlace::app {

namespace {

constexpr std::size_t kMostCapsules = 16;  // of one tool
constexpr std::size_t kFlange = 6;         // link

std::vector<std::string> names_of(const std::vector<model::Tool>& tools) {
  std::vector<std::string> names;
  names.reserve(tools.size());
  for (const auto& tool : tools) names.push_back(tool.name.str());
  return names;
}

std::optional<model::LinkCapsule> read_capsule(const Field& field, const std::string& tool, const Units& units) {
  const auto mapping = field.mapping({"from", "to", "radius"});
  if (!mapping) return std::nullopt;
  const auto shape = read_capsule_shape(*mapping, units);
  if (!shape) return std::nullopt;
  return model::LinkCapsule{tool, kFlange, shape->a, shape->b, shape->radius};
}

model::Tool read_tool(const std::string& name, const Field& field, const Units& units) {
  model::Tool tool{model::ToolName{name}, {}};
  const auto mapping = field.mapping({"capsules"});
  const auto capsules = mapping ? mapping->require("capsules") : std::nullopt;
  const auto items = capsules ? capsules->items("capsules") : std::nullopt;
  if (!items) return tool;
  if (items->empty() || items->size() > kMostCapsules) {
    capsules->refuse("expected 1 to " + std::to_string(kMostCapsules) + " capsules");
    return tool;
  }
  for (const auto& item : *items) {
    if (auto capsule = read_capsule(item, name, units)) tool.capsules.push_back(std::move(*capsule));
  }
  return tool;
}

/// A name of a tool; with `known`, one of those.
model::ToolName read_name(const Field& field, const std::vector<std::string>* known) {
  if (!known) return model::ToolName{field.name().value_or("")};
  if (known->empty()) {
    field.refuse("the cell has no tools");
    return {};
  }
  const auto index = field.one_of(*known);
  return index ? model::ToolName{(*known)[*index]} : model::ToolName{};
}

}  // namespace

std::vector<model::Tool> read_tools(const Field& field, const Units& units) {
  std::vector<model::Tool> tools;
  const auto mapping = field.mapping({});
  if (!mapping) return tools;
  for (const auto& [name, entry] : mapping->entries()) {
    if (!model::is_valid_name(name)) entry.complain("the name of a tool is 1 to 64 letters, digits, '_', '-', '.' or ':'");
    tools.push_back(read_tool(name, entry, units));
  }
  if (tools.size() > model::kMaxTools) {
    field.complain("expected at most " + std::to_string(model::kMaxTools) + " tools");
    tools.resize(model::kMaxTools);
  }
  return tools;
}

std::vector<model::ToolName> read_held(const Field& field, const std::vector<model::Tool>& tools) {
  std::vector<model::ToolName> held;
  const auto items = field.items("names of tools");
  if (!items) return held;
  const auto known = names_of(tools);
  for (const auto& item : *items) {
    const auto name = read_name(item, &known);
    if (name.empty()) continue;
    if (std::find(held.begin(), held.end(), name) != held.end()) item.complain("\"" + name.str() + "\" is in the hand already");
    held.push_back(name);
  }
  return held;
}

std::optional<model::ToolChange> read_tool_change(const Mapping& command, const std::vector<model::Tool>* tools) {
  const auto attach = command.find("attach");
  const auto detach = command.find("detach");
  const auto when = command.find("when");
  if (!attach && !detach) {
    if (when) when->complain("says when a tool is taken or left, but there is neither attach nor detach");
    return std::nullopt;
  }
  const auto known = tools ? std::optional{names_of(*tools)} : std::nullopt;
  model::ToolChange change;
  if (attach) change.attach = read_name(*attach, known ? &*known : nullptr);
  if (detach) change.detach = read_name(*detach, known ? &*known : nullptr);
  if (attach && detach && !change.attach.empty() && change.attach == change.detach) attach->refuse("expected another tool than detach has");
  if (when) change.when = when->one_of({"start", "completion"}).value_or(1) == 0 ? model::ToolTime::start : model::ToolTime::completion;
  return change;
}

}  // namespace interlace::app
