// What a certified collision map costs beside sampling the same plane point by point, as the dissertation does.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <utility>

#include "bench/benchmarks.hpp"
#include "bench/cpu_time.hpp"
#include "bench/map_cases.hpp"
#include "bench/peers.hpp"
#include "planner/core/timing_map.hpp"

namespace interlace::bench {

namespace {

using core::SampledMotion;
using core::TimingMap;

constexpr double kResolution = 0.01;        // [s] of maps and grids
constexpr std::size_t kPointsOfAMap = 400;  // of the grid that stand for all of it where there are many maps
constexpr std::size_t kSteps = 5000;        // of the continuous collision that stand for all

/// From motions nobody has looked at yet.
TimingMap build(const MapCase& c) {
  SampledMotion commanded{c.commanded, kResolution};
  SampledMotion moving{c.moving, kResolution};
  return core::build_timing_map(commanded, moving, 0);
}

void map_of_one(benchmark::State& state, const MapCases& cases) {
  TimingMap map;
  for (auto _ : state) map = build(cases.maps.front());
  state.counters["distances"] = static_cast<double>(map.evaluations);
  state.counters["blocked"] = static_cast<double>(map.blocked.size());
}

/// The least clearance of every point of the grid, rows of the commanded robot's postures.
template <typename Posture, typename LeastClearance>
std::vector<double> whole_grid(const std::vector<Posture>& own, const std::vector<Posture>& other, const LeastClearance& least) {
  std::vector<double> grid;
  grid.reserve(own.size() * other.size());
  for (const auto& a : own) {
    for (const auto& b : other) grid.push_back(least(a, b));
  }
  return grid;
}

void brute_force(benchmark::State& state, const MapCases& cases) {
  const MapCase& c = cases.maps.front();
  std::vector<double> grid;
  std::size_t rows = 0;
  for (auto _ : state) {
    const auto own = posed(c.commanded, kResolution);
    grid = whole_grid(own, posed(c.moving, kResolution), by_fcl);
    rows = own.size();
  }
  // A point that the grid finds blocked must be so in the map; what the map blocks beyond must be nearer than one cell's displacement.
  const std::size_t columns = grid.size() / rows;
  const TimingMap map = build(c);
  const auto holds = [](double from, double until, std::size_t step) {
    const double t = kResolution * static_cast<double>(step);
    return from <= t && t <= until;
  };
  std::size_t blocked = 0;
  std::size_t missed = 0;
  for (std::size_t i = 0; i < rows; ++i) {
    for (std::size_t j = 0; j < columns; ++j) {
      if (grid[i * columns + j] > 0) continue;
      ++blocked;
      const auto known = [&](const core::BlockedCell& b) { return holds(b.tau0, b.tau1, i) && holds(b.t0, b.t1, j); };
      missed += std::any_of(map.blocked.begin(), map.blocked.end(), known) ? 0 : 1;
    }
  }
  const auto extra = [](const core::BlockedCell& b) { return b.clearance > 0; };
  const auto unjustified = [](const core::BlockedCell& b) { return b.clearance > b.bound; };
  state.counters["points"] = static_cast<double>(grid.size());
  state.counters["blocked"] = static_cast<double>(blocked);
  state.counters["missed"] = static_cast<double>(missed);
  state.counters["extra"] = static_cast<double>(std::count_if(map.blocked.begin(), map.blocked.end(), extra));
  state.counters["unjustified"] = static_cast<double>(std::count_if(map.blocked.begin(), map.blocked.end(), unjustified));
}

void closed_form(benchmark::State& state, const MapCases& cases) {
  const MapCase& c = cases.maps.front();
  for (auto _ : state)
    benchmark::DoNotOptimize(whole_grid(bodies(c.commanded, kResolution), bodies(c.moving, kResolution), in_closed_form));
}

/// One query for each link pair and step of each diagonal, which is what all shifts of the start in steps of 10 ms ask for. A random part
/// of them stands for all.
void continuous_collision(benchmark::State& state, const MapCases& cases) {
  const MapCase& c = cases.maps.front();
  const auto own = posed(c.commanded, kResolution);
  const auto other = posed(c.moving, kResolution);
  std::mt19937 random{1};
  std::uniform_int_distribution<std::size_t> row{0, own.size() - 2};
  std::uniform_int_distribution<std::size_t> column{0, other.size() - 2};
  for (auto _ : state) {
    const double begin = cpu_seconds();
    for (std::size_t k = 0; k < kSteps; ++k) {
      const std::size_t i = row(random);
      const std::size_t j = column(random);
      benchmark::DoNotOptimize(by_continuous_collision(own[i], own[i + 1], other[j], other[j + 1]));
    }
    state.SetIterationTime((cpu_seconds() - begin) * static_cast<double>((own.size() - 1) * (other.size() - 1)) / kSteps);
  }
}

/// Programs whose maps are found out when a benchmark first asks for them.
class Programs {
 public:
  Programs(std::string cells, std::vector<std::pair<std::string, std::string>> programs)
      : cells_(std::move(cells)), programs_(std::move(programs)) {}

