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

CampaignRow row_of(const json& object, const std::string& cell) {
  CampaignRow row;
  row.cell = cell;
  row.strategy = object.at("strategy").get<std::string>();
  row.commands = value(object, {"commands", "submitted"});
  row.completed = value(object, {"completed"});
  row.unserved = value(object, {"unserved"});
  row.lost = value(object, {"lost"});
  row.escapes = value(object, {"escapes"});
  row.warnings = value(object, {"warnings"});
  row.collisions = value(object, {"collisions"});
  row.least_clearance = value(object, {"least_clearance_m", "min_clearance_m"});
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

void collect(const json& node, const std::string& cell, std::vector<CampaignRow>& rows) {
  if (node.is_array()) {
    for (const json& item : node) collect(item, cell, rows);
  } else if (node.is_object()) {
    const std::string here = text_of(node, {"cell", "pattern"}, cell);
    const auto strategy = node.find("strategy");
    if (strategy != node.end() && strategy->is_string() && node.contains("completed")) {
      rows.push_back(row_of(node, here));
      return;
    }
    for (const auto& [key, item] : node.items()) collect(item, here.empty() && !is_plain_heading(key) ? key : here, rows);
  }
}

std::string whole(const std::optional<double>& v) {
  return v ? fmt::format("{:.0f}", *v) : "–";
}

}  // namespace

model::Result<std::vector<CampaignRow>, std::string> parse_campaign(const std::string& text, const std::string& file_name) {
  const json root = json::parse(text, nullptr, false);
  if (root.is_discarded()) return model::unexpected<std::string>{file_name + ": not JSON, expected a report of interlace-campaign"};
  std::vector<CampaignRow> rows;
  collect(root, "", rows);
  if (rows.empty())
    return model::unexpected<std::string>{file_name +
                                          ": found no object with \"strategy\" and \"completed\", expected a report of "
                                          "interlace-campaign"};
  return rows;
}

model::Result<std::vector<CampaignRow>, std::string> load_campaign(const std::string& path) {
  std::ifstream in{path};
  const std::string text{std::istreambuf_iterator<char>{in}, {}};
  if (!in) return model::unexpected<std::string>{path + ": cannot be read"};
  return parse_campaign(text, path);
}

std::string campaign_table(const std::vector<CampaignRow>& rows) {
  std::vector<std::vector<std::string>> cells;
  for (const CampaignRow& r : rows) {
    cells.push_back({r.cell.empty() ? "–" : r.cell, fmt::format("`{}`", r.strategy), whole(r.commands), whole(r.completed),
                     whole(r.unserved), whole(r.lost), whole(r.escapes), whole(r.warnings), whole(r.collisions),
                     r.least_clearance ? fmt::format("{:.1f}", 1000 * *r.least_clearance) : "–", whole(r.virtual_time),
                     whole(r.real_time)});
  }
  return markdown_table({"cell", "strategy", "commands", "completed", "unserved", "lost", "escapes", "warnings", "collisions",
                         "least clearance [mm]", "virtual time [s]", "real time [s]"},
                        cells);
}

}  // namespace interlace::reproduce
