#include "simulator/reproduce/results_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "planner/core/strategy.hpp"
#include "simulator/reproduce/command_chart.hpp"
#include "simulator/reproduce/distance_curves.hpp"
#include "simulator/reproduce/experiment_tables.hpp"
#include "simulator/reproduce/map_picture.hpp"
#include "simulator/reproduce/markdown.hpp"

namespace interlace::reproduce {

namespace {

constexpr const char* kBefore = "direct";
constexpr const char* kAfter = "event";

std::string chart_title(const ExperimentRun& run, const app::RunReport& r) {
  std::string title = fmt::format("Experiment {}, {}: {} of {} commands in {:.2f} s", run.experiment.number, r.strategy, r.completed,
                                  r.submitted, r.makespan);
  if (r.escapes > 0) title += ", " + counted(r.escapes, "escape");
  if (r.least_clearance) title += fmt::format(", least clearance {:.1f} mm", 1000 * *r.least_clearance);
  if (r.collisions.value_or(0) > 0) title += ", " + counted(*r.collisions, "collision");
  return title;
}

std::string strategy_table() {
  static const std::map<std::string_view, const char*> meanings{
      {"direct", "no planner: every command starts as soon as its robot is free"},
      {"zone", "one robot at a time in the shared zone"},
      {"eef-map", "a collision map of the end-effectors only"},
      {"acm", "the dissertation's method as written"},
      {"event", "the earliest start that is clear of everything committed"},
      {"lookahead", "the default: as `event`, in the order of a plan for all commands that wait"}};
  std::vector<std::vector<std::string>> rows;
  for (const auto name : core::strategy_names()) {
    const auto found = meanings.find(name);
    rows.push_back({fmt::format("`{}`", name), found == meanings.end() ? "–" : found->second});
  }
  return markdown_table({"strategy", "what it does"}, rows);
}

std::string image(const std::string& words, const Picture& picture) {
  return fmt::format("![{}](results/{})\n\n", words, picture.file);
}

bool ends_with(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

std::string experiment_section(const ExperimentRun& run, const std::vector<Picture>& pictures) {
  const Experiment& e = run.experiment;
  std::string text =
      fmt::format("### Experiment {}: {} robots, {} commands\n\n", e.number, run.input.cell->robots.size(), run.input.program.size());
  text += outcome_table(run.runs, run.least) + "\n";
  std::string notes = outcome_notes(run.runs);
  if (run.least) notes += optimum_notes(*run.least);
  if (!notes.empty()) text += notes + "\n";
  text += fmt::format("Command charts, as in {}; the time axes of one experiment are the same.\n\n", e.chart);
  for (const Picture& p : pictures) {
    if (p.file.find("-chart-") != std::string::npos) text += image("command chart " + p.file.substr(0, p.file.size() - 4), p);
  }
  for (const Picture& p : pictures) {
    if (!ends_with(p.file, "-distances.svg")) continue;
    text += e.curves.empty()
                ? fmt::format(
                      "Least clearance between each two robots without a planner (`{}`) and with one (`{}`), from the controllers' "
                      "postures. The dissertation has no curves for this experiment.\n\n",
                      kBefore, kAfter)
                : fmt::format("Distances as in {}, without a planner (`{}`) and with one (`{}`), from the controllers' postures.\n\n",
                              e.curves, kBefore, kAfter);
    text += image("distances in experiment " + e.number, p);
  }
  bool mapped = false;
  for (const Picture& p : pictures) {
    if (!ends_with(p.file, "-map.svg") || p.file.find("-chart-") != std::string::npos) continue;
    mapped = true;
    text +=
        "Collision map, as in figures 3.6 and 6.11, of the first command that had to wait for a motion under way (`event`). Above the "
        "line of the whole length the commanded robot stands at its goal.\n\n" +
        image("collision map of experiment " + e.number, p);
  }
  if (!mapped) text += "No command had to wait for a motion under way (`event`), so there is no collision map to show.\n\n";
  return text;
}

std::string pattern_section(const Results& results) {
  std::string text = "## Tables 6.3 and 6.4: patterns of three and four robots\n\n";
  if (results.patterns.empty()) {
    text += "The programs of the patterns were not run.\n\n";
  } else {
    text +=
        "Time to build collision maps. **These are measured times, the only numbers on this page that change from run to run and from "
        "machine "
        "to machine.**\n\n" +
        map_time_table(results.patterns) +
        "\n- Their map is of one commanded robot against all moving ones; ours is of one pair of motions, built once and kept while both "
        "matter, so a decision may need several or none.\n"
        "- Their map samples at fixed steps on a Core i5 of 2.5 GHz; ours subdivides until every cell is decided, and spends its time "
        "along "
        "the borders of the collision areas.\n"
        "- The dissertation does not print its programs; ours have the same patterns and other commands.\n\n"
        "How the same programs went, in virtual time:\n\n" +
        pattern_outcome_table(results.patterns) + "\n";
  }
  if (results.patterns.empty() && results.campaigns.empty()) return text;
  text += fmt::format(
      "Local minima (table 6.4), counted as warnings: a deadlock that no escape resolved. Counts are from {}.\n\n",
      results.campaigns.empty() ? "the programs above" : "the campaigns below where they have the pattern, else from the programs above");
  text += local_minima_table(results.patterns, results.campaigns);
  text +=
      "\n- The dissertation gives words instead of counts, and not how many experiments they stand for.\n"
      "- A warning is no end here: the command stays queued and is tried again at each change, so one that was warned of may still be "
      "completed. Commands never done are told beside.\n\n";
  return text;
}

std::string campaign_section(const Results& results) {
  std::string text = "## Campaign\n\n";
  if (results.campaigns.empty()) {
    return text +
           "Not shown: `interlace-campaign` makes it (`interlace-campaign --help`), and `docs/reproduce --campaign FILE` puts its report "
           "here.\n";
  }
  text += "Random programs on the patterns, judged in virtual time. Real time is what a campaign says it took when it was made.\n\n";
  for (const Campaign& campaign : results.campaigns)
    text += campaign_table(campaign) + "\nMade by\n\n```sh\n" + campaign_command(campaign) + "\n```\n\n";
  return text + "and shown here by `docs/reproduce --campaign FILE`, once for each report.\n";
}

}  // namespace

std::vector<Picture> pictures(const ExperimentRun& run) {
  std::vector<Picture> all;
  const NamedCommands named = named_commands(run.input);
  const std::string& folder = run.experiment.folder;
  double end = 0;
  for (const StrategyRun& r : run.runs) end = std::max(end, last_end(r.report));
  for (const StrategyRun& r : run.runs) {
    all.push_back({fmt::format("{}-chart-{}.svg", folder, r.report.strategy),
                   command_chart(chart_title(run, r.report), r.report, *run.input.cell, named, end)});
  }
  std::vector<CurveRun> curves;
  if (const StrategyRun* r = find_run(run, kBefore)) curves.push_back({fmt::format("before ({})", kBefore), &r->frames});
  const StrategyRun* after = find_run(run, kAfter);
  if (after) curves.push_back({fmt::format("after ({})", kAfter), &after->frames});
  if (!curves.empty() && run.input.cell->robots.size() > 1) {
    all.push_back(
        {folder + "-distances.svg",
         distance_picture(fmt::format("Experiment {}: distances between the robots", run.experiment.number), *run.input.cell, curves)});
  }
  if (after) {
    if (const auto subject = first_delayed(run.input, *after, named)) {
      all.push_back({folder + "-map.svg", map_picture(fmt::format("Experiment {}: collision map of {} against {}", run.experiment.number,
                                                                  subject->label, subject->moving.front().label),
                                                      *subject, collision_areas(*subject, run.input.cell->planning))});
    }
  }
  return all;
}

std::string results_page(const Results& results, const std::vector<std::vector<Picture>>& pictures_of) {
  std::string text =
      "# Results\n\n"
      "The experiments of A. Y. Afaghani's dissertation on the advanced collision map, run again in virtual time with every strategy. "
      "`docs/reproduce` writes this page and its pictures; do not edit them.\n\n";
  text += strategy_table() +
          "\nTimes run from the first start to the last end. Collisions (how often one began) and the least clearance are judged from the "
          "simulated "
          "controllers' postures every millisecond, by code that shares nothing with the planner; a negative clearance is how deep bodies "
          "overlap.\n\n";
  if (!results.skipped.empty()) {
    text += "Not run:\n\n";
    for (const std::string& s : results.skipped) text += "- " + s + "\n";
    text += "\n";
  }
  const bool finish_times = std::any_of(results.experiments.begin(), results.experiments.end(), [](const ExperimentRun& r) {
    return r.experiment.number == "4.2" || r.experiment.number == "5.2";
  });
  if (finish_times) text += "## Tables 4.7 and 5.7: time to finish experiment 2\n\n" + finish_time_table(results.experiments) + "\n";
  if (!results.experiments.empty()) text += "## Experiments\n\n";
  for (std::size_t i = 0; i < results.experiments.size(); ++i) text += experiment_section(results.experiments[i], pictures_of[i]);
  return text + pattern_section(results) + campaign_section(results);
}

}  // namespace interlace::reproduce
