#include "simulator/reproduce/campaign.hpp"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "simulator/reproduce/markdown.hpp"

namespace interlace::reproduce {

namespace {

using nlohmann::json;

/// The number under the first of `keys` that has one.
std::optional<double> value(const json& object, std::initializer_list<const char*> keys) {
  for (const char* key : keys) {
    const auto found = object.find(key);
    if (found != object.end() && found->is_number()) return found->get<double>();
  }
  return std::nullopt;
}

std::string text_of(const json& object, std::initializer_list<const char*> keys, const std::string& otherwise) {
  for (const char* key : keys) {
    const auto found = object.find(key);
    if (found != object.end() && found->is_string()) return found->get<std::string>();
  }
  return otherwise;
}

/// What the objects around a row say for it.
struct Surroundings {
  std::string cell, strategy;
};

CampaignRow row_of(const json& object, const Surroundings& around) {
  CampaignRow row;
  row.cell = around.cell;
  row.strategy = around.strategy;
  row.commands = value(object, {"commands", "submitted"});
  row.completed = value(object, {"completed"});
  row.unserved = value(object, {"unserved"});
  row.lost = value(object, {"lost"});
  row.escapes = value(object, {"escapes"});
  row.warnings = value(object, {"warnings"});
  row.collisions = value(object, {"collisions"});
  row.least_clearance = value(object, {"least_clearance_m", "min_clearance_m"});
  if (const auto nearest = object.find("nearest"); !row.least_clearance && nearest != object.end() && nearest->is_object())
    row.least_clearance = value(*nearest, {"clearance_m"});
  row.virtual_time = value(object, {"virtual_s"});
  row.real_time = value(object, {"real_s"});
  return row;
}

/// Keys that group rows without naming a cell.
bool is_plain_heading(const std::string& key) {
  for (const char* heading : {"campaign", "cells", "patterns", "results", "rows", "runs", "strategies"}) {
    if (key == heading) return true;
  }
  return false;
}

void collect(const json& node, const Surroundings& around, std::vector<CampaignRow>& rows) {
  if (node.is_array()) {
    for (const json& item : node) collect(item, around, rows);
  } else if (node.is_object()) {
    const Surroundings here{text_of(node, {"cell", "pattern"}, around.cell), text_of(node, {"strategy"}, around.strategy)};
    if (value(node, {"completed"})) {
      rows.push_back(row_of(node, here));
      return;
    }
    for (const auto& [key, item] : node.items()) {
      Surroundings inside = here;
      if (inside.cell.empty() && !is_plain_heading(key)) inside.cell = key;
      collect(item, inside, rows);
    }
  }
}

std::string or_dash(const std::string& text) {
  return text.empty() ? "–" : text;
}

std::string whole(const std::optional<double>& v) {
  return v ? fmt::format("{:.0f}", *v) : "–";
}

}  // namespace

model::Result<Campaign, std::string> parse_campaign(const std::string& text, const std::string& file_name) {
  const json root = json::parse(text, nullptr, false);
  if (root.is_discarded()) return model::unexpected<std::string>{file_name + ": not JSON, expected a report of interlace-campaign"};
  Campaign campaign;
  campaign.file = file_name.substr(file_name.find_last_of('/') + 1);
  if (root.is_object()) campaign.per_robot = value(root, {"per_robot"});
  collect(root, {}, campaign.rows);
  if (campaign.rows.empty())
    return model::unexpected<std::string>{file_name + ": found no object with \"completed\", expected a report of interlace-campaign"};
  return campaign;
}

model::Result<Campaign, std::string> load_campaign(const std::string& path) {
  std::ifstream in{path};
  const std::string text{std::istreambuf_iterator<char>{in}, {}};
  if (!in) return model::unexpected<std::string>{path + ": cannot be read"};
  return parse_campaign(text, path);
}

std::string campaign_table(const Campaign& campaign) {
  std::vector<std::vector<std::string>> cells;
  for (const CampaignRow& r : campaign.rows) {
    cells.push_back({or_dash(r.cell), r.strategy.empty() ? "–" : fmt::format("`{}`", r.strategy), whole(r.commands), whole(r.completed),
                     whole(r.unserved), whole(r.lost), whole(r.escapes), whole(r.warnings), whole(r.collisions),
                     r.least_clearance ? fmt::format("{:.2f}", 1000 * *r.least_clearance) : "–", whole(r.virtual_time),
                     whole(r.real_time)});
  }
  return markdown_table({"cell", "strategy", "commands", "completed", "unserved", "lost", "escapes", "warnings", "collisions",
                         "least clearance [mm]", "virtual time [s]", "real time [s]"},
                        cells);
}

std::string campaign_command(const Campaign& campaign) {
  std::string text = "interlace-campaign --cells";
  std::string strategy;
  double commands = 0;
  for (const CampaignRow& r : campaign.rows) {
    text += fmt::format(" deploy/cells/{}", r.cell);
    commands += r.commands.value_or(0);
    strategy = r.strategy;
  }
  text += fmt::format(" --commands {:.0f}", commands);
  if (campaign.per_robot) text += fmt::format(" --per-robot {:.0f}", *campaign.per_robot);
  return text + fmt::format(" --strategy {} --report {}", strategy, campaign.file);
}

}  // namespace interlace::reproduce
