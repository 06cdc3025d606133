#pragma once

#include <benchmark/benchmark.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace interlace::bench {

/// A row of the table: what was measured beside what it is compared with.
struct Figure {
  std::string what, ours, peer;
  double ratio = 0;         ///< peer to ours; for limits of time: measured to limit
  std::string limit;        ///< what the design asks for; empty: nothing
  std::optional<bool> met;  ///< whether it is so
};

/// Prints what the console shows, and keeps what was measured under each benchmark's name.
class Measurements : public benchmark::ConsoleReporter {
 public:
  void ReportRuns(const std::vector<Run>& runs) override;

  /// Seconds of computing of one iteration, and a counter; empty when that benchmark did not run.
  [[nodiscard]] std::optional<double> seconds(const std::string& name) const;
  [[nodiscard]] std::optional<double> counter(const std::string& name, const std::string& counter) const;

 private:
  struct Measured {
    double seconds = 0;
    std::map<std::string, double> counters;
  };
  std::map<std::string, Measured> by_name_;
};

/// The design's figures from whatever was measured; rows whose benchmarks did not run are left out.
[[nodiscard]] std::vector<Figure> figures_of(const Measurements& measured);

[[nodiscard]] std::string to_markdown(const std::vector<Figure>& figures);
[[nodiscard]] std::string to_json(const std::vector<Figure>& figures);

}  // namespace interlace::bench