  [[nodiscard]] const std::vector<MapCases>& maps() const {
    if (maps_.empty()) {
      for (const auto& [folder, program] : programs_) maps_.push_back(maps_of(cells_, folder, program));
    }
    return maps_;
  }

 private:
  std::string cells_;
  std::vector<std::pair<std::string, std::string>> programs_;  // folder and program
  mutable std::vector<MapCases> maps_;
};

/// All maps of some programs, one after the other.
void maps_of_all(benchmark::State& state, const Programs& programs) {
  const std::vector<MapCases>& all = programs.maps();
  std::size_t maps = 0;
  double longest = 0;
  for (auto _ : state) {
    maps = 0;
    for (const MapCases& cases : all) {
      for (const MapCase& c : cases.maps) {
        const double begin = cpu_seconds();
        benchmark::DoNotOptimize(build(c));
        longest = std::max(longest, cpu_seconds() - begin);
        ++maps;
      }
    }
  }
  state.counters["maps"] = static_cast<double>(maps);
  state.counters["longest_ms"] = 1e3 * longest;
}

/// Whole grids of all these would take minutes: of each the postures are computed, and the distances of some random points stand for all.
void brute_force_of_all(benchmark::State& state, const Programs& programs) {
  const std::vector<MapCases>& all = programs.maps();
  std::mt19937 random{1};
  for (auto _ : state) {
    double seconds = 0;
    for (const MapCases& cases : all) {
      for (const MapCase& c : cases.maps) {
        double begin = cpu_seconds();
        const auto own = posed(c.commanded, kResolution);
        const auto other = posed(c.moving, kResolution);
        seconds += cpu_seconds() - begin;
        const std::size_t points = own.size() * other.size();
        const std::size_t measured = std::min(points, kPointsOfAMap);
        std::uniform_int_distribution<std::size_t> point{0, points - 1};
        begin = cpu_seconds();
        for (std::size_t k = 0; k < measured; ++k) {
          const std::size_t p = measured < points ? point(random) : k;
          benchmark::DoNotOptimize(by_fcl(own[p / other.size()], other[p % other.size()]));
        }
        seconds += (cpu_seconds() - begin) * static_cast<double>(points) / static_cast<double>(measured);
      }
    }
    state.SetIterationTime(seconds);
  }
}

void register_all(const std::string& name, const std::shared_ptr<const Programs>& all) {
  benchmark::RegisterBenchmark((name + "/maps").c_str(), [all](benchmark::State& s) {
    maps_of_all(s, *all);
  })->Unit(benchmark::kMillisecond);
  benchmark::RegisterBenchmark((name + "/brute_force").c_str(), [all](benchmark::State& s) { brute_force_of_all(s, *all); })
      ->Unit(benchmark::kMillisecond)
      ->UseManualTime()
      ->Iterations(1);
}

}  // namespace

void register_map_benchmarks(const std::string& cells) {
  const MapCases one = c12_c22();
  const auto add = [&](const char* name, void (*function)(benchmark::State&, const MapCases&)) {
    return benchmark::RegisterBenchmark(fmt::format("{}/{}", one.name, name).c_str(),
                                        [one, function](benchmark::State& s) { function(s, one); })
        ->Unit(benchmark::kMillisecond);
  };
  add("map", map_of_one);
  add("brute_force", brute_force);
  add("closed_form", closed_form);
  add("continuous_collision", continuous_collision)->UseManualTime()->Iterations(1);

  register_all("exp-6-2",
               std::make_shared<const Programs>(cells, std::vector{std::make_pair(std::string{"exp-6-2"}, std::string{"program"})}));
  std::vector<std::pair<std::string, std::string>> patterns;
  for (const char* folder : {"pattern-triangle-3", "pattern-serial-3", "pattern-zigzag-4", "pattern-square-4", "pattern-serial-4"}) {
    for (const char* program : {"program-1", "program-2", "program-3"}) patterns.emplace_back(folder, program);
  }
  register_all("patterns", std::make_shared<const Programs>(cells, std::move(patterns)));
}

}  // namespace interlace::bench
