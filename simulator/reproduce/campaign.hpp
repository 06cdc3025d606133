#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/model/result.hpp"

namespace interlace::reproduce {

/// What a campaign says of one cell and one strategy; what its file does not tell stays empty.
struct CampaignRow {
  std::string cell, strategy;
  std::optional<double> commands, completed, unserved, lost, escapes, warnings, collisions;
  std::optional<double> least_clearance;          ///< [m]
  std::optional<double> virtual_time, real_time;  ///< [s]
};

/// The rows of a report that interlace-campaign wrote: every object with a `strategy`, wherever in the file it is. The cell is its `cell`
/// or `pattern`, or else what the nearest object around it says, or else the key it stands under. Otherwise what is wrong with it.
[[nodiscard]] model::Result<std::vector<CampaignRow>, std::string> parse_campaign(const std::string& json, const std::string& file_name);

/// Reads and parses the file at `path`.
[[nodiscard]] model::Result<std::vector<CampaignRow>, std::string> load_campaign(const std::string& path);

/// The rows as a Markdown table.
[[nodiscard]] std::string campaign_table(const std::vector<CampaignRow>& rows);

}  // namespace interlace::reproduce
