#include <benchmark/benchmark.h>
#include <fcl/narrowphase/distance.h>

#include <cmath>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include "planner/core/timing_map.hpp"
#include "tests/support/motions.hpp"

/// What a certified collision map costs beside sampling the same plane point by point, as the dissertation does.
namespace interlace::bench {
namespace {

using core::SampledMotion;

constexpr double kResolution = 0.01;  // [s]

/// Motions C12 and C22 of experiment 4.2: both arms reach for the same place from either side.
struct Encounter {
  std::shared_ptr<model::Cell> cell = test::experiment_cell();
  model::Motion own = planned(cell->robots[0], 250), other = planned(cell->robots[1], -250);

  static model::Motion planned(const model::Robot& robot, double y) {
    const auto there = model::plan_motion(robot, robot.start, test::line_to(test::pose_mm(300, y, 330))).value();
    return model::plan_motion(robot, there.to(), test::line_to(test::pose_mm(350, 0, 200))).value();
  }
};

/// A capsule as FCL takes it: its axis, a capsule of radius zero, in its pose, and the radius beside it.
struct PosedCapsule {
  fcl::Capsuled axis;
  fcl::Transform3d X_WC;
  double radius;
};

/// Postures of a motion at every resolution step.
std::vector<std::vector<PosedCapsule>> sampled(const model::Motion& motion) {
  const auto steps = static_cast<std::size_t>(std::ceil(motion.duration() / kResolution));
  std::vector<std::vector<PosedCapsule>> postures(steps + 1);
  std::vector<model::Capsule> capsules;
  for (std::size_t i = 0; i <= steps; ++i) {
    model::place_capsules(motion.robot().model, motion.robot().X_WB, motion.joints(kResolution * static_cast<double>(i)), capsules);
    for (const model::Capsule& c : capsules) {
      fcl::Transform3d X_WC = fcl::Transform3d::Identity();
      X_WC.linear() = Eigen::Quaterniond::FromTwoVectors(model::Vector3::UnitZ(), c.b - c.a).toRotationMatrix();
      X_WC.translation() = (c.a + c.b) / 2;
      postures[i].push_back({fcl::Capsuled{0.0, (c.b - c.a).norm()}, X_WC, c.radius});
    }
  }
  return postures;
}

/// The peer: fcl::distance for every pair of capsules at every point of the plane, as the dissertation samples it.
void brute_force(benchmark::State& state) {
  const Encounter encounter;
  std::size_t distances = 0;
  std::size_t blocked = 0;
  for (auto _ : state) {
    distances = blocked = 0;
    const auto own = sampled(encounter.own);
    const auto other = sampled(encounter.other);
    for (const auto& a : own) {
      for (const auto& b : other) {
        bool collides = false;
        for (const PosedCapsule& x : a) {
          for (const PosedCapsule& y : b) {
            const fcl::DistanceRequestd request;
            fcl::DistanceResultd result;
            collides = fcl::distance(&x.axis, x.X_WC, &y.axis, y.X_WC, request, result) <= x.radius + y.radius || collides;
            ++distances;
          }
        }
        blocked += collides ? 1 : 0;
      }
    }
  }
  state.counters["distances"] = static_cast<double>(distances);
  state.counters["blocked"] = static_cast<double>(blocked);
}

/// Ours, from two motions nobody has looked at yet.
void certified_map(benchmark::State& state) {
  const Encounter encounter;
  core::TimingMap map;
  for (auto _ : state) {
    SampledMotion own{encounter.own, kResolution};
    SampledMotion other{encounter.other, kResolution};
    map = core::build_timing_map(own, other, 0);
  }
  state.counters["distances"] = static_cast<double>(map.evaluations);
  state.counters["blocked"] = static_cast<double>(map.blocked.size());
}

/// Random motions of two arms half a metre apart, each pair new: what a planner sees on average.
void random_maps(benchmark::State& state) {
  const auto cell = test::experiment_cell();
  test::Seed seed{71};
  std::vector<std::pair<model::Motion, model::Motion>> pairs;
  for (int i = 0; i < 200; ++i) pairs.emplace_back(test::random_linear(seed, cell->robots[0]), test::random_linear(seed, cell->robots[1]));
  double distances = 0;
  double blocked = 0;
  std::size_t maps = 0;
  for (auto _ : state) {
    const auto& [a, b] = pairs[maps++ % pairs.size()];
    SampledMotion own{a, kResolution};
    SampledMotion other{b, kResolution};
    const auto map = core::build_timing_map(own, other, 0);
    distances += static_cast<double>(map.evaluations);
    blocked += static_cast<double>(map.blocked.size());
  }
  state.counters["distances"] = benchmark::Counter(distances, benchmark::Counter::kAvgIterations);
  state.counters["blocked"] = benchmark::Counter(blocked, benchmark::Counter::kAvgIterations);
}

BENCHMARK(brute_force)->Unit(benchmark::kMillisecond)->Name("C12xC22/brute_force");
BENCHMARK(certified_map)->Unit(benchmark::kMillisecond)->Name("C12xC22/certified_map");
BENCHMARK(random_maps)->Unit(benchmark::kMillisecond)->Name("random/certified_map")->Iterations(2000);

/// Prints what the console shows, and keeps the times for the ratio.
class Ratio : public benchmark::ConsoleReporter {
 public:
  void ReportRuns(const std::vector<Run>& runs) override {
    ConsoleReporter::ReportRuns(runs);
    for (const Run& run : runs) times_[run.benchmark_name()] = run.GetAdjustedCPUTime();
  }
  void print() const {
    const auto ours = times_.find("C12xC22/certified_map");
    const auto peer = times_.find("C12xC22/brute_force");
    if (ours == times_.end() || peer == times_.end()) return;
    std::printf("C12xC22: the certified map is %.0f times as fast as brute force\n", peer->second / ours->second);
  }

 private:
  std::map<std::string, double> times_;
};

}  // namespace
}  // namespace interlace::bench

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  interlace::bench::Ratio ratio;
  benchmark::RunSpecifiedBenchmarks(&ratio);
  ratio.print();
  return 0;
}
