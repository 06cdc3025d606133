#include "bench/figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace interlace::bench {

namespace {

constexpr double kTimesFaster = 300;  // than brute force
constexpr double kOfFour = 5e-3;      // [s] 95 of 100 decisions in a ring of four
constexpr double kOfTwelve = 20e-3;   // [s] in a ring of twelve
constexpr double kAhead = 25e-3;      // [s] in a ring of four with `lookahead`: its budget and 5 ms
constexpr double kFlat = 1.5;         // between rows of 10 and of 100

std::string milliseconds(double seconds) {
  return seconds < 10 ? fmt::format("{:.3g} ms", 1e3 * seconds) : fmt::format("{:.0f} s", seconds);
}

class Table {
 public:
  explicit Table(const Measurements& measured) : measured_(measured) {}

  /// How many times as long the peer takes; `least`: how many it must be.
  void compare(const std::string& what, const std::string& ours, const std::string& peer, std::optional<double> least) {
    const auto a = measured_.seconds(ours);
    const auto b = measured_.seconds(peer);
    if (!a || !b) return;
    Figure f{what, milliseconds(*a), milliseconds(*b), *b / *a, "", std::nullopt};
    if (least) {
      f.limit = fmt::format("≥ {:.0f} times", *least);
      f.met = f.ratio >= *least;
    }
    figures.push_back(std::move(f));
  }

  /// Average building time of many maps beside the dissertation's.
  void average(const std::string& what, const std::string& name, const std::string& theirs) {
    const auto seconds = measured_.seconds(name);
    const auto maps = measured_.counter(name, "maps");
    if (!seconds || !maps) return;
    figures.push_back(
        {fmt::format("{}, average of {:.0f} maps", what, *maps), milliseconds(*seconds / *maps), theirs, 0, "", std::nullopt});
  }

  /// A count that must be zero.
  void none(const std::string& what, const std::string& name, const std::string& counter) {
    const auto count = measured_.counter(name, counter);
    if (count) figures.push_back({what, fmt::format("{:.0f}", *count), "", 0, "0", *count == 0});
  }

  void decisions(const std::string& cell, std::optional<double> most) {
    const std::string name = "decision/" + cell;
    const auto p50 = measured_.counter(name, "p50_ms");
    const auto p95 = measured_.counter(name, "p95_ms");
    const auto p99 = measured_.counter(name, "p99_ms");
    if (!p50 || !p95 || !p99) return;
    Figure f{
        fmt::format("decision, {}", cell), fmt::format("p50 {:.2f}, p95 {:.2f}, p99 {:.2f} ms", *p50, *p95, *p99), "", 0, "", std::nullopt};
    if (most) {
      f.limit = fmt::format("p95 ≤ {:.0f} ms", 1e3 * *most);
      f.met = *p95 <= 1e3 * *most;
    }
    figures.push_back(std::move(f));
    const auto kept = measured_.counter(name, "maps_kept");
    const auto bytes = measured_.counter(name, "maps_bytes");
    if (kept && bytes)
      figures.push_back(
          {fmt::format("maps kept, {}", cell), fmt::format("{:.0f}, {:.1f} MB", *kept, 1e-6 * *bytes), "", 0, "", std::nullopt});
  }

  void flat(const std::string& few, const std::string& many) {
    const auto a = measured_.counter("decision/" + few, "p95_ms");
    const auto b = measured_.counter("decision/" + many, "p95_ms");
    if (!a || !b) return;
    figures.push_back({fmt::format("decision, {} to {}", few, many), fmt::format("p95 {:.2f} ms", *b), fmt::format("p95 {:.2f} ms", *a),
                       *b / *a, fmt::format("≤ {} times", kFlat), *b / *a <= kFlat});
  }

  std::vector<Figure> figures;

 private:
  const Measurements& measured_;
};

}  // namespace

void Measurements::ReportRuns(const std::vector<Run>& runs) {
  ConsoleReporter::ReportRuns(runs);
  for (const Run& run : runs) {
    if (run.error_occurred) continue;
    Measured& m = by_name_[run.run_name.function_name];
    const bool manual = run.run_name.time_type == "manual_time";
    m.seconds = (manual ? run.real_accumulated_time : run.cpu_accumulated_time) / static_cast<double>(run.iterations);
    for (const auto& [name, counter] : run.counters) m.counters[name] = counter.value;
  }
}

std::optional<double> Measurements::seconds(const std::string& name) const {
  const auto found = by_name_.find(name);
  return found == by_name_.end() ? std::nullopt : std::optional{found->second.seconds};
}

std::optional<double> Measurements::counter(const std::string& name, const std::string& counter) const {
  const auto found = by_name_.find(name);
  if (found == by_name_.end()) return std::nullopt;
  const auto value = found->second.counters.find(counter);
  return value == found->second.counters.end() ? std::nullopt : std::optional{value->second};
}

std::vector<Figure> figures_of(const Measurements& measured) {
  Table table{measured};
  table.compare("C12 × C22 at 10 ms: brute force with fcl::distance", "C12xC22/map", "C12xC22/brute_force", kTimesFaster);
  table.compare("C12 × C22 at 10 ms: fcl::continuousCollide, part measured", "C12xC22/map", "C12xC22/continuous_collision", std::nullopt);
  table.compare("C12 × C22 at 10 ms: closed-form distances", "C12xC22/map", "C12xC22/closed_form", std::nullopt);
  table.none("C12 × C22: points that brute force finds blocked and the map does not", "C12xC22/brute_force", "missed");
  table.none("C12 × C22: blocked cells farther apart than they may move", "C12xC22/brute_force", "unjustified");
  table.compare("all maps of experiment 6.2: brute force, part measured", "exp-6-2/maps", "exp-6-2/brute_force", kTimesFaster);
  table.compare("all maps of the five patterns: brute force, part measured", "patterns/maps", "patterns/brute_force", kTimesFaster);
  table.average("table 6.3", "patterns/maps", "dissertation: 48 to 118 ms");
  table.average("experiment 6.2", "exp-6-2/maps", "");
  for (const char* cell : {"ring-2", "ring-3", "ring-4", "ring-6", "ring-8", "ring-12", "row-10", "row-20", "row-50", "row-100"}) {
    const std::string name = cell;
    table.decisions(name, name == "ring-4" ? std::optional{kOfFour} : name == "ring-12" ? std::optional{kOfTwelve} : std::nullopt);
  }
  table.flat("row-10", "row-100");
  table.decisions("ring-4 lookahead", kAhead);
  return std::move(table.figures);
}

std::string to_markdown(const std::vector<Figure>& figures) {
  std::string text = "| figure | ours | peer | ratio | limit | met |\n|---|---|---|---:|---|---|\n";
  for (const Figure& f : figures) {
    text += fmt::format("| {} | {} | {} | {} | {} | {} |\n", f.what, f.ours, f.peer, f.ratio > 0 ? fmt::format("{:.3g}", f.ratio) : "",
                        f.limit, f.met ? *f.met ? "yes" : "**no**" : "");
  }
  return text;
}

std::string to_json(const std::vector<Figure>& figures) {
  nlohmann::json json = nlohmann::json::array();
  for (const Figure& f : figures) {
    nlohmann::json row{{"figure", f.what}, {"ours", f.ours}, {"peer", f.peer}, {"limit", f.limit}};
    row["ratio"] = f.ratio > 0 ? nlohmann::json(f.ratio) : nlohmann::json();
    row["met"] = f.met ? nlohmann::json(*f.met) : nlohmann::json();
    json.push_back(std::move(row));
  }
  return json.dump(2);
}

}  // namespace interlace::bench
