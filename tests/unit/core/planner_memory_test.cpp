#include <gtest/gtest.h>

#include <unistd.h>
#include <cstdio>
#include <fstream>

#include "tests/support/motions.hpp"
#include "tests/unit/core/desk.hpp"

/// However long a planner works, it does not grow.
namespace interlace::test {
namespace {

/// Memory of this process [MB].
double resident() {
  std::ifstream statm{"/proc/self/statm"};
  double whole = 0;
  double in_memory = 0;
  statm >> whole >> in_memory;
  return in_memory * static_cast<double>(sysconf(_SC_PAGESIZE)) * 1e-6;
}

/// Two arms that share a place go to and fro, each command another one, all of them kept track of.
TEST(PlannerLongRun, KeepsItsMemory) {
  constexpr std::size_t kCommands = 5000;
  constexpr std::size_t kLook = 1000;  // commands after which everything has been as large as it gets
  Seed seed{76};
  auto cell = std::make_shared<model::Cell>(*experiment_cell());
  for (auto& robot : cell->robots) robot.tcp = {1, 10, {}, {}};  // short motions: cheap maps
  cell->planning.resolution = 0.05;
  auto options = Desk::usual();
  options.remembered = 500;
  Desk desk{cell, options};
  desk.all_stand();
  constexpr double kGrowth = 20;  // [MB] that the allocator may keep for itself
  core::MapStatistics early;
  double early_memory = 0;
  std::size_t answered = 0;
  for (std::size_t i = 0; i < scaled(kCommands); ++i) {
    const bool first = i % 2 == 0;
    const std::string robot = first ? "r1" : "r2";
    const double y = seed.uniform(40, 300) * (first ? 1 : -1);
    const std::string id = robot + "-" + std::to_string(i);
    desk.submit(id, robot, line_to(pose_mm(seed.uniform(300, 450), y, seed.uniform(200, 350))));
    if (!model::is_final(desk.status_of(id).state)) desk.pass_until_dispatch(1s);
    for (const auto& d : std::exchange(desk.dispatches, {})) desk.carry_out(d);
    while (desk.planner.prepare()) {
    }
    answered += desk.statuses.empty() ? 0 : 1;
    desk.statuses.clear();
    const auto now = desk.planner.maps().statistics();
    if (i == std::min(kLook, scaled(kCommands) / 2)) {
      early = now;
      early_memory = resident();
    }
    ASSERT_LE(now.kept, core::MapLimits{}.maps + 12) << "command " << i;
    ASSERT_LE(now.bytes, core::MapLimits{}.bytes);
    if (i > kLook) {
      ASSERT_LE(now.bytes, 4 * std::max<std::size_t>(early.bytes, 100'000)) << "command " << i;
    }
  }
  const auto maps = desk.planner.maps().statistics();
  std::printf("%zu commands: %zu maps built, %zu reused, %zu evicted; %zu kept in %zu bytes, %zu after the first %zu\n", answered,
              maps.built, maps.reused, maps.evicted, maps.kept, maps.bytes, early.bytes, kLook);
  std::printf("%.1f MB in memory then, %.1f MB now\n", early_memory, resident());
  EXPECT_LT(resident(), early_memory + kGrowth);
  EXPECT_GT(maps.built, scaled(kCommands) / 2);
}

}  // namespace
}  // namespace interlace::test
