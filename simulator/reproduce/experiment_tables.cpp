#include "simulator/reproduce/experiment_tables.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "planner/core/strategy.hpp"
#include "simulator/reproduce/markdown.hpp"

namespace interlace::reproduce {

namespace {

/// Tables 4.7 and 5.7 of the dissertation [s].
struct FinishTime {
  const char* strategy;
  const char* method;  ///< as the dissertation calls it
  std::optional<double> without_escapes, with_escapes;
};
constexpr double kTheirDirect = 24.3;

const std::vector<FinishTime>& their_times() {
  static const std::vector<FinishTime> times{
      {"direct", "without method", kTheirDirect, kTheirDirect},
      {"zone", "zone blocking (Zhou et al.)", 40.7, 40.7},
      {"acm", "advanced collision map", 33.1, 36.2},
  };
  return times;
}

std::string seconds(const std::optional<double>& s) {
  return s ? fmt::format("{:.1f} s", *s) : "–";
}

/// Time and, when it means little by itself, what went wrong.
std::string finish(const app::RunReport& r) {
  std::string text = fmt::format("{:.2f} s", r.makespan);
  if (r.escapes > 0) text += fmt::format(", {}", counted(r.escapes, "escape"));
  if (r.completed < r.submitted) text += fmt::format(", **{} not done**", r.submitted - r.completed);
  if (r.collisions.value_or(0) > 0) text += fmt::format(", **{}**", counted(*r.collisions, "collision"));
  return text;
}

const ExperimentRun* find(const std::vector<ExperimentRun>& runs, const std::string& number) {
  const auto found = std::find_if(runs.begin(), runs.end(), [&](const ExperimentRun& r) { return r.experiment.number == number; });
  return found == runs.end() ? nullptr : &*found;
}

const app::RunReport* report_of(const ExperimentRun* run, const std::string& strategy) {
  const StrategyRun* found = run ? find_run(*run, strategy) : nullptr;
  return found ? &found->report : nullptr;
}

std::string finish_notes(const ExperimentRun* first, const ExperimentRun* second) {
  const ExperimentRun* any = first ? first : second;
  std::string text;
  if (const auto* direct = report_of(any, "direct")) {
    text += fmt::format(
        "- Their times count from the start-up of their system, which takes about 0.6 s before the first command moves; ours count from "
        "the "
        "first start. `direct` took {:.2f} s, {:.2f} s less than their {:.1f} s. Add as much to ours to compare them with theirs.\n",
        direct->makespan, kTheirDirect - direct->makespan, kTheirDirect);
  }
  if (report_of(any, "zone")) {
    text +=
        "- `zone` works its shared zone out from where the arms' reaches overlap unless the cell file gives one; the dissertation does not "
        "say "
        "where the borders of the zone lay that gave 40.7 s, so the times need not agree.\n";
  }
  if (report_of(any, "acm")) {
    text +=
        "- `acm` serves the robots in turn and frees one commanded robot at a time, as the dissertation does, but on our certified map "
        "with "
        "the distance and the range union corrected. Its times may differ from theirs in both directions.\n";
  }
  if (const auto* event = report_of(any, "event")) {
    text += fmt::format(
        "- `event` lets whichever robot can start first start, and holds no robot up because another one is stuck: {:.2f} s in experiment "
        "{}, {} needed.\n",
        event->makespan, any->experiment.number, counted(event->escapes, "escape"));
  }
  if (report_of(any, "eef-map")) {
    text += "- `eef-map` sees the end-effectors only. Where it collided, its time does not compare with the others.\n";
  }
  text +=
      "- Experiments 4.2 and 5.2 have the same commands; their 33.1 s and 36.2 s differ by the escapes of the second, which resolved two "
      "deadlocks.\n";
  return text;
}

}  // namespace

std::string outcome_table(const std::vector<StrategyRun>& runs, const std::optional<LeastTimes>& least) {
  const bool by_optimum = least && least->waiting.makespan;
  std::vector<std::vector<std::string>> rows;
  for (const StrategyRun& run : runs) {
    const app::RunReport& r = run.report;
    rows.push_back({fmt::format("`{}`", r.strategy), fmt::format("{:.2f}", r.makespan), fmt::format("{} of {}", r.completed, r.submitted),
                    fmt::format("{}", r.unserved), fmt::format("{}", r.escapes), fmt::format("{}", r.warnings),
                    r.collisions ? fmt::format("{}", *r.collisions) : "–",
                    r.least_clearance ? fmt::format("{:.1f}", 1000 * *r.least_clearance) : "–"});
    if (!by_optimum) continue;
    // Of a lower bound nothing is known but that the ratio to the optimum is no larger.
    const bool all_done = r.completed == r.submitted && r.collisions.value_or(0) == 0;
    const double ratio = r.makespan / *least->waiting.makespan;
    rows.back().insert(rows.back().begin() + 2, all_done ? fmt::format("{}{:.3f}", least->waiting.exact ? "" : "≤ ", ratio) : "–");
  }
  std::vector<std::string> head{"strategy", "time [s]", "completed",  "unserved",
                                "escapes",  "warnings", "collisions", "least clearance [mm]"};
  if (by_optimum) head.insert(head.begin() + 2, "time / optimum");
  return markdown_table(head, rows);
}

std::string optimum_notes(const LeastTimes& least) {
  return fmt::format(
      "- Optimum of the given orders, paths and time laws: {}.\n- Where no start relies on a departure that is still to come, as with "
      "`event`: {}.\n- Or on a promised one within {:g} s, as with `lookahead`: {}.\n",
      summary(least.waiting), summary(least.confirmed), least.promise, summary(least.promised));
}

std::string outcome_notes(const std::vector<StrategyRun>& runs) {
  std::string text;
  for (const StrategyRun& run : runs) {
    const app::RunReport& r = run.report;
    const std::size_t collisions = r.collisions.value_or(0);
    if (collisions > 0) {
      const char* why = r.strategy == "direct"    ? "nothing prevents them"
                        : r.strategy == "eef-map" ? "it did not see them, because it looks at the end-effectors only"
                                                  : "this must not happen and is a fault";
      text += fmt::format("- `{}`: {}; {}.\n", r.strategy, counted(collisions, "collision"), why);
    } else if (r.strategy == "eef-map" && r.least_clearance) {
      text += fmt::format(
          "- `eef-map`: no collisions here; the bodies it does not look at happened to stay clear, the nearest of all at {:.0f} mm.\n",
          1000 * *r.least_clearance);
    }
    if (r.completed + r.rejected < r.submitted) {
      text += fmt::format("- `{}`: {} never done; its time is that of the others.\n", r.strategy,
                          counted(r.submitted - r.completed - r.rejected, "command"));
    }
    if (r.rejected > 0) text += fmt::format("- `{}`: {} rejected.\n", r.strategy, counted(r.rejected, "command"));
  }
  return text;
}

std::string finish_time_table(const std::vector<ExperimentRun>& runs) {
  const ExperimentRun* first = find(runs, "4.2");
  const ExperimentRun* second = find(runs, "5.2");
  std::vector<std::vector<std::string>> rows;
  for (const auto name : core::strategy_names()) {
    const std::string strategy{name};
    FinishTime theirs{"", "", std::nullopt, std::nullopt};
    for (const FinishTime& t : their_times()) {
      if (strategy == t.strategy) theirs = t;
    }
    const auto* r1 = report_of(first, strategy);
    const auto* r2 = report_of(second, strategy);
    rows.push_back({fmt::format("`{}`", strategy), theirs.method, seconds(theirs.without_escapes), r1 ? finish(*r1) : "not run",
                    seconds(theirs.with_escapes), r2 ? finish(*r2) : "not run"});
  }
  return markdown_table({"strategy", "method of the dissertation", "4.2, dissertation", "4.2, here", "5.2, dissertation", "5.2, here"},
                        rows) +
         "\n" + finish_notes(first, second);
}

}  // namespace interlace::reproduce
