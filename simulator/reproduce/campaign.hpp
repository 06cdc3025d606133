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

/// A report of interlace-campaign.
struct Campaign {
  std::string file;                 ///< its name, without folders
  std::optional<double> per_robot;  ///< commands for each robot in a program
  std::vector<CampaignRow> rows;
};

/// Reads a report that interlace-campaign wrote: a row is every object with `completed`, wherever in the file it is. Its cell (`cell` or
/// `pattern`) and its `strategy` may also stand in an object around it, the cell as a key too. Otherwise what is wrong with it.
[[nodiscard]] model::Result<Campaign, std::string> parse_campaign(const std::string& json, const std::string& file_name);

/// Reads and parses the file at `path`.
[[nodiscard]] model::Result<Campaign, std::string> load_campaign(const std::string& path);

/// The rows as a Markdown table.
[[nodiscard]] std::string campaign_table(const Campaign& campaign);

/// The command line that makes the report again, with the default seed: the programs go to the cells in turn, so asking for as many
/// commands as there were ends after the same program.
[[nodiscard]] std::string campaign_command(const Campaign& campaign);

}  // namespace interlace::reproduce
