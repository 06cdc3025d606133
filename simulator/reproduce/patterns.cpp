#include "simulator/reproduce/patterns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "simulator/reproduce/markdown.hpp"

namespace interlace::reproduce {

namespace {

/// Table 6.4 of the dissertation.
struct LocalMinima {
  const char* folder;
  int robots;
  const char* pattern;
  const char* theirs;
};
constexpr std::array<LocalMinima, 5> kLocalMinima{{{"pattern-triangle-3", 3, "triangle", "few"},
                                                   {"pattern-serial-3", 3, "serial", "rare"},
                                                   {"pattern-zigzag-4", 4, "zigzag", "high"},
                                                   {"pattern-square-4", 4, "square", "normal"},
                                                   {"pattern-serial-4", 4, "serial", "rare"}}};

std::vector<std::string> strategies_of(const std::vector<PatternRun>& runs) {
  std::vector<std::string> names;
  for (const PatternRun& r : runs) {
    if (std::find(names.begin(), names.end(), r.report.strategy) == names.end()) names.push_back(r.report.strategy);
  }
  return names;
}

const app::RunReport* find(const std::vector<PatternRun>& runs, const PatternExperiment& e, const std::string& strategy) {
  for (const PatternRun& r : runs) {
    if (r.experiment.folder == e.folder && r.experiment.number == e.number && r.report.strategy == strategy) return &r.report;
  }
  return nullptr;
}

/// Warnings, commands and those never done of a pattern under a strategy, added up.
struct Tally {
  bool known = false;
  double warnings = 0, commands = 0, left = 0;
};

std::string shown(const Tally& t) {
  if (!t.known) return "not run";
  std::string text = fmt::format("{:.0f} in {:.0f} commands", t.warnings, t.commands);
  if (t.left > 0) text += fmt::format(", {:.0f} never done", t.left);
  return text;
}

Tally tally(const std::vector<PatternRun>& runs, const std::string& folder, const std::string& strategy) {
  Tally t;
  for (const PatternRun& r : runs) {
    if (r.experiment.folder != folder || r.report.strategy != strategy) continue;
    t.known = true;
    t.warnings += static_cast<double>(r.report.warnings);
    t.commands += static_cast<double>(r.report.submitted);
    t.left += static_cast<double>(r.report.submitted - r.report.completed - r.report.rejected);
  }
  return t;
}

Tally tally(const std::vector<Campaign>& campaigns, const std::string& folder, const std::string& strategy) {
  Tally t;
  for (const Campaign& campaign : campaigns) {
    for (const CampaignRow& r : campaign.rows) {
      const bool same_cell = r.cell == folder || "pattern-" + r.cell == folder;
      if (!same_cell || r.strategy != strategy || !r.warnings) continue;
      t.known = true;
      t.warnings += *r.warnings;
      t.commands += r.commands.value_or(0);
      t.left += r.unserved.value_or(0);
    }
  }
  return t;
}

}  // namespace

const std::vector<PatternExperiment>& pattern_experiments() {
  static const std::vector<PatternExperiment> all{
      {"pattern-triangle-3", 3, "triangle", 1, 6, 153, 56}, {"pattern-triangle-3", 3, "triangle", 2, 2, 140, 92},
      {"pattern-triangle-3", 3, "triangle", 3, 3, 278, 52}, {"pattern-serial-3", 3, "serial", 1, 23, 137, 67},
      {"pattern-serial-3", 3, "serial", 2, 21, 88, 48},     {"pattern-serial-3", 3, "serial", 3, 16, 82, 49},
      {"pattern-zigzag-4", 4, "zigzag", 1, 9, 176, 74},     {"pattern-zigzag-4", 4, "zigzag", 2, 7, 305, 104},
      {"pattern-zigzag-4", 4, "zigzag", 3, 11, 285, 112},   {"pattern-square-4", 4, "square", 1, 9, 203, 77},
      {"pattern-square-4", 4, "square", 2, 11, 207, 118},   {"pattern-square-4", 4, "square", 3, 7, 202, 71},
      {"pattern-serial-4", 4, "serial", 1, 22, 303, 100},   {"pattern-serial-4", 4, "serial", 2, 23, 111, 67},
      {"pattern-serial-4", 4, "serial", 3, 17, 164, 65}};
  return all;
}

std::string map_time_table(const std::vector<PatternRun>& runs) {
  const auto strategies = strategies_of(runs);
  std::vector<std::string> header{"robots", "pattern", "program", "dissertation: range [ms]", "average [ms]"};
  for (const std::string& s : strategies) {
    header.push_back(fmt::format("`{}`: range [ms]", s));
    header.emplace_back("average [ms]");
    header.emplace_back("maps");
  }
  std::vector<std::vector<std::string>> rows;
  for (const PatternExperiment& e : pattern_experiments()) {
    std::vector<std::string> row{fmt::format("{}", e.robots), e.pattern, fmt::format("{}", e.number),
                                 fmt::format("{:.0f} to {:.0f}", e.low, e.high), fmt::format("{:.0f}", e.average)};
    for (const std::string& s : strategies) {
      const app::RunReport* r = find(runs, e, s);
      if (!r || !r->map_build || r->map_build->count == 0) {
        row.insert(row.end(), {"not run", "–", "–"});
        continue;
      }
      const app::DurationStatistics& t = *r->map_build;
      row.push_back(fmt::format("{:.2f} to {:.1f}", t.min, t.max));
      row.push_back(fmt::format("{:.2f}", t.mean));
      row.push_back(fmt::format("{}", t.count));
    }
    rows.push_back(std::move(row));
  }
  return markdown_table(header, rows);
}

std::string pattern_outcome_table(const std::vector<PatternRun>& runs) {
  std::vector<std::vector<std::string>> rows;
  for (const PatternRun& run : runs) {
    const app::RunReport& r = run.report;
    rows.push_back({fmt::format("{} {}, program {}", run.experiment.pattern, run.experiment.robots, run.experiment.number),
                    fmt::format("`{}`", r.strategy), fmt::format("{:.2f}", r.makespan), fmt::format("{} of {}", r.completed, r.submitted),
                    fmt::format("{}", r.escapes), fmt::format("{}", r.warnings), fmt::format("{}", r.collisions.value_or(0)),
                    r.least_clearance ? fmt::format("{:.1f}", 1000 * *r.least_clearance) : "–"});
  }
  return markdown_table({"pattern", "strategy", "time [s]", "completed", "escapes", "warnings", "collisions", "least clearance [mm]"},
                        rows);
}

std::string local_minima_table(const std::vector<PatternRun>& runs, const std::vector<Campaign>& campaigns) {
  std::vector<std::vector<std::string>> rows;
  for (const LocalMinima& m : kLocalMinima) {
    std::vector<std::string> row{fmt::format("{}", m.robots), m.pattern, m.theirs};
    for (const char* strategy : {"acm", "event"}) {
      const Tally theirs = tally(campaigns, m.folder, strategy);
      row.push_back(shown(theirs.known ? theirs : tally(runs, m.folder, strategy)));
    }
    rows.push_back(std::move(row));
  }
  return markdown_table({"robots", "pattern", "dissertation", "`acm`: warnings", "`event`: warnings"}, rows);
}

}  // namespace interlace::reproduce
